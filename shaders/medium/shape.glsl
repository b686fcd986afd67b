// SPDX-License-Identifier: Apache-2.0
// Where a ray crosses the convex shapes that bound media. Distances are in world units: an affine map keeps t.
#ifndef TYNDALL_MEDIUM_SHAPE_GLSL
#define TYNDALL_MEDIUM_SHAPE_GLSL

#include "core/numerics.glsl"
#include "interop/scene.h"

// [t0, t1] of a ray inside a box, clipped to [0, tMax]; empty: t0 >= t1.
vec2 boxInterval(vec3 origin, vec3 direction, vec3 boxMin, vec3 boxMax, float tMax) {
  float t0 = 0.0;
  float t1 = tMax;
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) {
      if (origin[axis] < boxMin[axis] || origin[axis] > boxMax[axis]) {
        return vec2(1.0, 0.0);
      }
      continue;
    }
    const float a = (boxMin[axis] - origin[axis]) / direction[axis];
    const float b = (boxMax[axis] - origin[axis]) / direction[axis];
    t0 = max(t0, min(a, b));
    t1 = min(t1, max(a, b));
  }
  return vec2(t0, t1);
}

vec2 sphereInterval(vec3 origin, vec3 direction, vec3 centre, float radius, float tMax) {
  const vec3 toCentre = centre - origin;
  const float a = dot(direction, direction);
  const float middle = dot(toCentre, direction) / a;
  // By the perpendicular to the ray: b^2 - ac loses everything far from the sphere.
  const vec3 offset = toCentre - middle * direction;
  const float discriminant = (radius * radius - dot(offset, offset)) / a;
  if (discriminant <= 0.0) {
    return vec2(1.0, 0.0);
  }
  const float halfChord = sqrt(discriminant);
  return vec2(max(middle - halfChord, 0.0), min(middle + halfChord, tMax));
}

// The part of a ray that lies in a homogeneous medium, clipped to [0, tMax]; empty: x >= y.
vec2 mediumInterval(Medium medium, vec3 origin, vec3 direction, float tMax) {
  if (medium.shape == kShapeUnbounded) {
    return vec2(0.0, tMax);
  }
  const vec3 localOrigin = medium.mediumFromWorld * vec4(origin, 1.0);
  const vec3 localDirection = mat3(medium.mediumFromWorld) * direction;
  if (medium.shape == kShapeBox) {
    return boxInterval(localOrigin, localDirection, medium.shapeMin, medium.shapeMax, tMax);
  }
  return sphereInterval(localOrigin, localDirection, medium.shapeMin, medium.shapeMax.x, tMax);
}

// Optical depth through the homogeneous media but `left` between t = 0 and tMax, in closed form.
float homogeneousDepthWithout(ScenePtr scene, uint left, vec3 origin, vec3 direction, float tMax) {
  float tau = 0.0;
  [[dont_unroll]] for (uint i = 0u; i < scene.at[0].homogeneousCount; ++i) {
    if (i != left) {
      const vec2 interval = mediumInterval(scene.at[0].media.at[i], origin, direction, tMax);
      tau += scene.at[0].media.at[i].sigmaT * max(interval.y - interval.x, 0.0);
    }
  }
  return tau;
}

// Optical depth through all homogeneous media between t = 0 and tMax, in closed form.
float homogeneousDepth(ScenePtr scene, vec3 origin, vec3 direction, float tMax) {
  return homogeneousDepthWithout(scene, 0xffffffffu, origin, direction, tMax);
}

#endif
