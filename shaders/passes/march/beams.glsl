// SPDX-License-Identifier: Apache-2.0
// The lights of one camera ray. A "beam" is a light whose direction (at infinity) or position is fixed for the whole
// ray, so that all cells of the ray share its cache and nothing is drawn in a cell: suns as they are, one direction
// towards each sun disc and environment, one direction by the phase function, the strongest point lights, and one of
// the other point lights.
#ifndef TYNDALL_MARCH_BEAMS_GLSL
#define TYNDALL_MARCH_BEAMS_GLSL

#include "core/equiangular.glsl"
#include "core/octahedral.glsl"
#include "core/sobol.glsl"
#include "light/lights.glsl"
#include "passes/march/media.glsl"

// Dimensions of the sample's Sobol point.
const uint kDimPixel = 0u;  // and 1
const uint kDimOffset = 2u;
const uint kDimLight = 3u;  // and 4; the second area light: 7 and 8
const uint kDimPhase = 5u;  // and 6
const uint kDimSelect = 9u;

struct Beam {
  bool point;
  vec3 place;     // unit direction to the light, or its position
  vec3 strength;  // what reaches an unshadowed point [W/m2], 1 / pdf included; point: times r^2 [W/sr]
  uint group;     // its caches, see MarchScene::cacheOf; kNoCache: none
};

const uint kBeamArray = kBeams > 0u ? kBeams : 1u;

Beam beams[kBeamArray];
LightCache beamCaches[kBeamArray * kSlotArray]; // [beam * kSlots + slot], where beamCached
bool beamCached[kBeamArray * kSlotArray];
uint beamCount;

void addBeam(Beam beam) {
  [[unroll]] for (uint b = 0u; b < kBeams; ++b) {
    if (b == beamCount) {
      beams[b] = beam;
    }
  }
  ++beamCount;
}

// Density of the direction that the phase beam takes: of one medium's phase function, each medium as likely.
float phaseBeamPdf(MarchScenePtr march, vec3 d, vec3 w) {
  float sum = 0.0;
  if (march.at[0].phaseBeam != 0u) {
    [[unroll]] for (uint m = 0u; m < kMedia; ++m) {
      sum += evalPhase(media[m].phase, d, w);
    }
    sum /= float(kMedia);
  }
  return sum;
}

// The cache group whose direction is nearest to w.
uint sectorGroup(MarchScenePtr march, vec3 w) {
  const uint edge = march.at[0].sectorEdge;
  if (edge == 0u) {
    return kNoCache;
  }
  const uvec2 place = min(uvec2((0.5 * octahedralFromDirection(w) + 0.5) * float(edge)), uvec2(edge - 1u));
  return march.at[0].sectorGroup + place.x + edge * place.y;
}

uint distantGroup(MarchScenePtr march, DistantLight light, uint index, vec3 w) {
  const bool environment = light.kind == kDistantConstant || light.kind == kDistantMap;
  return environment ? sectorGroup(march, w) : march.at[0].distantGroup + index;
}

// One beam per light at infinity, by its own sampler; its area lights are joined with the phase beam by the balance
// heuristic, light by light.
void addDistantBeams(ScenePtr scene, MarchScenePtr march, vec3 d, Sobol sobol, inout Rng rng) {
  uint dimension = kDimLight;
  [[dont_unroll]] for (uint i = 0u; i < scene.at[0].distantCount; ++i) {
    DistantLight light = scene.at[0].distant.at[i];
    Beam beam = Beam(false, light.toLight, light.radiance, march.at[0].distantGroup + i);
    if (kDistantAreas && light.kind != kDistantDelta) {
      const vec2 xi = dimension <= 7u ? vec2(sobolFloat(sobol, dimension), sobolFloat(sobol, dimension + 1u)) : rngFloat2(rng);
      dimension += 4u;
      beam.place = light.kind == kDistantMap ? distantDirection(light, rng) : distantDirectionAt(light, xi);
      const float ownPdf = distantPdfOf(light, beam.place);
      const float pdf = ownPdf + (kPlantedBug == kBugBranchPdf ? 0.0 : phaseBeamPdf(march, d, beam.place));
      beam.strength = pdf > 0.0 ? distantRadianceOf(light, beam.place) / pdf : vec3(0.0);
      beam.group = distantGroup(march, light, i, beam.place);
    }
    addBeam(beam);
  }
}

