// SPDX-License-Identifier: Apache-2.0
// Directions towards the environments. A batch has a set of directions, one in each cell of the octahedral square, with
// light caches of their own: a new set for every batch makes the sum over the set unbiased. A sample takes one direction
// of the set, in proportion to what it is expected to give the pixel: radiance times phase function (the camera's
// direction is all that it depends on) times the transmittance that the caches have at two places of the pixel's
// middle ray. Beside the set stand an environment's own sampler (small bright spots) and the phase functions (narrow
// peaks), joined by the balance heuristic of what a batch has: the set's directions once, the others anew in each of its
// samples.
#ifndef TYNDALL_MARCH_SKY_GLSL
#define TYNDALL_MARCH_SKY_GLSL

#include "core/octahedral.glsl"
#include "core/sobol.glsl"
#include "light/lights.glsl"
#include "passes/march/media.glsl"

// Of the pixel that is being rendered: what each direction of the set is expected to give, and the sum.
float skyWeights[kSkyDirections];
float skyTotal;

struct SkySample {
  vec3 direction;
  vec3 strength; // radiance / pdf
  uint index;    // of the direction in the set whose caches are nearest
};

bool isEnvironment(DistantLight light) { return light.kind == kDistantConstant || light.kind == kDistantMap; }

// The phase functions of all media, each as likely.
float meanPhase(vec3 d, vec3 w) {
  float sum = 0.0;
  [[unroll]] for (uint m = 0u; m < kMedia; ++m) {
    sum += evalPhase(media[m].phase, d, w);
  }
  return sum / float(kMediaArray);
}

// Cell of the set that w falls into.
uint skyCell(vec3 w) {
  const uvec2 place = min(uvec2((0.5 * octahedralFromDirection(w) + 0.5) * float(kSkyEdge)), uvec2(kSkyEdge - 1u));
  return place.x + kSkyEdge * place.y;
}

// Density of the set's directions, all together [1/sr]: uniform on the square, whose area is dw = dA / r^3 with r the
// distance of the octahedron's point.
float skySetDensity(vec3 w) {
  const vec3 point = w / (abs(w.x) + abs(w.y) + abs(w.z));
  const float r2 = dot(point, point);
  return 0.25 * float(kSkyDirections) * r2 * sqrt(r2);
}

// Radiance (xyz) of all environments along w, and the density (w) of their own samplers, one drawn by its selectPdf.
vec4 skyMixture(ScenePtr scene, vec3 w) {
  vec4 sum = vec4(0.0);
  float select = 0.0;
  [[dont_unroll]] for (uint i = 0u; i < scene.at[0].distantCount; ++i) {
    DistantLight light = scene.at[0].distant.at[i];
    if (isEnvironment(light)) {
      sum += vec4(distantRadianceOf(light, w), light.selectPdf * distantPdfOf(light, w));
      select += light.selectPdf;
    }
  }
  return vec4(sum.xyz, select > 0.0 ? sum.w / select : 0.0);
}

vec3 skyLightSample(ScenePtr scene, inout Rng rng) {
  vec3 w = vec3(0.0, 1.0, 0.0);
  float select = 0.0;
  [[dont_unroll]] for (uint i = 0u; i < scene.at[0].distantCount; ++i) {
    DistantLight light = scene.at[0].distant.at[i];
    if (isEnvironment(light)) {
      select += light.selectPdf;
      if (rngFloat(rng) * select < light.selectPdf) {
        w = distantDirection(light, rng);
      }
    }
  }
  return w;
}

// Denominator of the balance heuristic for a direction, `lightPdf` being that of the environments' samplers.
float skyBalance(MarchScenePtr march, vec3 d, vec3 w, float lightPdf) {
  const float lightShare = march.at[0].skyLightShare;
  const float phaseShare = march.at[0].skyPhaseShare;
  float drawn = lightShare * lightPdf;
  drawn += phaseShare > 0.0 ? phaseShare * meanPhase(d, w) : 0.0;
  return skySetDensity(w) + (kPlantedBug == kBugBranchPdf ? 0.0 : float(kSobolPoints) * drawn);
}

// Fills skyWeights for camera rays about the direction `view`; they hold the transmittances to expect, above 0.
void skyBegin(ScenePtr scene, MarchScenePtr march, vec3 view) {
  skyTotal = 0.0;
  [[dont_unroll]] for (uint k = 0u; k < kSkyDirections; ++k) {
    const vec3 w = march.at[0].sky.at[k];
    const vec4 mixture = skyMixture(scene, w);
    skyWeights[k] *= dot(mixture.xyz, vec3(1.0)) * meanPhase(view, w) / skyBalance(march, view, w, mixture.w);
    skyTotal += skyWeights[k];
  }
}

// One direction for a camera ray along d.
SkySample skySample(ScenePtr scene, MarchScenePtr march, vec3 d, Sobol sobol, inout Rng rng) {
  const float lightShare = march.at[0].skyLightShare;
  const float phaseShare = march.at[0].skyPhaseShare;
  const float setShare = 1.0 - lightShare - phaseShare;
  const float choice = sobolFloat(sobol, kDimSky);
  SkySample result;
  float scale = float(kSobolPoints);
  if (choice < setShare) {
    float rest = choice / setShare * skyTotal;
    uint k = 0u;
    [[dont_unroll]] while (k + 1u < kSkyDirections && rest >= skyWeights[k]) {
      rest -= skyWeights[k];
      ++k;
    }
    result.index = k;
    result.direction = march.at[0].sky.at[k];
    const float picked = setShare * skyWeights[k];
    scale = picked > 0.0 ? skyTotal / picked : 0.0;
  } else {
    if (choice < setShare + lightShare) {
      result.direction = skyLightSample(scene, rng);
    } else {
      const uint medium = min(uint(rngFloat(rng) * float(kMedia)), kMedia - 1u);
      result.direction = phaseSample(media[medium].phase, d, rng);
    }
    result.index = skyCell(result.direction);
  }
  const vec4 mixture = skyMixture(scene, result.direction);
  result.strength = mixture.xyz * (scale / skyBalance(march, d, result.direction, mixture.w));
  return result;
}

#endif
