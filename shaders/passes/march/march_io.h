// SPDX-License-Identifier: Apache-2.0
// Pass `march`: single scattering by an exact march along each camera ray (ray.glsl), a batch's samples per invocation.
//
// In:  the scene; the pixels to run; which samples of the batch to take, in one dispatch or several.
// Out: `sums`, one per pixel of the dispatch. The sums depend on pixel, seed and sample indices alone.
#ifndef TYNDALL_MARCH_IO_H
#define TYNDALL_MARCH_IO_H

#include "interop/march.h"
#include "interop/pixel_sums.h"
#include "interop/planted_bugs.h"

// SPEC(type, name, id, default). A false flag or a count of 0 removes the feature's code from the pipeline. Counts are
// constants because arrays whose indices are known when the pipeline is made stay out of memory.
// clang-format off
#define TYNDALL_MARCH_SPEC(SPEC)                                                              \
  SPEC(uint, kPhaseMask,        0, 0xffffffffu) /* bit = id of phase/list.h */                \
  SPEC(uint, kSlots,            1, 1u)          /* placed grids */                            \
  SPEC(uint, kBeams,            2, 1u)          /* most beams of a ray, beams.glsl */         \
  SPEC(uint, kHomogeneousMedia, 3, 1u)                                                        \
  SPEC(uint, kGridMedia,        4, 1u)                                                        \
  SPEC(bool, kGridEmission,     5, true)        /* emissive grids */                          \
  SPEC(bool, kPointLights,      6, true)                                                      \
  SPEC(bool, kDistantLights,    7, true)                                                      \
  SPEC(bool, kDistantAreas,     8, true)        /* sun discs, environments */                 \
  SPEC(bool, kSky,             15, true)        /* environments */                            \
  SPEC(bool, kOrthographic,     9, false)                                                     \
  SPEC(bool, kBackground,      10, true)        /* a distant light is visible */              \
  SPEC(bool, kAovs,            11, false)       /* depth and albedo */                        \
  SPEC(uint, kCorrections,     12, 4u)          /* per ray; 0: the preview, biased */         \
  SPEC(bool, kCount,           13, true)        /* cells and corrections are counted */       \
  SPEC(uint, kPlantedBug,      14, 0u)          /* tests: kBug* of interop/planted_bugs.h */
// clang-format on

GPU_BEGIN

// What happened, added up over a dispatch.
struct MarchCounters {
  uint nonFinite;   // samples dropped because they were not finite
  uint cut;         // rays that reached maxSteps: must stay 0
  uint cells;       // of camera rays: cells whose voxels were read; of corrections: skipped regions as well
  uint steps;       // of camera rays: cells, skipped regions, pieces of homogeneous media
  uint corrections; // exact walks to a light
};
GPU_BUFFER(MarchCounters)

// Push constants.
struct MarchInputs {
  GPU_PTR(Scene) scene;
  GPU_PTR(MarchScene) march;
  GPU_PTR(uint) pixels;      // x | y << 16, absolute in the image
  GPU_PTR(PixelSums) sums;
  GPU_PTR(MarchCounters) counters;
  uint count;                // pixels
  uint firstSample;          // index within the pixel
  uint sampleCount;
  uint seed;
  uint resume;               // 1: add to what `sums` holds
};

GPU_END
#endif
