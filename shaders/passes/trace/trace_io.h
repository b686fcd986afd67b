// SPDX-License-Identifier: Apache-2.0
// Pass `trace`: one statistical batch of samples for a list of pixels.
//
// In:  the scene; the pixels to run; batch number and how many of its samples to take.
// Out: `sums`, one per pixel of the dispatch; tracks that reached the step bound are put into `suspendedOut` and
//      go on in a next dispatch with `resume` = 1, until the queue is empty. Nothing is dropped.
// The sums depend on pixel, seed and batch alone: not on dispatch size, order or step bound.
#ifndef TYNDALL_TRACE_IO_H
#define TYNDALL_TRACE_IO_H

#include "interop/pixel_sums.h"
#include "interop/planted_bugs.h"
#include "interop/scene.h"
#include "interop/walk.h"

// SPEC(type, name, id, default). A false flag removes the feature's code from the pipeline.
// clang-format off
#define TYNDALL_TRACE_SPEC(SPEC)                                                              \
  SPEC(uint, kPhaseMask,        0, 0xffffffffu) /* bit = id of phase/list.h */                \
  SPEC(uint, kFormatMask,       1, 7u)          /* bit = kFormat* */                          \
  SPEC(bool, kHomogeneous,      2, true)        /* homogeneous media */                       \
  SPEC(bool, kGrids,            3, true)        /* grid media */                              \
  SPEC(bool, kGridEmission,     4, true)        /* emissive grids */                          \
  SPEC(bool, kPointLights,      5, true)                                                      \
  SPEC(bool, kDistantDeltas,    6, true)        /* suns without angular size */               \
  SPEC(bool, kDistantAreas,     7, true)        /* sun discs, environments: MIS with phase */ \
  SPEC(bool, kOrthographic,     8, false)                                                     \
  SPEC(bool, kBackground,       9, true)        /* a distant light is visible */              \
  SPEC(bool, kAovs,            10, false)       /* depth and albedo */                        \
  SPEC(bool, kWeighted,        11, true)        /* tracker: see tracker/walk.glsl */          \
  SPEC(bool, kCount,           12, true)        /* lookups and segments are counted */        \
  SPEC(bool, kMediumTree,      14, false)       /* many grid media */                         \
  SPEC(uint, kPlantedBug,      13, 0u)          /* tests: kBug* below; 0 = none */
// clang-format on

GPU_BEGIN

// What happened, added up over a dispatch.
struct TraceCounters {
  uint suspended;        // entries of suspendedOut
  uint nonFinite;        // samples dropped because they were not finite
  uint majorantExceeded; // lookups above their majorant
  uint lookups;          // density lookups
  uint segments;         // camera, transmittance and shadow segments
  uint negative;         // samples with a negative component
};
GPU_BUFFER(TraceCounters)

// Everything that a suspended pixel needs to go on.
struct TraceState {
  uint slot;             // index into the dispatch's pixels and sums
  uint sampleIndex;      // within the batch
  uint stage;            // kStage* of passes/trace/stages.glsl: what follows the running walk
  uint vertex;           // which distance technique along the camera ray
  uvec4 rng;
  vec3 cameraOrigin;
  vec3 cameraDirection;
  uint vertexMedium;
  float vertexT;
  float vertexThroughput; // sigma_t T / pdf of the distance, albedo left out
  float vertexPdf;       // of free flight at a homogeneous vertex, for MIS with equiangular; 0 at a grid vertex
  uint vertexLight;      // the point light that the distance was made for; kAnyLight = select one
  vec3 vertexEmission;   // emitted radiance to be multiplied by the grids' transmittance to the vertex
  vec3 pending;          // what the running shadow segment's transmittance multiplies
  vec3 radiance;         // of this sample
  vec3 background;
  float transmittance;
  float depth;           // weighted by opacity
  float opacity;
  vec3 albedo;           // weighted by opacity
  Walk walk;
  PixelSums sums;
};
GPU_BUFFER(TraceState)

// Push constants.
struct TraceInputs {
  GPU_PTR(Scene) scene;
  GPU_PTR(uint) pixels;            // x | y << 16, absolute in the image
  GPU_PTR(PixelSums) sums;
  GPU_PTR(TraceState) suspendedIn;
  GPU_PTR(TraceState) suspendedOut;
  GPU_PTR(TraceCounters) counters;
  uint count;                      // pixels, or suspended states when resuming
  uint firstSample;                // index of the batch's first sample within the pixel
  uint sampleCount;                // samples of this batch to take
  uint seed;
  uint stepBound;                  // cells and collisions per invocation and dispatch
  uint stageCost;                  // steps that a stage counts for: 1 + what it loops over
  uint resume;                     // 1: go on with suspendedIn
};

GPU_END
#endif
