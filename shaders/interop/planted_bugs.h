// SPDX-License-Identifier: Apache-2.0
// Known bugs that tests plant, to see their checkers fail.
#ifndef TYNDALL_INTEROP_PLANTED_BUGS_H
#define TYNDALL_INTEROP_PLANTED_BUGS_H

#include "interop/interop.h"

GPU_BEGIN

GPU_CONST uint kBugNone = 0;
GPU_CONST uint kBugHalfVoxel = 1;       // lookups shifted by half a voxel
GPU_CONST uint kBugPhaseSign = 2;       // g with the wrong sign
GPU_CONST uint kBugNoInverse4Pi = 3;    // phase function not normalised
GPU_CONST uint kBugBranchPdf = 4;       // MIS weight from the chosen technique's pdf alone
GPU_CONST uint kBugPlainLog = 5;        // -log(1 - xi)
GPU_CONST uint kBugOneTapBlackbody = 7; // Planck of a stochastic lookup
GPU_CONST uint kBugJacobian = 8;        // point light without 1 / r^2
GPU_CONST uint kBugNoCorrection = 9;    // the light cache taken for the truth
GPU_CONST uint kBugOtherCache = 10;     // the correction subtracts another cache value than the march added
GPU_CONST uint kBugExclusiveEdges = 20; // a ray through a triangle's edge misses it
GPU_CONST uint kBugRayPlace = 21;       // ray queries: the place before the one that is hit
GPU_CONST uint kBugRayCounts = 22;      // ray queries: what lets light pass ends a shadow ray
GPU_CONST uint kBugRaySpheres = 23;     // ray queries: no sphere is hit
GPU_CONST uint kBugVolumePdf = 30;      // an emissive medium's density of directions without t^2
GPU_CONST uint kBugHeroWeight = 31;     // balance heuristic over heroes for each flight on its own
GPU_CONST uint kBugRoulette = 32;       // survivors of roulette without their weight
GPU_CONST uint kBugNoPriority = 33;     // refracting boundaries inside objects of higher priority bend light
GPU_CONST uint kBugLineRestart = 34;    // a null boundary starts a new line
GPU_CONST uint kBugAimShare = 35;       // collisions under a small light count as if nothing else reached them
GPU_CONST uint kBugChosenLobe = 40;     // guiding: of the lobes' density the chosen one's part alone
GPU_CONST uint kBugScatterShare = 41;   // guiding: scattering's density in full, not by its share of the mixture
GPU_CONST uint kBugLightByScatter = 42; // guiding: light samples weighted as if scattering drew all directions
GPU_CONST uint kBugNoNeighbours = 43;   // chains in screen space: of the lobes' density the pixel's own part alone
GPU_CONST uint kBugDistanceWeight = 44; // guided distances: collisions of free flight count as if nothing else reached them

GPU_END
#endif
