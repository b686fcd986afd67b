// SPDX-License-Identifier: Apache-2.0
// Distance chains: where on a camera ray through media light comes from, kept in screen space; docs/theory.md, (102) on.
#ifndef TYNDALL_INTEROP_GUIDE_DISTANCE_H
#define TYNDALL_INTEROP_GUIDE_DISTANCE_H

#include "interop/basic.h"

GPU_BEGIN

GPU_CONST uint kMostDistanceLoads = 8;

// A chain. All zero: empty.
struct DistanceState {
  float weight;   // mean score of accepted samples; 0: empty
  float mean;     // of their distances from the camera, weighted by the scores [scene units]
  float variance; // likewise, about the mean
  float count;    // of samples
};
GPU_BUFFER(DistanceState)

// What the samples of a vertex of the screen's grid say of the share of guided distances.
struct DistanceShare {
  float flightGain; // sum of squared values that free flight accounts for, fading
  float guideGain;  // ... and that the chains do
  uint samples;
};
GPU_BUFFER(DistanceShare)

// A chain as a density of distances on a ray.
struct DistanceLobe {
  float peak;  // at the mean: its part of the mixture's density [1/unit]; 0: there is none
  float mean;  // from the ray's origin
  float sigma;
};

// The camera ray of a path in flight, until what its event has found is known.
struct DistanceRecord {
  DistanceLobe lobes[kMostDistanceLoads];
  vec2 stretch;         // of the ray: where the lobes are cut off
  DistanceState chosen; // the loaded state that was drawn
  float meanWeight;     // of the loaded states, empty ones counted
  uint vertex;          // of the screen's grid, whose share was read
  float t;              // of the event, from the camera; < 0: there was none in a medium
  float before;         // luminance of the sample when the ray ended
  float guidedPart;     // of the density of the event's distance: the chains', [0, 1]
  float share;          // of guided distances; 0: nothing was loaded
};
GPU_BUFFER(DistanceRecord)

// What the store and the settings say of them.
struct GuideDistances {
  GPU_PTR(DistanceState) states;   // of each vertex of the screen's grid, row by row from the top
  GPU_PTR(DistanceShare) shares;   // of each vertex
  GPU_PTR(DistanceRecord) records; // one for each pixel of a dispatch
  uint columns;     // vertices in a row
  uint statesEach;  // of a vertex
  uint loads;       // states that a ray reads, kMostDistanceLoads at most
  float width;      // between vertices [pixels]
  float mostShare;  // of guided distances
  float priorSigma; // of a chain that knows nothing [scene units]
};

GPU_END
#endif
