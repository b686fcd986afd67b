// SPDX-License-Identifier: Apache-2.0
#include "gpu/kernel.h"

#include "base/error.h"
#include "gpu/specialise.h"
#include "gpu/spirv.h"
#include "gpu/vulkan_impl.h"

#include <algorithm>

namespace tyndall::gpu {
namespace {

constexpr std::uint32_t kPushBytes = 128; // what every Vulkan device allows

vk::raii::DescriptorPool makePool(const Device::Impl& device) {
  std::vector<vk::DescriptorPoolSize> sizes{{vk::DescriptorType::eSampledImage, kAtlasImages}};
  if (device.info.rayQuery) { // the layout has it, used or not
    sizes.emplace_back(vk::DescriptorType::eAccelerationStructureKHR, 1);
  }
  return {device.device, {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes}};
}

/// A single texel for each format that the scene lacks: descriptors that are never read must still be bound, partially
/// bound sets being more than some drivers offer (Mesa 22.3).
std::array<Image3D, 3> makeStandIns(const Device& device, const AtlasImages& images) {
  constexpr std::array<std::byte, 4> kBlack{};
  std::array<Image3D, 3> standIns;
  const std::array<const Image3D*, 3> slots{images.uint8, images.half, images.single};
  constexpr std::array kFormats{TexelFormat::Uint8, TexelFormat::Half, TexelFormat::Float};
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (slots[i] == nullptr || slots[i]->empty()) {
      standIns[i] = Image3D(device, glm::uvec3(1), kFormats[i], std::span(kBlack).first(std::size_t{1} << i));
    }
  }
  return standIns;
}

void bindImages(const vk::raii::Device& device, vk::DescriptorSet set, const AtlasImages& images,
                const std::array<Image3D, 3>& standIns) {
  const std::array<const Image3D*, 3> slots{images.uint8, images.half, images.single};
  for (std::uint32_t binding = 0; binding < slots.size(); ++binding) {
    const Image3D& image = standIns[binding].empty() ? *slots[binding] : standIns[binding];
    const vk::DescriptorImageInfo info({}, *image.impl().view, vk::ImageLayout::eShaderReadOnlyOptimal);
    device.updateDescriptorSets(vk::WriteDescriptorSet(set, binding, 0, vk::DescriptorType::eSampledImage, info), {});
  }
}

void bindRays(const vk::raii::Device& device, vk::DescriptorSet set, const AccelerationStructure& rays) {
  const vk::WriteDescriptorSetAccelerationStructureKHR structure(*rays.impl().structure);
  vk::WriteDescriptorSet write(set, kRayTreeBinding, 0, 1, vk::DescriptorType::eAccelerationStructureKHR);
  write.pNext = &structure;
  device.updateDescriptorSets(write, {});
}

} // namespace

struct Kernel::Impl {
  Device::Impl* device = nullptr;
  std::array<Image3D, 3> standIns;
  vk::raii::DescriptorPool pool{nullptr};
  vk::raii::DescriptorSet set{nullptr};
  vk::raii::PipelineLayout layout{nullptr};
  vk::raii::Pipeline pipeline{nullptr};
};

Kernel::Kernel(const Device& device, std::span<const std::uint32_t> spirv, std::span<const SpecEntry> spec,
               const AtlasImages& images, const AccelerationStructure* rays)
    : impl_(std::make_unique<Impl>()) {
  const SpirvInfo info = readSpirv(spirv);
  workgroupSize_ = info.workgroupSize;
  Device::Impl& owner = device.impl();
  impl_->device = &owner;
  impl_->pool = makePool(owner);
  impl_->set = std::move(vk::raii::DescriptorSets(owner.device, {*impl_->pool, *owner.setLayout}).front());
  if (info.usesImages) {
    impl_->standIns = makeStandIns(device, images);
    bindImages(owner.device, *impl_->set, images, impl_->standIns);
  }
  if (rays != nullptr) {
    bindRays(owner.device, *impl_->set, *rays);
  }
  const vk::PushConstantRange push(vk::ShaderStageFlagBits::eCompute, 0, kPushBytes);
  impl_->layout = vk::raii::PipelineLayout(owner.device, {{}, *owner.setLayout, push});

  const std::vector<std::uint32_t> words = specialiseOnce(spirv, spec, owner.cacheFile.parent_path());
  spirvBytes_ = words.size() * sizeof(std::uint32_t);
  const vk::raii::ShaderModule shader(owner.device, {{}, spirvBytes_, words.data()});
  const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *shader, "main");
  impl_->pipeline =
      vk::raii::Pipeline(owner.device, owner.cache, vk::ComputePipelineCreateInfo({}, stage, *impl_->layout));
}

Kernel::Kernel(Kernel&&) noexcept = default;
Kernel::~Kernel() = default;

void Kernel::runRaw(std::span<const std::byte> push, std::uint32_t invocations) const {
  const std::uint32_t groups = (invocations + workgroupSize_ - 1) / workgroupSize_;
  if (groups == 0) {
    return;
  }
  impl_->device->runCommands([&](const vk::raii::CommandBuffer& commands) {
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *impl_->pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *impl_->layout, 0, *impl_->set, {});
    commands.pushConstants<std::byte>(
        *impl_->layout, vk::ShaderStageFlagBits::eCompute, 0,
        vk::ArrayProxy<const std::byte>(static_cast<std::uint32_t>(push.size()), push.data()));
    commands.dispatch(groups, 1, 1);
  });
}

} // namespace tyndall::gpu
