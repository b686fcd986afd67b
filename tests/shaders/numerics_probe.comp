#version 460
// SPDX-License-Identifier: Apache-2.0
// Maps (x, y) through one function of core/numerics.glsl, or through its plain counterpart as a planted bug.
#extension GL_GOOGLE_include_directive : require
#include "core/numerics.glsl"
#include "interop/basic.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kFunction = 0u;
layout(constant_id = 1) const bool kPlain = false;
layout(push_constant, scalar) uniform Push {
  vec2Ptr inputs;
  floatPtr outputs;
  uint count;
};

float evaluate(vec2 v) {
  switch (kFunction) {
  case 0u: return kPlain ? log(1.0 + v.x) : log1pAccurate(v.x);
  case 1u: return kPlain ? exp(v.x) - 1.0 : expm1Accurate(v.x);
  case 2u: return kPlain ? sin(kTwoPi * v.x) : cosSinTurns(v.x).y;
  case 3u: return kPlain ? cos(kTwoPi * v.x) : cosSinTurns(v.x).x;
  case 4u: return kPlain ? atan(v.y, v.x) : atan2Accurate(v.y, v.x);
  case 5u: return kPlain ? float(v.x == v.x) : float(isFinite(v.x));
  case 6u: return kPlain ? 1.0 - exp(-v.x) : oneMinusExp(v.x);
  }
  return 0.0;
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < count) {
    outputs.at[i] = evaluate(inputs.at[i]);
  }
}
