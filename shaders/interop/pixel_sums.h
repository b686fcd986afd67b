// SPDX-License-Identifier: Apache-2.0
// What a pass gives for a pixel.
#ifndef TYNDALL_INTEROP_PIXEL_SUMS_H
#define TYNDALL_INTEROP_PIXEL_SUMS_H

#include "interop/interop.h"

GPU_BEGIN

// Sums over the samples of one batch, in film/film.h's channel order.
struct PixelSums {
  float moments[4]; // R, G, B, T
  float extras[8];  // background R, G, B; depth * opacity; opacity; albedo * opacity R, G, B
};
GPU_BUFFER(PixelSums)

GPU_END
#endif
