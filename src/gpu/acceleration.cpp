// SPDX-License-Identifier: Apache-2.0
#include "gpu/acceleration.h"

#include "base/error.h"
#include "gpu/vulkan_impl.h"

#include <vector>

namespace tyndall::gpu {
namespace {

template <class T>
RawBuffer uploadGeometry(const Device& device, std::span<const T> values) {
  RawBuffer buffer(device, values.size_bytes(), Memory::Device, BufferUse::RayGeometry);
  buffer.write(std::as_bytes(values));
  return buffer;
}

/// Builds one structure of one geometry.
void build(const Device& device, vk::AccelerationStructureTypeKHR type,
           const vk::AccelerationStructureGeometryKHR& geometry, std::uint32_t count,
           AccelerationStructure::Impl& result) {
  Device::Impl& owner = device.impl();
  vk::AccelerationStructureBuildGeometryInfoKHR info(type, vk::BuildAccelerationStructureFlagBitsKHR::ePreferFastTrace);
  info.setGeometries(geometry);
  const vk::AccelerationStructureBuildSizesInfoKHR sizes =
      owner.device.getAccelerationStructureBuildSizesKHR(vk::AccelerationStructureBuildTypeKHR::eDevice, info, count);
  result.storage = RawBuffer(device, sizes.accelerationStructureSize, Memory::Device, BufferUse::RayTree);
  result.structure = vk::raii::AccelerationStructureKHR(
      owner.device, {{}, *result.storage.impl().buffer, 0, sizes.accelerationStructureSize, type});
  const auto chain =
      owner.physical
          .getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceAccelerationStructurePropertiesKHR>();
  const std::uint64_t alignment =
      chain.get<vk::PhysicalDeviceAccelerationStructurePropertiesKHR>().minAccelerationStructureScratchOffsetAlignment;
  const RawBuffer scratch(device, sizes.buildScratchSize + alignment, Memory::Device);
  info.dstAccelerationStructure = *result.structure;
  info.scratchData.deviceAddress = (scratch.address() + alignment - 1) / alignment * alignment;
  const vk::AccelerationStructureBuildRangeInfoKHR range(count, 0, 0, 0);
  owner.runCommands(
      [&](const vk::raii::CommandBuffer& commands) { commands.buildAccelerationStructuresKHR(info, &range); });
  result.address = owner.device.getAccelerationStructureAddressKHR({*result.structure});
}

vk::TransformMatrixKHR rowsOf(const glm::mat4x3& matrix) {
  vk::TransformMatrixKHR rows;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      rows.matrix[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = matrix[column][row];
    }
  }
  return rows;
}

} // namespace

AccelerationStructure::AccelerationStructure() : impl_(std::make_unique<Impl>()) {}
AccelerationStructure::AccelerationStructure(AccelerationStructure&&) noexcept = default;
AccelerationStructure& AccelerationStructure::operator=(AccelerationStructure&&) noexcept = default;
AccelerationStructure::~AccelerationStructure() = default;

std::size_t AccelerationStructure::bytes() const { return impl_->storage.bytes(); }

AccelerationStructure AccelerationStructure::ofTriangles(const Device& device, std::span<const glm::vec3> corners,
                                                         bool opaque) {
  TYNDALL_CHECK(device.info().rayQuery && corners.size() % 3 == 0 && !corners.empty());
  const RawBuffer vertices = uploadGeometry(device, corners);
  const auto last = static_cast<std::uint32_t>(corners.size() - 1);
  const vk::AccelerationStructureGeometryTrianglesDataKHR triangles(vk::Format::eR32G32B32Sfloat,
                                                                    vk::DeviceOrHostAddressConstKHR(vertices.address()),
                                                                    sizeof(glm::vec3), last, vk::IndexType::eNoneKHR);
  const vk::AccelerationStructureGeometryKHR geometry(vk::GeometryTypeKHR::eTriangles, triangles,
                                                      opaque ? vk::GeometryFlagsKHR(vk::GeometryFlagBitsKHR::eOpaque)
                                                             : vk::GeometryFlagsKHR());
  AccelerationStructure result;
  build(device, vk::AccelerationStructureTypeKHR::eBottomLevel, geometry,
        static_cast<std::uint32_t>(corners.size() / 3), *result.impl_);
  return result;
}

AccelerationStructure AccelerationStructure::ofBox(const Device& device) {
  TYNDALL_CHECK(device.info().rayQuery);
  constexpr std::array kBox{-1.0f, -1.0f, -1.0f, 1.0f, 1.0f, 1.0f};
  const RawBuffer box = uploadGeometry(device, std::span<const float>(kBox));
  const vk::AccelerationStructureGeometryAabbsDataKHR boxes(vk::DeviceOrHostAddressConstKHR(box.address()),
                                                            sizeof(kBox));
  const vk::AccelerationStructureGeometryKHR geometry(vk::GeometryTypeKHR::eAabbs, boxes);
  AccelerationStructure result;
  build(device, vk::AccelerationStructureTypeKHR::eBottomLevel, geometry, 1, *result.impl_);
  return result;
}

AccelerationStructure AccelerationStructure::ofPlaces(const Device& device, std::span<const RayPlace> places) {
  TYNDALL_CHECK(device.info().rayQuery && !places.empty());
  std::vector<vk::AccelerationStructureInstanceKHR> instances;
  instances.reserve(places.size());
  for (const RayPlace& place : places) {
    TYNDALL_CHECK(place.object != nullptr && place.index < kRayPlaceIndices);
    constexpr std::uint32_t kEveryRay = 0xff;
    instances.emplace_back(rowsOf(place.worldFromObject), place.index, kEveryRay, 0u, vk::GeometryInstanceFlagsKHR(),
                           place.object->impl().address);
  }
  const RawBuffer input = uploadGeometry(device, std::span<const vk::AccelerationStructureInstanceKHR>(instances));
  const vk::AccelerationStructureGeometryInstancesDataKHR data(VK_FALSE,
                                                               vk::DeviceOrHostAddressConstKHR(input.address()));
  const vk::AccelerationStructureGeometryKHR geometry(vk::GeometryTypeKHR::eInstances, data);
  AccelerationStructure result;
  build(device, vk::AccelerationStructureTypeKHR::eTopLevel, geometry, static_cast<std::uint32_t>(instances.size()),
        *result.impl_);
  return result;
}

} // namespace tyndall::gpu
