#version 460
// SPDX-License-Identifier: Apache-2.0
// light/environment.glsl: samples (kMode 0) or given directions (kMode 1); outputs (w, pdf) and the radiance.
#extension GL_GOOGLE_include_directive : require
#include "light/environment.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kMode = 0u;
layout(constant_id = 1) const bool kPlanted = false; // density per unit square of the map, not per solid angle
struct EnvironmentProbe {
  EnvironmentMap map;
  uint count;
  vec3Ptr directions;
  vec4Ptr densities;
  vec3Ptr radiances;
};
layout(push_constant, scalar) uniform Push { EnvironmentProbe probe; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= probe.count) {
    return;
  }
  vec3 w;
  float pdf;
  if (kMode == 0u) {
    Rng rng = rngSeed(uvec2(i, 23u), 0u, 1u);
    environmentSample(probe.map, rng, w, pdf);
  } else {
    w = probe.directions.at[i];
    pdf = environmentPdf(probe.map, w);
  }
  if (kPlanted) {
    pdf *= 0.5 * kPi * length(w.xz);
  }
  probe.densities.at[i] = vec4(w, pdf);
  probe.radiances.at[i] = environmentRadiance(probe.map, w);
}
