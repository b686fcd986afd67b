// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/acceleration.h"
#include "gpu/buffer.h"
#include "gpu/device.h"
#include "gpu/image.h"

#include <vulkan/vulkan_raii.hpp>

#include <array>
#include <functional>

/// Private to src/gpu: the Vulkan objects behind the public classes.
namespace tyndall::gpu {

/// What a device must have for ray queries, beside their features.
inline constexpr std::array kRayQueryExtensions{VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                                VK_KHR_RAY_QUERY_EXTENSION_NAME,
                                                VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};

/// Bindings of the one descriptor set: images (shaders/medium/atlas.glsl), then on devices that have ray queries the
/// acceleration structure (shaders/geometry/ray_query.glsl).
inline constexpr std::uint32_t kAtlasImages = 3;
inline constexpr std::uint32_t kRayTreeBinding = 3;

struct Instance {
  vk::raii::Context context;
  vk::raii::Instance instance{nullptr};
  vk::raii::DebugUtilsMessengerEXT messenger{nullptr};
  std::vector<std::string> messages;
};

/// @throws Error without a loader, a driver or (if asked for) the validation layer.
std::unique_ptr<Instance> makeInstance(bool validation);
DeviceInfo describe(const vk::raii::PhysicalDevice& physical, std::uint32_t index);

struct Device::Impl {
  std::unique_ptr<Instance> instance;
  vk::raii::PhysicalDevice physical{nullptr};
  vk::raii::Device device{nullptr};
  vk::raii::Queue queue{nullptr};
  vk::raii::CommandPool pool{nullptr};
  vk::raii::PipelineCache cache{nullptr};
  vk::raii::DescriptorSetLayout setLayout{nullptr};
  vk::PhysicalDeviceMemoryProperties memory;
  std::filesystem::path cacheFile;
  DeviceInfo info;
  std::uint64_t allocated = 0;
  std::uint64_t peak = 0;

  std::uint32_t memoryType(std::uint32_t allowed, vk::MemoryPropertyFlags wanted) const;
  /// Allocates and accounts. @throws Error with the size and the fix when memory runs out.
  vk::raii::DeviceMemory allocate(const vk::MemoryRequirements& need, vk::MemoryPropertyFlags wanted, bool address);
  void released(std::uint64_t bytes) { allocated -= bytes; }
  /// Records, submits and waits.
  void runCommands(const std::function<void(const vk::raii::CommandBuffer&)>& record);
};

struct RawBuffer::Impl {
  Device::Impl* device = nullptr;
  vk::raii::Buffer buffer{nullptr};
  vk::raii::DeviceMemory memory{nullptr};
  std::uint64_t bytes = 0;
};

struct AccelerationStructure::Impl {
  RawBuffer storage;
  vk::raii::AccelerationStructureKHR structure{nullptr};
  std::uint64_t address = 0;
};

struct Image3D::Impl {
  Device::Impl* device = nullptr;
  vk::raii::Image image{nullptr};
  vk::raii::DeviceMemory memory{nullptr};
  vk::raii::ImageView view{nullptr};
  std::uint64_t bytes = 0;
};

} // namespace tyndall::gpu
