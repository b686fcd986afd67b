// SPDX-License-Identifier: Apache-2.0
#include "gpu/image.h"

#include "base/error.h"
#include "gpu/vulkan_impl.h"

#include <algorithm>

namespace tyndall::gpu {
namespace {

vk::Format vulkanFormat(TexelFormat format) {
  switch (format) {
  case TexelFormat::Uint8:
    return vk::Format::eR8Uint;
  case TexelFormat::Half:
    return vk::Format::eR16Sfloat;
  case TexelFormat::Float:
    return vk::Format::eR32Sfloat;
  }
  TYNDALL_CHECK(false);
  return {};
}

std::size_t texelBytes(TexelFormat format) {
  return format == TexelFormat::Uint8 ? 1 : format == TexelFormat::Half ? 2 : 4;
}

constexpr vk::ImageSubresourceRange kWhole{vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1};

void transition(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageLayout from, vk::ImageLayout to) {
  const vk::ImageMemoryBarrier2 barrier(vk::PipelineStageFlagBits2::eAllCommands, vk::AccessFlagBits2::eMemoryWrite,
                                        vk::PipelineStageFlagBits2::eAllCommands,
                                        vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite, from, to,
                                        VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, image, kWhole);
  commands.pipelineBarrier2({{}, {}, {}, barrier});
}

/// Copies z slices through a staging buffer of bounded size.
void upload(Device::Impl& owner, vk::Image image, const glm::uvec3& extent, std::span<const std::byte> texels) {
  constexpr std::size_t kStagingBytes = std::size_t{64} << 20;
  const std::size_t sliceBytes = texels.size() / extent.z;
  const std::uint32_t slices = static_cast<std::uint32_t>(
      std::clamp<std::size_t>(kStagingBytes / std::max<std::size_t>(sliceBytes, 1), 1, extent.z));
  RawBuffer::Impl staging;
  staging.buffer = vk::raii::Buffer(owner.device, {{}, sliceBytes * slices, vk::BufferUsageFlagBits::eTransferSrc});
  const vk::MemoryRequirements need = staging.buffer.getMemoryRequirements();
  staging.memory =
      owner.allocate(need, vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent, false);
  staging.buffer.bindMemory(*staging.memory, 0);
  void* target = staging.memory.mapMemory(0, VK_WHOLE_SIZE);
  owner.runCommands([&](const vk::raii::CommandBuffer& commands) {
    transition(commands, image, vk::ImageLayout::eUndefined, vk::ImageLayout::eTransferDstOptimal);
  });
  for (std::uint32_t z = 0; z < extent.z; z += slices) {
    const std::uint32_t depth = std::min(slices, extent.z - z);
    std::memcpy(target, texels.data() + z * sliceBytes, depth * sliceBytes);
    owner.runCommands([&](const vk::raii::CommandBuffer& commands) {
      const vk::BufferImageCopy region(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
                                       {0, 0, static_cast<std::int32_t>(z)}, {extent.x, extent.y, depth});
      commands.copyBufferToImage(*staging.buffer, image, vk::ImageLayout::eTransferDstOptimal, region);
    });
  }
  owner.runCommands([&](const vk::raii::CommandBuffer& commands) {
    transition(commands, image, vk::ImageLayout::eTransferDstOptimal, vk::ImageLayout::eShaderReadOnlyOptimal);
  });
  owner.released(need.size);
}

} // namespace

Image3D::Image3D(const Device& device, const glm::uvec3& extent, TexelFormat format, std::span<const std::byte> texels)
    : impl_(std::make_unique<Impl>()) {
  TYNDALL_CHECK(texels.size() == std::size_t(extent.x) * extent.y * extent.z * texelBytes(format) && !texels.empty());
  Device::Impl& owner = device.impl();
  if (const std::uint32_t edge = std::max({extent.x, extent.y, extent.z}); edge > owner.info.maxImage3D) {
    fail("a 3D image of {} texels an edge is beyond the device's limit of {}; use a \"clip\" box", edge,
         owner.info.maxImage3D);
  }
  impl_->device = &owner;
  impl_->image =
      vk::raii::Image(owner.device, {{},
                                     vk::ImageType::e3D,
                                     vulkanFormat(format),
                                     {extent.x, extent.y, extent.z},
                                     1,
                                     1,
                                     vk::SampleCountFlagBits::e1,
                                     vk::ImageTiling::eOptimal,
                                     vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst});
  const vk::MemoryRequirements need = impl_->image.getMemoryRequirements();
  if (need.size > owner.info.maxAllocation) {
    fail("a 3D image of {:.1f} MB is beyond the device's largest allocation of {:.1f} MB; use a \"clip\" box or "
         "\"storage\": \"unorm8\"",
         double(need.size) * 1e-6, double(owner.info.maxAllocation) * 1e-6);
  }
  impl_->memory = owner.allocate(need, vk::MemoryPropertyFlagBits::eDeviceLocal, false);
  impl_->bytes = need.size;
  impl_->image.bindMemory(*impl_->memory, 0);
  upload(owner, *impl_->image, extent, texels);
  impl_->view =
      vk::raii::ImageView(owner.device, {{}, *impl_->image, vk::ImageViewType::e3D, vulkanFormat(format), {}, kWhole});
}

Image3D::Image3D() = default;
Image3D::Image3D(Image3D&&) noexcept = default;
Image3D& Image3D::operator=(Image3D&& other) noexcept {
  std::swap(impl_, other.impl_);
  return *this;
}

Image3D::~Image3D() {
  if (impl_ && impl_->bytes > 0) {
    impl_->device->released(impl_->bytes);
  }
}

} // namespace tyndall::gpu
