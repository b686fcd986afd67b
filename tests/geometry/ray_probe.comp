#version 460
// SPDX-License-Identifier: Apache-2.0
// Casts given rays; see ray_probe_io.h.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "ray_probe_io.h"

layout(constant_id = 0) const bool kSpheres = true;
layout(constant_id = 1) const bool kInstances = true;
layout(constant_id = 2) const uint kPlantedBug = 0u;

#include "geometry/offset.glsl"
#include "geometry/ray.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { RayProbeInputs io; };

// One site of the traversal: what to cast next depends on what was hit.
void main() {
  const uint invocation = gl_GlobalInvocationID.x;
  if (invocation >= io.count) {
    return;
  }
  const ProbeRay ray = io.rays.at[invocation];
  vec3 origin = ray.origin;
  vec3 direction = ray.direction;
  float tMax = ray.tMax;
  bool anyHit = ray.anyHit != 0u;
  SurfacePoint points[2];
  points[0] = SurfacePoint(vec3(0.0), vec3(0.0), 0.0);
  points[1] = points[0];
  SurfaceHit hit;
  const uint casts = io.mode == kRayCast ? 1u : (io.mode == kRayLeave ? 2u : 3u);
  [[dont_unroll]] for (uint i = 0u; i < casts; ++i) {
    hit = surfaceCast(io.surfaces, origin, direction, tMax, anyHit);
    if (hit.primitive == kNoHit || i == 2u) {
      break;
    }
    SurfacePoint point = surfacePoint(io.surfaces, hit, origin, direction);
    if (io.plant == kPlantNoOffset) {
      point.error = 0.0;
    }
    if (i == 0u) {
      points[0] = point;
      direction = ray.next;
      origin = io.mode == kRayLeave ? offsetOrigin(point, direction) : origin;
    } else {
      origin = offsetOrigin(points[0], point.position - points[0].position);
      anyHit = true;
      if (io.plant == kPlantNoOffset) {
        direction = normalize(point.position - origin);
        tMax = length(point.position - origin);
      } else {
        tMax = shadowDistance(origin, point, direction);
      }
    }
  }
  io.hits.at[invocation] = ProbeHit(hit.t, hit.primitive, hit.instance, hit.barycentric, uint(hit.blocked),
                                    points[0].position, points[0].normal, points[0].error);
}
