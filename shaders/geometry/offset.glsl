// SPDX-License-Identifier: Apache-2.0
// Where a ray hit, how far float arithmetic may be off there, and where rays from there and to there begin and end.
// The idea is [Pharr23]'s (6.8): bounds of rounding errors instead of an epsilon, so that it holds at any scale.
#ifndef TYNDALL_GEOMETRY_OFFSET_GLSL
#define TYNDALL_GEOMETRY_OFFSET_GLSL

#include "geometry/ray_tests.glsl"

const float kRounding = 5.9604644775390625e-8; // 2^-24

struct SurfacePoint {
  vec3 position; // centred world space
  vec3 normal;   // geometric, unit: of v0 v1 v2 counterclockwise, a sphere's outward; seen through an instance, what is
                 // outside stays so, mirrored or not
  float error;   // distance along the normal, > 0: farther off the surface no rounding takes a ray back to it
};

float largestOf(vec3 v) { return max(abs(v.x), max(abs(v.y), abs(v.z))); }

// The point of a triangle that is next to `near`, which lies within rounding of it.
SurfacePoint trianglePoint(vec3 v0, vec3 v1, vec3 v2, vec3 near) {
  // Edges by their size, so that the squares of the smallest do not vanish.
  vec3 edge1 = v1 - v0;
  vec3 edge2 = v2 - v0;
  edge1 /= largestOf(edge1);
  edge2 /= largestOf(edge2);
  const vec3 across = cross(edge1, edge2);
  const float area = length(across);
  const vec3 normal = across / area;
  const vec3 position = near - dot(near - v0, normal) * normal;
  // The normal's own errors: large for slivers, 0 along the axes of a plane that runs along two.
  const vec3 terms = (abs(edge1.yzx * edge2.zxy) + abs(edge1.zxy * edge2.yzx)) / area;
  const vec3 way = abs(position - v0);
  // 4 roundings of the position, here and as the new origin; 16 of the plane, here and as the next test sees it; 8 of
  // sheared vertices, for neighbours across an edge.
  const float error = kRounding * (4.0 * dot(abs(normal), abs(position)) + 16.0 * dot(terms, way) +
                                   8.0 * min(largestOf(way), largestOf(position)));
  return SurfacePoint(position, normal, error);
}

// Where a ray meets a triangle, off its plane by rounding. From barycentrics, whose errors do not grow with the ray's
// length and stay within the triangle; but along the ray where that is much the shorter one, as on a ground.
vec3 pointNearTriangle(vec3 v0, vec3 v1, vec3 v2, SurfaceHit hit, vec3 origin, vec3 direction) {
  const vec3 way = hit.barycentric.x * (v1 - v0) + hit.barycentric.y * (v2 - v0);
  const float reach = largestOf(origin) + hit.t * largestOf(direction);
  return largestOf(way) > 4.0 * reach ? origin + hit.t * direction : v0 + way;
}

// The point of a sphere in the direction `outward`, which need not be of unit length.
SurfacePoint spherePoint(vec3 centre, float radius, vec3 outward) {
  const vec3 normal = normalize(outward);
  const vec3 position = centre + radius * normal;
  return SurfacePoint(position, normal, kRounding * (4.0 * dot(abs(normal), abs(position)) + 16.0 * radius));
}

mat3 absolute(mat3 m) { return mat3(abs(m[0]), abs(m[1]), abs(m[2])); }

// A point of an object in world space. To its error come those of the way there and of the next ray's way back.
SurfacePoint instancePoint(SurfacePoint object, mat4x3 worldFromObject, mat4x3 objectFromWorld) {
  const vec3 position = worldFromObject * vec4(object.position, 1.0);
  const vec3 across = object.normal * mat3(objectFromWorld);
  const float objectPerWorld = length(across); // of distances along the normal
  const vec3 normal = across / objectPerWorld;
  const vec3 there = absolute(mat3(worldFromObject)) * abs(object.position) + abs(worldFromObject[3]);
  const vec3 back = absolute(mat3(objectFromWorld)) * there + abs(objectFromWorld[3]);
  const float error = 6.0 * kRounding * (dot(abs(normal), there) + dot(abs(object.normal), back) / objectPerWorld);
  return SurfacePoint(position, normal, object.error / objectPerWorld + error);
}

// The point that a ray hit; hit.primitive is not kNoHit.
SurfacePoint surfacePoint(SurfacesPtr surfaces, SurfaceHit hit, vec3 origin, vec3 direction) {
  const bool instanced = kInstances && hit.instance != kNoInstance;
  BvhPrimitivePtr primitives = surfaces.at[0].primitives;
  const uint id = primitives.at[hit.primitive].id;
  const vec3 v0 = primitives.at[hit.primitive].v0;
  const vec3 v1 = primitives.at[hit.primitive].v1;
  mat4x3 objectFromWorld;
  if (instanced) {
    objectFromWorld = surfaces.at[0].instances.at[hit.instance].objectFromWorld;
    origin = objectFromWorld * vec4(origin, 1.0);
    direction = mat3(objectFromWorld) * direction;
  }
  SurfacePoint point;
  if (kSpheres && (id & kPrimitiveKindMask) == kPrimitiveSphere) {
    point = spherePoint(v0, v1.x, (origin - v0) + hit.t * direction);
  } else {
    const vec3 v2 = primitives.at[hit.primitive].v2;
    point = trianglePoint(v0, v1, v2, pointNearTriangle(v0, v1, v2, hit, origin, direction));
  }
  if (instanced) {
    point = instancePoint(point, surfaces.at[0].instances.at[hit.instance].worldFromObject, objectFromWorld);
  }
  return point;
}

// Where a ray that leaves the point begins: beyond the surface's rounding, on the side that `direction` points to.
vec3 offsetOrigin(SurfacePoint point, vec3 direction) {
  return point.position + (dot(direction, point.normal) < 0.0 ? -point.error : point.error) * point.normal;
}

// How far a ray from `origin` (offset already) towards a point of another surface goes before it could meet that
// surface, and its unit direction. A point without a surface has normal 0. 0 where both are one point.
float shadowDistance(vec3 origin, SurfacePoint target, out vec3 direction) {
  // From afar vertices and directions are rounded with the distance.
  target.error += 16.0 * kRounding * length(target.position - origin);
  const vec3 way = offsetOrigin(target, origin - target.position) - origin;
  const float distance = length(way);
  direction = distance > 0.0 ? way / distance : vec3(0.0, 0.0, 1.0);
  return distance * (1.0 - 8.0 * kRounding);
}

#endif
