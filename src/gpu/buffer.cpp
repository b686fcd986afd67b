// SPDX-License-Identifier: Apache-2.0
#include "gpu/buffer.h"

#include "base/error.h"
#include "gpu/vulkan_impl.h"

#include <algorithm>

namespace tyndall::gpu {
namespace {

using Property = vk::MemoryPropertyFlagBits;

vk::MemoryPropertyFlags propertiesOf(const Device::Impl& device, std::uint32_t allowed, Memory memory) {
  if (memory == Memory::Device) {
    return Property::eDeviceLocal;
  }
  const vk::MemoryPropertyFlags cached = Property::eHostVisible | Property::eHostCoherent | Property::eHostCached;
  for (std::uint32_t i = 0; i < device.memory.memoryTypeCount; ++i) {
    if ((allowed & (1u << i)) != 0 && (device.memory.memoryTypes[i].propertyFlags & cached) == cached) {
      return cached;
    }
  }
  return Property::eHostVisible | Property::eHostCoherent;
}

vk::BufferUsageFlags usageOf(BufferUse use) {
  using Usage = vk::BufferUsageFlagBits;
  const vk::BufferUsageFlags all =
      Usage::eStorageBuffer | Usage::eShaderDeviceAddress | Usage::eTransferSrc | Usage::eTransferDst;
  switch (use) {
  case BufferUse::Data:
    return all;
  case BufferUse::RayGeometry:
    return all | Usage::eAccelerationStructureBuildInputReadOnlyKHR;
  case BufferUse::RayTree:
    return all | Usage::eAccelerationStructureStorageKHR;
  }
  return all;
}

/// Memory that both sides see, on the way to or from a buffer.
struct Staging {
  vk::Buffer buffer;
  std::byte* mapped;
};

} // namespace

RawBuffer::RawBuffer(const Device& device, std::size_t bytes, Memory memory, BufferUse use)
    : impl_(std::make_unique<Impl>()), bytes_(bytes) {
  Device::Impl& owner = device.impl();
  impl_->device = &owner;
  const std::size_t size = std::max<std::size_t>(bytes, 4);
  impl_->buffer = vk::raii::Buffer(owner.device, {{}, size, usageOf(use)});
  const vk::MemoryRequirements need = impl_->buffer.getMemoryRequirements();
  const vk::MemoryPropertyFlags wanted = propertiesOf(owner, need.memoryTypeBits, memory);
  impl_->memory = owner.allocate(need, wanted, true);
  impl_->bytes = need.size;
  impl_->buffer.bindMemory(*impl_->memory, 0);
  address_ = owner.device.getBufferAddress({*impl_->buffer});
  if (wanted & Property::eHostVisible) {
    mapped_ = static_cast<std::byte*>(impl_->memory.mapMemory(0, VK_WHOLE_SIZE));
  }
}

RawBuffer::RawBuffer() = default;

RawBuffer::RawBuffer(RawBuffer&& other) noexcept { *this = std::move(other); }

RawBuffer& RawBuffer::operator=(RawBuffer&& other) noexcept {
  std::swap(impl_, other.impl_);
  std::swap(bytes_, other.bytes_);
  std::swap(address_, other.address_);
  std::swap(mapped_, other.mapped_);
  return *this;
}

RawBuffer::~RawBuffer() {
  if (impl_ && impl_->bytes > 0) {
    impl_->device->released(impl_->bytes);
  }
}

/// In slices: a volume of gigabytes must not need its size again in host-visible memory.
template <class Copy>
void RawBuffer::throughStaging(std::size_t bytes, const Copy& copy) const {
  constexpr std::size_t kStagingBytes = std::size_t{64} << 20;
  Device::Impl& owner = *impl_->device;
  const std::size_t slice = std::min(kStagingBytes, bytes);
  const vk::raii::Buffer buffer(
      owner.device, {{}, slice, vk::BufferUsageFlagBits::eTransferSrc | vk::BufferUsageFlagBits::eTransferDst});
  const vk::MemoryRequirements need = buffer.getMemoryRequirements();
  const vk::raii::DeviceMemory memory = owner.allocate(need, Property::eHostVisible | Property::eHostCoherent, false);
  buffer.bindMemory(*memory, 0);
  const Staging staging{*buffer, static_cast<std::byte*>(memory.mapMemory(0, VK_WHOLE_SIZE))};
  for (std::size_t first = 0; first < bytes; first += slice) {
    copy(staging, first, std::min(slice, bytes - first));
  }
  owner.released(need.size);
}

void RawBuffer::write(std::span<const std::byte> data, std::size_t offset) {
  TYNDALL_CHECK(offset + data.size() <= bytes_);
  if (data.empty()) {
    return;
  }
  if (mapped_ != nullptr) {
    std::memcpy(mapped_ + offset, data.data(), data.size());
    return;
  }
  throughStaging(data.size(), [&](const Staging& staging, std::size_t first, std::size_t count) {
    std::memcpy(staging.mapped, data.data() + first, count);
    impl_->device->runCommands([&](const vk::raii::CommandBuffer& commands) {
      commands.copyBuffer(staging.buffer, *impl_->buffer, vk::BufferCopy(0, offset + first, count));
    });
  });
}

void RawBuffer::read(std::span<std::byte> data, std::size_t offset) const {
  TYNDALL_CHECK(offset + data.size() <= bytes_);
  if (data.empty()) {
    return;
  }
  if (mapped_ != nullptr) {
    std::memcpy(data.data(), mapped_ + offset, data.size());
    return;
  }
  throughStaging(data.size(), [&](const Staging& staging, std::size_t first, std::size_t count) {
    impl_->device->runCommands([&](const vk::raii::CommandBuffer& commands) {
      commands.copyBuffer(*impl_->buffer, staging.buffer, vk::BufferCopy(offset + first, 0, count));
    });
    std::memcpy(data.data() + first, staging.mapped, count);
  });
}

void RawBuffer::fillZero() {
  if (bytes_ == 0) {
    return;
  }
  if (mapped_ != nullptr) {
    std::memset(mapped_, 0, bytes_);
    return;
  }
  impl_->device->runCommands(
      [&](const vk::raii::CommandBuffer& commands) { commands.fillBuffer(*impl_->buffer, 0, VK_WHOLE_SIZE, 0); });
}

} // namespace tyndall::gpu
