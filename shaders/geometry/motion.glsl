// SPDX-License-Identifier: Apache-2.0
// Where surfaces were in the previous frame.
#ifndef TYNDALL_GEOMETRY_MOTION_GLSL
#define TYNDALL_GEOMETRY_MOTION_GLSL

#include "interop/surfaces.h"

// Of a point that is on the surface now: its place then, both in centred world space of this frame. `motion` is that of
// the triangle, sphere or, where there is one, instance.
vec3 previousPlace(SurfacesPtr surfaces, uint motion, vec3 point) {
  if (motion == kNoMotion) {
    return point;
  }
  return surfaces.at[0].motions.at[motion].previousFromNow * vec4(point, 1.0);
}

#endif