void addPhaseBeam(ScenePtr scene, MarchScenePtr march, vec3 d, Sobol sobol, inout Rng rng) {
  const uint medium = min(uint(sobolFloat(sobol, kDimSelect) * float(kMedia)), kMedia - 1u);
  const vec3 w = phaseSample(scene.at[0].media.at[medium].phase, d, rng);
  const float phasePdf = phaseBeamPdf(march, d, w);
  Beam beam = Beam(false, w, vec3(0.0), sectorGroup(march, w));
  [[dont_unroll]] for (uint i = 0u; i < scene.at[0].distantCount; ++i) {
    DistantLight light = scene.at[0].distant.at[i];
    const vec3 radiance = distantRadianceOf(light, w);
    if (light.kind != kDistantDelta && radiance != vec3(0.0)) {
      beam.strength += radiance / (phasePdf + distantPdfOf(light, w));
      beam.group = distantGroup(march, light, i, w);
    }
  }
  addBeam(beam);
}

// How much of a point light's intensity the ray's stretch in the media sees: the integral of 1 / r^2 over it.
float rayShare(PointLight light, vec3 origin, vec3 direction, vec2 stretch) {
  const Equiangular e = equiangularMake(origin, direction, light.position, stretch.x, stretch.y);
  return dot(light.intensity, vec3(1.0)) * e.theta / e.distance;
}

void addPointBeams(ScenePtr scene, MarchScenePtr march, vec3 origin, vec3 direction, vec2 stretch, inout Rng rng) {
  const uint fixedCount = march.at[0].pointBeams;
  [[dont_unroll]] for (uint i = 0u; i < fixedCount; ++i) {
    addBeam(Beam(true, scene.at[0].points.at[i].position, scene.at[0].points.at[i].intensity, i));
  }
  float sum = 0.0;
  float kept = 0.0;
  uint drawn = fixedCount;
  [[dont_unroll]] for (uint i = fixedCount; i < scene.at[0].pointCount; ++i) {
    const float share = rayShare(scene.at[0].points.at[i], origin, direction, stretch);
    sum += share;
    if (rngFloat(rng) * sum < share) {
      drawn = i;
      kept = share;
    }
  }
  if (kept > 0.0) {
    addBeam(Beam(true, scene.at[0].points.at[drawn].position, scene.at[0].points.at[drawn].intensity * (sum / kept), kNoCache));
  }
}

void loadCaches(MarchScenePtr march) {
  [[unroll]] for (uint b = 0u; b < kBeams; ++b) {
    [[unroll]] for (uint s = 0u; s < kSlots; ++s) {
      const uint i = b * kSlots + s;
      const uint index = beams[b].group == kNoCache ? kNoCache : march.at[0].cacheOf.at[beams[b].group * kSlots + s];
      beamCached[i] = index != kNoCache;
      if (beamCached[i]) {
        beamCaches[i] = march.at[0].caches.at[index];
      }
    }
  }
}

// `stretch` is where the ray may meet media.
void makeBeams(ScenePtr scene, MarchScenePtr march, vec3 origin, vec3 direction, vec2 stretch, Sobol sobol, inout Rng rng) {
  [[unroll]] for (uint b = 0u; b < kBeams; ++b) {
    beams[b] = Beam(false, vec3(0.0), vec3(0.0), kNoCache);
  }
  beamCount = 0u;
  if (kDistantLights) {
    addDistantBeams(scene, march, direction, sobol, rng);
  }
  if (kDistantAreas && march.at[0].phaseBeam != 0u) {
    addPhaseBeam(scene, march, direction, sobol, rng);
  }
  if (kPointLights) {
    addPointBeams(scene, march, origin, direction, stretch, rng);
  }
  loadCaches(march);
}

#endif
