// SPDX-License-Identifier: Apache-2.0
// Choices of emitters at receivers, for both compilers.
#ifndef TYNDALL_LIGHT_TREE_PROBE_IO_H
#define TYNDALL_LIGHT_TREE_PROBE_IO_H

#include "interop/emitters.h"

GPU_BEGIN

struct TreeReceiver {
  vec3 point;
  vec3 normal; // 0 0 0: in a medium
  uint twoSided;
};
GPU_BUFFER(TreeReceiver)

struct TreeChoice {
  uint emitter;
  float pdf;   // as chooseEmitter says
  float again; // as emitterChoicePdf says of it
};
GPU_BUFFER(TreeChoice)

// Invocation i serves receiver i / perReceiver; the rest of the division is the draw, or the emitter whose pdf is
// asked.
struct TreeProbe {
  GPU_PTR(Emitters) emitters;
  GPU_PTR(TreeReceiver) receivers;
  GPU_PTR(TreeChoice) choices;
  uint perReceiver;
  uint count;
};

GPU_END
#endif
