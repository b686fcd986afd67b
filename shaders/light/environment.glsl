// SPDX-License-Identifier: Apache-2.0
// Radiance from infinity by a lat-long map, bilinear between texel centres, wrapping in azimuth and clamped at the
// poles. Directions w point from the scene to the sky.
#ifndef TYNDALL_LIGHT_ENVIRONMENT_GLSL
#define TYNDALL_LIGHT_ENVIRONMENT_GLSL

#include "core/numerics.glsl"
#include "core/rng.glsl"
#include "interop/environment.h"

/// (u, v) in [0, 1]: u = 1/2 looks along -z and grows towards +x, v = 0 is +y. `w` unit.
/// Own arctangents: the ones of Vulkan may be off by 4096 ulp, a texel of a large map.
vec2 environmentCoordinates(EnvironmentMap map, vec3 w) {
  const float azimuth = atan2Accurate(w.x, -w.z) * kInvTwoPi + 0.5 + map.rotation;
  const float polar = atan2Accurate(length(w.xz), w.y) * kInvPi;
  return vec2(azimuth - floor(azimuth), polar);
}

/// [W/(m2 sr)]
vec3 environmentRadiance(EnvironmentMap map, vec3 w) {
  const vec2 texel = environmentCoordinates(map, w) * vec2(map.size) - 0.5;
  const ivec2 size = ivec2(map.size);
  const ivec2 low = ivec2(floor(texel));
  const vec2 weight = texel - floor(texel);
  // Wraps once, and stays inside the map also for a direction that is not a number.
  const int x0 = low.x < 0 ? size.x - 1 : min(low.x, size.x - 1);
  const int x1 = x0 + 1 == size.x ? 0 : x0 + 1;
  const int row0 = clamp(low.y, 0, size.y - 1) * size.x;
  const int row1 = clamp(low.y + 1, 0, size.y - 1) * size.x;
  const vec3 top = mix(map.texels.at[row0 + x0], map.texels.at[row0 + x1], weight.x);
  const vec3 bottom = mix(map.texels.at[row1 + x0], map.texels.at[row1 + x1], weight.x);
  return mix(top, bottom, weight.y);
}

/// Density of environmentSample [1/sr].
float environmentPdf(EnvironmentMap map, vec3 w) {
  const vec2 place = environmentCoordinates(map, w) * vec2(map.cellCount);
  const uvec2 cell = min(uvec2(place), map.cellCount - 1u);
  const float sinTheta = cosSinTurns(0.5 * (float(cell.y) + 0.5) / float(map.cellCount.y)).y;
  return map.cells.at[cell.y * map.cellCount.x + cell.x].probability / (map.cellSolidAngle * sinTheta);
}

/// Draws a cell by its power and a direction uniform within it. The pdf is that of the direction as rounded, so that
/// it agrees with environmentPdf also at the cells' borders; it can be 0 only where the radiance is 0.
void environmentSample(EnvironmentMap map, inout Rng rng, out vec3 w, out float pdf) {
  const uint count = map.cellCount.x * map.cellCount.y;
  uint index = min(uint(rngFloat(rng) * float(count)), count - 1u);
  const AliasEntry entry = map.cells.at[index];
  index = rngFloat(rng) < entry.keep ? index : entry.alias;
  const vec2 xi = rngFloat2(rng);
  const float column = float(index % map.cellCount.x) + xi.x;
  const uint row = index / map.cellCount.x;
  const float rows = float(map.cellCount.y);

  // Uniform in 1 - cos of the angle from the nearer pole, 2 sin^2(angle / 2): exact beside the poles too.
  const bool northern = 2u * row < map.cellCount.y;
  const float fromPole = northern ? float(row) : rows - 1.0 - float(row);
  const float inner = cosSinTurns(0.25 * fromPole / rows).y;
  const float outer = cosSinTurns(0.25 * (fromPole + 1.0) / rows).y;
  const float oneMinusCos = 2.0 * mix(inner * inner, outer * outer, xi.y);
  const float sinTheta = safeSqrt(oneMinusCos * (2.0 - oneMinusCos));
  const float cosTheta = northern ? 1.0 - oneMinusCos : oneMinusCos - 1.0;

  const vec2 azimuth = cosSinTurns(column / float(map.cellCount.x) - 0.5 - map.rotation);
  w = vec3(sinTheta * azimuth.y, cosTheta, -sinTheta * azimuth.x);
  pdf = environmentPdf(map, w);
}

#endif
