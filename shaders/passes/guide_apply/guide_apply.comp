#version 460
// SPDX-License-Identifier: Apache-2.0
// Carries updates of the store out; guide_apply_io.h is the contract.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "guide_apply_io.h"

#define SPEC(type, name, id, value) layout(constant_id = id) const type name = value;
TYNDALL_GUIDE_APPLY_SPEC(SPEC)
#undef SPEC

#include "guide/store.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { GuideApplyInputs io; };

void carryOutPlace(uint place) {
  const GuideUpdate update = io.guide.at[0].log.at[place];
  if ((io.kinds >> update.kind & 1u) != 0u) {
    carryOut(io.guide, update);
  }
}

void main() {
  const uint invocation = gl_GlobalInvocationID.x;
  if (invocation >= io.count) {
    return;
  }
  if (kGuideOrdered) {
    const uint end = io.first.at[invocation + 1u];
    [[dont_unroll]] for (uint i = io.first.at[invocation]; i < end; ++i) {
      carryOutPlace(io.places.at[i]);
    }
  } else {
    carryOutPlace(invocation);
  }
  if (storeEvicted > 0u) {
    atomicAdd(io.guide.at[0].counters.at[0].evicted, storeEvicted);
  }
  if (fitForgotten > 0u) {
    atomicAdd(io.guide.at[0].counters.at[0].forgotten, fitForgotten);
  }
}
