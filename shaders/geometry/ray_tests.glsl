// SPDX-License-Identifier: Apache-2.0
// A ray against boxes, a triangle, a sphere. Directions need no unit length: distances are in their lengths.
// The includer declares the specialization constant kPlantedBug.
#ifndef TYNDALL_GEOMETRY_RAY_TESTS_GLSL
#define TYNDALL_GEOMETRY_RAY_TESTS_GLSL

#include "interop/planted_bugs.h"
#include "interop/surfaces.h"

const uint kNoHit = 0xffffffffu;
const uint kNoInstance = 0xffffffffu;

struct SurfaceHit {
  float t;          // lengths of the direction; the cast's tMax where nothing is hit, 0 where blocked
  uint primitive;   // index into Surfaces::primitives, or kNoHit
  uint instance;    // index into Surfaces::instances, or kNoInstance
  vec2 barycentric; // of a triangle: weights of v1 and v2
  bool blocked;     // any hit: an opaque primitive lies within tMax
};

// What tests read of a ray, in world space or an instance's.
struct CastRay {
  vec3 origin;
  vec3 direction;
  vec3 inverse; // of the direction
  uvec3 axes;   // x, y, z of the space that triangles are tested in; z: where the direction is longest
  vec3 start;   // the origin there
  vec3 shear;   // takes the direction to 0, 0, 1 there
};

// A box that a ray passes by less than this share of its distance counts as hit. Distances to planes are off by up to
// 9 roundings of 2^-24 of the farthest coordinate (divisions of 2.5 ulp, as Vulkan allows, counted), and vertices move
// by 8 where they are sheared: so a triangle that is found by `castTriangle` never lies in a box that is not.
const float kBoxSlack = 1.9073486328125e-6; // 2^-19

vec3 along(vec3 v, uvec3 axes) { return vec3(v[axes.x], v[axes.y], v[axes.z]); }

CastRay castRay(vec3 origin, vec3 direction) {
  CastRay ray;
  ray.origin = origin;
  ray.direction = direction;
  const vec3 size = abs(direction);
  const float longest = max(size.x, max(size.y, size.z));
  const uint z = size.x == longest ? 0u : (size.y == longest ? 1u : 2u);
  ray.axes = uvec3(z == 2u ? 0u : z + 1u, z == 0u ? 2u : z - 1u, z);
  ray.start = along(origin, ray.axes);
  ray.shear = vec3(direction[ray.axes.x], direction[ray.axes.y], 1.0) / direction[z];
  // Along an axis, 0 times infinity would be no number; this tilt is far below the slack.
  const vec3 least = vec3(1e-18 * longest);
  ray.inverse = 1.0 / mix(direction, mix(least, -least, lessThan(direction, vec3(0.0))), lessThan(size, least));
  return ray;
}

// Where the ray enters and leaves a node's four boxes.
void castBoxes(CastRay ray, BvhNodePtr nodes, uint index, out vec4 enter, out vec4 leave) {
  const vec3 offset = nodes.at[index].origin - ray.origin;
  const vec3 scale = nodes.at[index].scale;
  const vec3 reach = abs(offset) + 255.0 * scale;
  const vec3 slack = (kBoxSlack * max(reach.x, max(reach.y, reach.z))) * abs(ray.inverse);
  const vec3 scaled = scale * ray.inverse;
  const vec3 start = offset * ray.inverse;
  enter = vec4(0.0);
  leave = vec4(3.4e38);
  const uvec4 shift = uvec4(0u, 8u, 16u, 24u);
  for (int axis = 0; axis < 3; ++axis) {
    const uint lower = nodes.at[index].lower[axis];
    const uint upper = nodes.at[index].upper[axis];
    const bool backward = ray.inverse[axis] < 0.0;
    const vec4 near = vec4((uvec4(backward ? upper : lower) >> shift) & 255u);
    const vec4 far = vec4((uvec4(backward ? lower : upper) >> shift) & 255u);
    enter = max(enter, near * scaled[axis] + (start[axis] - slack[axis]));
    leave = min(leave, far * scaled[axis] + (start[axis] + slack[axis]));
  }
}

