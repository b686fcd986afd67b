// SPDX-License-Identifier: Apache-2.0
// What the chain store says of a place, for people to look at.
#ifndef TYNDALL_INTEROP_GUIDE_VIEW_H
#define TYNDALL_INTEROP_GUIDE_VIEW_H

#include "interop/interop.h"

GPU_BEGIN

GPU_CONST int kViewCoarse = -1; // level of cells of the coarse grid

// Of the cell at a vertex. All zero: there is none.
struct GuideView {
  uint fingerprint;    // of the cell, never 0; in screen space: a hash of the pixel
  int level;           // of its grid, 0 is the finest, or kViewCoarse
  uint states;         // whose lobes may draw directions at the vertex
  float weight;        // sum of theirs
  vec3 direction;      // mean of the strongest one's lobe, unit; 0 without states
  float cosine;        // ... mean cosine to it
  float evidence;      // ... samples that it rests on
  float share;         // of directions that scattering draws
};
GPU_BUFFER(GuideView)

GPU_END
#endif
