// SPDX-License-Identifier: Apache-2.0
// Rays through the surfaces' tree: the closest hit, or whether anything opaque is in the way.
// The includer declares the specialization constants kSpheres and kInstances: whether the scene has any.
#ifndef TYNDALL_GEOMETRY_RAY_GLSL
#define TYNDALL_GEOMETRY_RAY_GLSL

#include "geometry/ray_tests.glsl"

const uint kCastMarker = kBvhEmpty; // on the stack: below it wait the world's entries, above it an instance's

// Private memory, and not the function's, so that helpers share it without copies.
uint castStack[kBvhStack];
float castEntries[kBvhStack]; // where the ray enters them
uint castSize;

void castPush(uint entry, float t) {
  castStack[castSize] = entry;
  castEntries[castSize] = t;
  ++castSize;
}

void castOrder(inout vec2 keys, inout uvec2 children) {
  if (keys.x > keys.y) {
    keys = keys.yx;
    children = children.yx;
  }
}

// Pushes the children that the ray enters before tMax, the farthest first. Returns the nearest, or kBvhEmpty.
uint castNode(CastRay ray, BvhNodePtr nodes, uint index, float tMax) {
  const float never = 3.4e38;
  vec4 enter;
  vec4 leave;
  castBoxes(ray, nodes, index, enter, leave);
  uvec4 children = uvec4(nodes.at[index].children[0], nodes.at[index].children[1], nodes.at[index].children[2],
                         nodes.at[index].children[3]);
  for (int i = 0; i < 4; ++i) {
    enter[i] = children[i] != kBvhEmpty && enter[i] <= min(leave[i], tMax) ? enter[i] : never;
  }
  // A network of five comparisons.
  vec2 keys;
  uvec2 pair;
#define ORDER(i, j)                                                                                                    \
  keys = vec2(enter[i], enter[j]);                                                                                     \
  pair = uvec2(children[i], children[j]);                                                                              \
  castOrder(keys, pair);                                                                                               \
  enter[i] = keys.x;                                                                                                   \
  enter[j] = keys.y;                                                                                                   \
  children[i] = pair.x;                                                                                                \
  children[j] = pair.y;
  ORDER(0, 1)
  ORDER(2, 3)
  ORDER(0, 2)
  ORDER(1, 3)
  ORDER(1, 2)
#undef ORDER
  for (int i = 3; i > 0; --i) {
    if (enter[i] < never) {
      castPush(children[i], enter[i]);
    }
  }
  return enter[0] < never ? children[0] : kBvhEmpty;
}

// Tests a leaf's primitives up to its first instance. Returns that instance's index into `primitives`, or kNoHit.
uint castLeaf(CastRay ray, BvhPrimitivePtr primitives, uint leaf, uint instance, bool anyHit, inout SurfaceHit hit) {
  const uint first = leaf & kBvhFirstMask;
  const uint last = first + ((leaf >> kBvhCountShift) & (kBvhLargestLeaf - 1u));
  [[dont_unroll]] for (uint i = first; i <= last; ++i) {
    const uint id = primitives.at[i].id;
    const uint kind = id & kPrimitiveKindMask;
    const float before = hit.t;
    if (kInstances && kind == kPrimitiveInstance) {
      if (i < last) { // what is left of the leaf comes after the instance
        castPush(kBvhLeaf | ((last - i - 1u) << kBvhCountShift) | (i + 1u), 0.0);
      }
      return i;
    }
    if (kSpheres && kind == kPrimitiveSphere) {
      castSphere(ray, primitives, i, hit);
    } else {
      castTriangle(ray, primitives, i, hit);
    }
    if (hit.t < before) {
      hit.instance = instance;
      hit.blocked = anyHit && (id & kPrimitiveOpaque) != 0u;
      if (hit.blocked) {
        return kNoHit;
      }
    }
  }
  return kNoHit;
}

// The next entry that the ray reaches before `tMax`, or kBvhEmpty at the end. Leaves an instance where it finds the
// marker.
uint castPop(vec3 origin, vec3 direction, float tMax, inout CastRay ray, inout uint instance) {
  [[dont_unroll]] while (castSize > 0u) {
    --castSize;
    const uint entry = castStack[castSize];
    if (kInstances && entry == kCastMarker) {
      ray = castRay(origin, direction);
      instance = kNoInstance;
    } else if (castEntries[castSize] < tMax) {
      return entry;
    }
  }
  return kBvhEmpty;
}

// The closest surface within (0, tMax). With anyHit an opaque one ends the search where it is found (blocked, t = 0);
// what is not blocked hits nothing, or a surface that lets something pass and is the closest: cast again from there.
// `direction` is not 0 and needs no unit length.
SurfaceHit surfaceCast(SurfacesPtr surfaces, vec3 origin, vec3 direction, float tMax, bool anyHit) {
  BvhNodePtr nodes = surfaces.at[0].nodes;
  BvhPrimitivePtr primitives = surfaces.at[0].primitives;
  SurfaceHit hit = SurfaceHit(tMax, kNoHit, kNoInstance, vec2(0.0), false);
  CastRay ray = castRay(origin, direction);
  uint instance = kNoInstance;
  uint current = 0u;
  castSize = 0u;
  [[dont_unroll]] while (current != kBvhEmpty) {
    if ((current & kBvhLeaf) == 0u) {
      current = castNode(ray, nodes, current, hit.t);
    } else {
      const uint found = castLeaf(ray, primitives, current, instance, anyHit, hit);
      current = kBvhEmpty;
      if (hit.blocked) {
        hit.t = 0.0;
        return hit;
      }
      if (kInstances && found != kNoHit) {
        instance = primitives.at[found].id & kPrimitiveIndexMask;
        const mat4x3 objectFromWorld = surfaces.at[0].instances.at[instance].objectFromWorld;
        ray = castRay(objectFromWorld * vec4(origin, 1.0), mat3(objectFromWorld) * direction);
        castPush(kCastMarker, 0.0);
        current = surfaces.at[0].instances.at[instance].root;
      }
    }
    if (current == kBvhEmpty) {
      current = castPop(origin, direction, hit.t, ray, instance);
    }
  }
  return hit;
}

#endif
