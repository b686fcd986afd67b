// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"
#include "interop/interop.h"

#include <memory>
#include <span>

namespace tyndall::gpu {

class AccelerationStructure;

/// What a ray finds at a place of the world: the structure of an object, seen through a transform.
struct RayPlace {
  const AccelerationStructure* object = nullptr;
  glm::mat4x3 worldFromObject{1.0f};
  std::uint32_t index = 0; ///< handed to the kernel (custom index), below kRayPlaceIndices
};
inline constexpr std::uint32_t kRayPlaceIndices = 1u << 24;

/// A tree of the device's own making, for ray queries (VK_KHR_ray_query). Only on devices whose info says rayQuery.
/// All three builders wait for the device. @throws Error on exhausted memory.
class AccelerationStructure {
public:
  /// @param corners three per triangle, finite; what has no area is never hit.
  /// @param opaque hits count without being confirmed by the kernel.
  static AccelerationStructure ofTriangles(const Device& device, std::span<const glm::vec3> corners, bool opaque);
  /// The box [-1, 1]^3, whose content the kernel intersects.
  static AccelerationStructure ofBox(const Device& device);
  /// The world. The objects must outlive it.
  static AccelerationStructure ofPlaces(const Device& device, std::span<const RayPlace> places);

  AccelerationStructure(AccelerationStructure&&) noexcept;
  AccelerationStructure& operator=(AccelerationStructure&&) noexcept;
  ~AccelerationStructure();

  std::size_t bytes() const;

  struct Impl;
  Impl& impl() const { return *impl_; }

private:
  AccelerationStructure();

  std::unique_ptr<Impl> impl_;
};

} // namespace tyndall::gpu
