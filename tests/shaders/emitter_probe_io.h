// SPDX-License-Identifier: Apache-2.0
// Samples of one emitter, for both compilers.
#ifndef TYNDALL_EMITTER_PROBE_IO_H
#define TYNDALL_EMITTER_PROBE_IO_H

#include "interop/emitters.h"

GPU_BEGIN

struct EmitterHit {
  vec3 direction;
  float distance;
  vec3 normal;
  vec3 radiance;
  float pdf;   // as sampleEmitter says
  float again; // as emitterDirectionPdf says
  vec2 barycentric;
  uint delta;
};
GPU_BUFFER(EmitterHit)

struct EmitterProbe {
  GPU_PTR(Emitters) emitters; // one
  vec3 point;
  GPU_PTR(EmitterHit) hits; // given directions, distances and normals
  GPU_PTR(EmitterHit) results;
  uint count;
};

GPU_END
#endif
