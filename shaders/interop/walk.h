// SPDX-License-Identifier: Apache-2.0
// A walk through the grid media in the middle of its way (tracker/walk.glsl), as suspended states keep it.
#ifndef TYNDALL_INTEROP_WALK_H
#define TYNDALL_INTEROP_WALK_H

#include "interop/scene.h"

GPU_BEGIN

// A ray segment being tracked through the grid media, one after the other.
struct Walk {
  vec3 origin;           // centred world space
  vec3 direction;        // unit
  float tMax;
  uint mode;             // kWalk* of tracker/walk.glsl
  uint medium;           // the one being walked
  uint node;             // of Scene::mediumNodes, where there are many media
  uint entered;          // 1: brick, t, tEnd, tau and the voxel-space ray are valid
  ivec3 brick;
  float t;
  float tEnd;
  float tau;             // majorant optical depth from t to the next tentative collision
  vec3 voxelOrigin;
  vec3 voxelDirection;
  float transmittance;   // product over the segment so far
  float weightSum;       // reservoir: weights seen
  float tHit;            // the collision or emission point; < 0 = none
  uint hitMedium;
  uint hero;             // the channel whose extinction collides; chromatic media only
  vec3 ratio;            // per channel: transmittance (kWalkTransmit), or what has happened against the hero's pdf
  vec2 collect;          // kWalkEmit: where on the ray emission is collected, tMax bounds the line that is measured
  float measure;         // kWalkEmit: integral of the cells' maxima times t^2
};

GPU_END
#endif
