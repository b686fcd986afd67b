// SPDX-License-Identifier: Apache-2.0
// Emission of media, gathered along lines: a point of the line is drawn, and the transmittance up to it follows. As a
// light a medium is drawn by a point inside it; the density of the *direction* to it is the integral of that point's
// density times t^2 along the line, so that no collision needs a pdf [Simon, Hanika, Zirr and Dachsbacher 2017].
#ifndef TYNDALL_PATH_EMISSION_GLSL
#define TYNDALL_PATH_EMISSION_GLSL

#include "medium/grid_emission.glsl"
#include "passes/path/flight.glsl"

const bool kMediaEmission = kGridEmission || kHomogeneousEmission;

// A point of a line that emission is gathered at.
struct GlowPoint {
  float t;           // from the line's origin; < 0: none
  float inversePdf;  // of t
  float measure;     // of the whole line: density of drawing its direction by a point in the medium [1/sr]
};

// Draws from a homogeneous medium between `first` and `last` of the line. Along a thick medium points crowd where they
// are seen: free flight conditioned on a collision, half and half with a uniform distance.
GlowPoint homogeneousGlow(ScenePtr scene, uint index, PathRay line, float first, float last, uint hero, inout Rng rng) {
  GlowPoint glow = GlowPoint(-1.0, 0.0, 0.0);
  const vec3 stretch = mediumStretch(scene, index, line, kInfiniteDistance);
  if (stretch.x >= stretch.y) {
    return glow;
  }
  const float b = stretch.y;
  const float a = stretch.x;
  const bool bounded = scene.at[0].media.at[index].shape == kShapeBox || scene.at[0].media.at[index].shape == kShapeSphere;
  if (bounded) {
    glow.measure = (b - a) * (kPlantedBug == kBugVolumePdf ? 1.0 : (a * a + a * b + b * b) * (1.0 / 3.0));
  }
  const float from = max(a, first);
  const float length = min(b, last) - from;
  if (length <= 0.0) {
    return glow;
  }
  const float sigmaT = scene.at[0].media.at[index].sigmaT * heroOf(scene.at[0].media.at[index].colour, hero);
  const float collided = oneMinusExp(sigmaT * length);
  const bool thick = sigmaT * length > 1e-3;
  float s = length;
  const float xi = rngFloat(rng);
  if (!thick || rngFloat(rng) < 0.5) {
    s = xi * length;
  } else {
    s = min(opticalDepthAt(xi * collided) / sigmaT, length);
  }
  const float uniformPdf = 1.0 / length;
  const float pdf = thick ? 0.5 * (uniformPdf + sigmaT * exp(-sigmaT * s) / collided) : uniformPdf;
  glow.t = from + s;
  glow.inversePdf = stretch.z / pdf;
  return glow;
}

// The emission coefficient of a medium at a point [W/(m3 sr)].
vec3 mediumEmission(ScenePtr scene, uint index, vec3 point, inout Rng rng) {
  if (kGridEmission && index >= scene.at[0].homogeneousCount) {
    return gridEmission(scene, index, point, rng);
  }
  return scene.at[0].media.at[index].emission;
}

// The medium that is gathered in round `turn` of a ray, kNoMedium if it does not glow; false: all have been.
bool glowingMedium(ScenePtr scene, uint turn, out uint medium) {
  const uint homogeneous = kHomogeneousEmission ? scene.at[0].homogeneousCount : 0u;
  medium = kNoMedium;
  if (turn < homogeneous) {
    medium = scene.at[0].media.at[turn].emissionKind != kEmissionNone ? turn : kNoMedium;
    return true;
  }
  if (!kGridEmission || turn - homogeneous >= scene.at[0].emissiveCount) {
    return false;
  }
  medium = scene.at[0].emissive.at[turn - homogeneous];
  return true;
}

// A point inside an emissive medium, drawn in proportion to its bricks' strongest emission, uniform in a brick or shape.
vec3 volumePoint(ScenePtr scene, uint index, Emitter emitter, inout Rng rng) {
  const vec3 xi = rngFloat3(rng);
  if (!kGridEmission || index < scene.at[0].homogeneousCount) {
    Medium medium = scene.at[0].media.at[index];
    if (medium.shape == kShapeSphere) {
      const float z = 1.0 - 2.0 * xi.x;
      const vec2 azimuth = cosSinTurns(xi.y);
      const vec3 onSphere = vec3(safeSqrt(1.0 - z * z) * azimuth, z);
      const float radius = pow(xi.z, 1.0 / 3.0);
      return emitter.position + radius * (mat3(emitter.edge1, emitter.edge2, emitter.radiance) * onSphere);
    }
    return emitter.position + mat3(emitter.edge1, emitter.edge2, emitter.radiance) * xi;
  }
  Grid grid = scene.at[0].grids.at[scene.at[0].media.at[index].emissionGrid];
  const int count = grid.brickCount.x * grid.brickCount.y * grid.brickCount.z;
  // The sums may be those of another copy of the grid, of another size: their own last one is the range.
  const float target = rngFloat(rng) * grid.cumulative.at[count - 1];
  int low = 0;
  int high = count - 1;
  [[dont_unroll]] while (low < high) { // the first brick whose sum is above the target
    const int middle = (low + high) >> 1;
    if (grid.cumulative.at[middle] > target) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  const ivec3 brick = ivec3(low % grid.brickCount.x, (low / grid.brickCount.x) % grid.brickCount.y,
                            low / (grid.brickCount.x * grid.brickCount.y));
  const vec3 first = max(vec3(brick * kBrickEdge), grid.boundsMin);
  const vec3 last = min(vec3((brick + 1) * kBrickEdge), grid.boundsMax);
  const vec3 voxel = mix(first, last, xi);
  return emitter.position + mat3(emitter.edge1, emitter.edge2, emitter.radiance) * voxel;
}

#endif
