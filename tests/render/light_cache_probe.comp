#version 460
// SPDX-License-Identifier: Apache-2.0
// Nodes and lookups of a light cache; see light_cache_probe_io.h.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "light/cache.glsl"
#include "light_cache_probe_io.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { LightCacheProbeInputs io; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= io.count) {
    return;
  }
  LightCache cache = io.caches.at[io.cache];
  if (io.mode == kProbeNodes) {
    io.depths.at[i] = cache.depths.at[i];
  } else if (io.mode == kProbeInside) {
    io.depths.at[i] = lightCacheDepth(cache, io.points.at[i]);
  } else {
    const vec3 point = io.points.at[i];
    const vec3 toLight = io.distant == 1u ? io.light : normalize(io.light - point);
    const float distance = io.distant == 1u ? kInfiniteDistance : length(io.light - point);
    io.depths.at[i] = lightDepthFrom(io.grids.at[cache.grid], cache, point, toLight, distance);
  }
}
