#version 460
// SPDX-License-Identifier: Apache-2.0
// Samples of core/warp.glsl: sphere (kShape 0), cone about `axis` (1), disc (2), hemisphere by cosine (3); outputs (point, pdf).
#extension GL_GOOGLE_include_directive : require
#include "core/rng.glsl"
#include "core/warp.glsl"
#include "interop/basic.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kShape = 0u;
layout(constant_id = 1) const bool kPlanted = false; // uniform in the angle instead of in the solid angle
layout(push_constant, scalar) uniform Push {
  vec3 axis;
  float oneMinusCosMax;
  uint count;
  vec4Ptr outputs;
};

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= count) {
    return;
  }
  Rng rng = rngSeed(uvec2(i, 5u), 1u, 7u);
  vec2 xi = rngFloat2(rng);
  if (kPlanted) {
    xi.x *= xi.x; // small caps: 1 - cos is the angle squared
  }
  switch (kShape) {
  case 0u: outputs.at[i] = vec4(uniformSphereSample(xi), uniformSpherePdf()); break;
  case 1u: outputs.at[i] = vec4(uniformConeSample(axis, oneMinusCosMax, xi), uniformConePdf(oneMinusCosMax)); break;
  case 2u: outputs.at[i] = vec4(uniformDiscSample(xi), 0.0, uniformDiscPdf()); break;
  case 3u: {
    const vec3 w = cosineHemisphereSample(xi);
    outputs.at[i] = vec4(w, cosineHemispherePdf(w.z));
    break;
  }
  }
}