// Components are picked from memory: what is loaded at computed addresses anyway costs nothing to permute.
vec3 loadAlong(BvhPrimitivePtr primitives, uint index, uint vertex, uvec3 axes) {
  if (vertex == 0u) {
    return vec3(primitives.at[index].v0[axes.x], primitives.at[index].v0[axes.y], primitives.at[index].v0[axes.z]);
  }
  if (vertex == 1u) {
    return vec3(primitives.at[index].v1[axes.x], primitives.at[index].v1[axes.y], primitives.at[index].v1[axes.z]);
  }
  return vec3(primitives.at[index].v2[axes.x], primitives.at[index].v2[axes.y], primitives.at[index].v2[axes.z]);
}

// [Woop13]. The triangle is sheared so that the ray runs along z; a vertex goes to the same floats in all triangles
// that share it. Then products are rounded, not contracted: rounding keeps order, so an edge function has never the
// wrong sign, and at worst is 0, which counts as inside for both sides. A ray through a shared edge or vertex is lost
// by none. Edge-on triangles are passed over: all their edge functions are 0, and so are their neighbours' on those
// edges.
void castTriangle(CastRay ray, BvhPrimitivePtr primitives, uint index, inout SurfaceHit hit) {
  const vec3 v0 = loadAlong(primitives, index, 0u, ray.axes);
  const vec3 v1 = loadAlong(primitives, index, 1u, ray.axes);
  const vec3 v2 = loadAlong(primitives, index, 2u, ray.axes);
  precise vec3 a = v0 - ray.start;
  precise vec3 b = v1 - ray.start;
  precise vec3 c = v2 - ray.start;
  precise vec2 sheared0 = a.xy - ray.shear.xy * a.z;
  precise vec2 sheared1 = b.xy - ray.shear.xy * b.z;
  precise vec2 sheared2 = c.xy - ray.shear.xy * c.z;
  precise vec3 positive = vec3(sheared2.x, sheared0.x, sheared1.x) * vec3(sheared1.y, sheared2.y, sheared0.y);
  precise vec3 negative = vec3(sheared2.y, sheared0.y, sheared1.y) * vec3(sheared1.x, sheared2.x, sheared0.x);
  precise vec3 edges = positive - negative;
  const float least = min(edges.x, min(edges.y, edges.z));
  const float most = max(edges.x, max(edges.y, edges.z));
  const float sum = edges.x + edges.y + edges.z;
  const bool outside = kPlantedBug == kBugExclusiveEdges ? least <= 0.0 && most >= 0.0 : least < 0.0 && most > 0.0;
  if (outside || sum == 0.0) {
    return;
  }
  // The distance to the plane: exact where it runs along axes, however large the triangle. It lies between those of the
  // vertices, which bounds it where the ray grazes the plane.
  const vec3 normal = cross(v1 - v0, v2 - v0);
  const float steepness = ray.shear.x * normal.x + ray.shear.y * normal.y + normal.z;
  const vec3 depths = vec3(a.z, b.z, c.z) * ray.shear.z;
  const float nearest = min(depths.x, min(depths.y, depths.z));
  const float farthest = max(depths.x, max(depths.y, depths.z));
  const float t = clamp(dot(a, normal) * ray.shear.z / steepness, nearest, farthest);
  if (steepness != 0.0 && t > 0.0 && t < hit.t) {
    hit.t = t;
    hit.primitive = index;
    hit.barycentric = edges.yz / sum;
  }
}

// By the perpendicular from the centre, and by Viete where the two distances nearly cancel [Haines19]. Whether the
// origin lies inside decides which of them count: a ray that leaves the surface outward does not meet it again.
void castSphere(CastRay ray, BvhPrimitivePtr primitives, uint index, inout SurfaceHit hit) {
  const vec3 toCentre = primitives.at[index].v0 - ray.origin;
  const float radius = primitives.at[index].v1.x;
  const float a = dot(ray.direction, ray.direction);
  const float middle = dot(toCentre, ray.direction) / a;
  const vec3 offset = toCentre - middle * ray.direction;
  const float discriminant = (radius * radius - dot(offset, offset)) / a;
  const float distance = length(toCentre);
  const bool inside = distance < radius;
  if (!inside && (discriminant < 0.0 || middle < 0.0)) {
    return;
  }
  const float halfChord = sqrt(max(discriminant, 0.0));
  const float farther = abs(middle) + halfChord;
  const float product = (distance - radius) * (distance + radius) / a; // of both distances
  // From outside the nearer one, from inside the one ahead.
  const float t = inside && middle >= 0.0 ? farther : abs(product) / farther;
  if (t > 0.0 && t < hit.t) {
    hit.t = t;
    hit.primitive = index;
    hit.barycentric = vec2(0.0);
  }
}

#endif
