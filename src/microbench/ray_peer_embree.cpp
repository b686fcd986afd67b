// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "microbench/ray_peer.h"

#include <embree3/rtcore.h>

#include <limits>
#include <memory>

namespace tyndall::microbench {
namespace {

struct Scene {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  Scene() : device(rtcNewDevice(nullptr)), scene(rtcNewScene(device)) {}
  ~Scene() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
};

RTCRay rayOf(const interop::BenchRay& ray) {
  RTCRay result{};
  result.org_x = ray.origin.x;
  result.org_y = ray.origin.y;
  result.org_z = ray.origin.z;
  result.dir_x = ray.direction.x;
  result.dir_y = ray.direction.y;
  result.dir_z = ray.direction.z;
  result.tfar = ray.tMax;
  result.mask = ~0u;
  return result;
}

void castAll(const Scene& scene, std::span<const interop::BenchRay> rays, bool anyHit, std::span<float> distances) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (anyHit) {
      RTCRay ray = rayOf(rays[i]);
      rtcOccluded1(scene.scene, &context, &ray);
      distances[i] = ray.tfar < 0.0f ? 0.0f : rays[i].tMax; // it marks hits by -infinity
    } else {
      RTCRayHit ray{};
      ray.ray = rayOf(rays[i]);
      ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene.scene, &context, &ray);
      distances[i] = ray.ray.tfar;
    }
  }
}

} // namespace

std::optional<RayCaster> embreeCaster(const RayScene& scene) {
  auto result = std::make_shared<Scene>();
  RTCGeometry geometry = rtcNewGeometry(result->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const std::size_t count = scene.triangles.size();
  auto* vertices = static_cast<glm::vec3*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), 3 * count));
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, count));
  if (vertices == nullptr || indices == nullptr) {
    fail("Embree has no memory for {} triangles; close other programs", count);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const interop::BvhPrimitive& primitive = scene.triangles[i].primitive;
    vertices[3 * i] = primitive.v0;
    vertices[3 * i + 1] = primitive.v1;
    vertices[3 * i + 2] = primitive.v2;
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) {
      indices[k] = static_cast<std::uint32_t>(k);
    }
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(result->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(result->scene);
  return [result](std::span<const interop::BenchRay> rays, bool anyHit, std::span<float> distances) {
    castAll(*result, rays, anyHit, distances);
  };
}

} // namespace tyndall::microbench
