// SPDX-License-Identifier: Apache-2.0
// Rays through the surfaces by VK_KHR_ray_query: ray.glsl's surfaceCast with the same contract. What is built, and how
// it is numbered, is gpu_scene/ray_query.h's.
// The includer declares the specialization constants kSpheres and kInstances: whether the scene has any.
#ifndef TYNDALL_GEOMETRY_RAY_QUERY_GLSL
#define TYNDALL_GEOMETRY_RAY_QUERY_GLSL

#extension GL_EXT_ray_query : require

#include "geometry/ray_tests.glsl"

layout(set = 0, binding = 3) uniform accelerationStructureEXT rayTree;

// Of the place that a ray meets: the first is the world's triangles, then come the instances, then spheres.
uint queryInstance(uint place) {
  const uint before = kPlantedBug == kBugRayPlace ? 2u : 1u;
  return kInstances && place >= before ? place - before : kNoInstance;
}

// The device's own test tells which triangle is hit; ours where, with errors that geometry/offset.glsl knows. At an edge
// it may miss, and the device's answer stands: the neighbour's is as good.
void queryPlaceOfHit(SurfacesPtr surfaces, vec3 origin, vec3 direction, inout SurfaceHit hit) {
  if (kInstances && hit.instance != kNoInstance) {
    const mat4x3 objectFromWorld = surfaces.at[0].instances.at[hit.instance].objectFromWorld;
    origin = objectFromWorld * vec4(origin, 1.0);
    direction = mat3(objectFromWorld) * direction;
  }
  SurfaceHit own = SurfaceHit(3.4e38, kNoHit, kNoInstance, vec2(0.0), false);
  castTriangle(castRay(origin, direction), surfaces.at[0].primitives, hit.primitive, own);
  if (own.primitive != kNoHit) {
    hit.t = own.t;
    hit.barycentric = own.barycentric;
  }
}

// Whether a candidate counts at once. With anyHit what lets something pass does not.
bool queryCounts(BvhPrimitivePtr primitives, uint primitive, bool anyHit) {
  return !anyHit || kPlantedBug == kBugRayCounts || (primitives.at[primitive].id & kPrimitiveOpaque) != 0u;
}

// The closest surface within (0, tMax). With anyHit an opaque one ends the search where it is found (blocked, t = 0);
// what is not blocked hits nothing, or the closest surface, which lets something pass: cast again from there.
// `direction` is not 0 and needs no unit length.
SurfaceHit surfaceCast(SurfacesPtr surfaces, vec3 origin, vec3 direction, float tMax, bool anyHit) {
  BvhPrimitivePtr primitives = surfaces.at[0].primitives;
  SurfaceHit hit = SurfaceHit(tMax, kNoHit, kNoInstance, vec2(0.0), false);
  if (!(tMax > 0.0)) { // which a query may not be asked
    return hit;
  }
  // The query keeps the closest of what counts; with anyHit it ends with the first, and `hit` keeps what does not.
  const uint flags = anyHit ? gl_RayFlagsTerminateOnFirstHitEXT : gl_RayFlagsOpaqueEXT;
  rayQueryEXT query;
  rayQueryInitializeEXT(query, rayTree, flags, 0xffu, origin, 0.0, direction, tMax);
  [[dont_unroll]] while (rayQueryProceedEXT(query)) {
    const uint first = uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, false));
    if (kSpheres && rayQueryGetIntersectionTypeEXT(query, false) == gl_RayQueryCandidateIntersectionAABBEXT) {
      const bool counts = queryCounts(primitives, first, anyHit);
      const bool kept = rayQueryGetIntersectionTypeEXT(query, true) != gl_RayQueryCommittedIntersectionNoneEXT;
      SurfaceHit found = SurfaceHit(hit.t, kNoHit, kNoInstance, vec2(0.0), false);
      if (counts) {
        found.t = kept ? rayQueryGetIntersectionTEXT(query, true) : tMax;
      }
      if (kPlantedBug != kBugRaySpheres) {
        castSphere(castRay(origin, direction), primitives, first, found);
      }
      if (found.primitive != kNoHit && counts) {
        rayQueryGenerateIntersectionEXT(query, found.t);
      } else if (found.primitive != kNoHit) {
        hit = found;
      }
    } else {
      const uint primitive = first + uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
      const float t = rayQueryGetIntersectionTEXT(query, false);
      if (queryCounts(primitives, primitive, anyHit)) {
        rayQueryConfirmIntersectionEXT(query);
      } else if (t < hit.t) {
        hit = SurfaceHit(t, primitive, queryInstance(uint(rayQueryGetIntersectionInstanceIdEXT(query, false))),
                         rayQueryGetIntersectionBarycentricsEXT(query, false), false);
      }
    }
  }
  const uint kept = rayQueryGetIntersectionTypeEXT(query, true);
  if (kept != gl_RayQueryCommittedIntersectionNoneEXT) {
    hit.t = rayQueryGetIntersectionTEXT(query, true);
    hit.primitive = uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, true));
    hit.instance = kNoInstance;
    if (kept == gl_RayQueryCommittedIntersectionTriangleEXT) {
      hit.primitive += uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, true));
      hit.instance = queryInstance(uint(rayQueryGetIntersectionInstanceIdEXT(query, true)));
      hit.barycentric = rayQueryGetIntersectionBarycentricsEXT(query, true);
    }
  }
  if (anyHit && kept != gl_RayQueryCommittedIntersectionNoneEXT) {
    hit.t = 0.0;
    hit.blocked = true;
  } else if (hit.primitive != kNoHit && (primitives.at[hit.primitive].id & kPrimitiveKindMask) == kPrimitiveTriangle) {
    queryPlaceOfHit(surfaces, origin, direction, hit);
  }
  return hit;
}

#endif
