// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "gpu/vulkan_impl.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <fstream>

namespace tyndall::gpu {
namespace {

int preference(const DeviceInfo& info) {
  static const std::array<std::string, 4> order{"discrete", "integrated", "virtual", "cpu"};
  return static_cast<int>(std::find(order.begin(), order.end(), info.type) - order.begin());
}

bool matches(const DeviceInfo& info, const std::string& select) {
  const bool isIndex = select.find_first_not_of("0123456789") == std::string::npos;
  return select.empty() ||
         (isIndex ? select == std::to_string(info.index) : info.name.find(select) != std::string::npos);
}

DeviceInfo choose(const std::vector<DeviceInfo>& devices, const std::string& select) {
  std::vector<DeviceInfo> fitting;
  std::string reasons;
  for (const DeviceInfo& device : devices) {
    if (!matches(device, select)) {
      reasons += fmt::format("\n  {}: {} (not selected)", device.index, device.name);
    } else if (!device.usable()) {
      reasons += fmt::format("\n  {}: {} lacks {}", device.index, device.name, joinNames(device.missing));
    } else {
      fitting.push_back(device);
    }
  }
  if (devices.empty()) {
    fail("no Vulkan device found; install a Vulkan 1.3 driver, for the CPU the package mesa-vulkan-drivers");
  }
  if (fitting.empty()) {
    fail("no Vulkan device fits{}:{}", select.empty() ? "" : fmt::format(" \"{}\"", select), reasons);
  }
  return *std::min_element(fitting.begin(), fitting.end(),
                           [](const DeviceInfo& a, const DeviceInfo& b) { return preference(a) < preference(b); });
}

std::uint32_t computeFamily(const vk::raii::PhysicalDevice& physical) {
  const auto families = physical.getQueueFamilyProperties();
  for (std::uint32_t i = 0; i < families.size(); ++i) {
    if (families[i].queueFlags & vk::QueueFlagBits::eCompute) {
      return i;
    }
  }
  fail("the Vulkan device has no compute queue");
}

vk::raii::Device makeDevice(const vk::raii::PhysicalDevice& physical, std::uint32_t family, bool rayQuery) {
  const float priority = 1.0f;
  const vk::DeviceQueueCreateInfo queue({}, family, 1, &priority);
  vk::PhysicalDeviceVulkan13Features v13;
  v13.synchronization2 = VK_TRUE;
  v13.maintenance4 = VK_TRUE;
  vk::PhysicalDeviceVulkan12Features v12;
  v12.bufferDeviceAddress = VK_TRUE;
  v12.scalarBlockLayout = VK_TRUE;
  v12.pNext = &v13;
  vk::DeviceCreateInfo info({}, queue);
  info.pNext = &v12;
  vk::PhysicalDeviceRayQueryFeaturesKHR queries(VK_TRUE);
  vk::PhysicalDeviceAccelerationStructureFeaturesKHR structures(VK_TRUE);
  if (rayQuery) {
    info.setPEnabledExtensionNames(kRayQueryExtensions);
    structures.pNext = &queries;
    v13.pNext = &structures;
  }
  return {physical, info};
}

vk::raii::DescriptorSetLayout makeSetLayout(const vk::raii::Device& device, bool rayQuery) {
  std::vector<vk::DescriptorSetLayoutBinding> bindings;
  for (std::uint32_t i = 0; i < kAtlasImages; ++i) {
    bindings.emplace_back(i, vk::DescriptorType::eSampledImage, 1, vk::ShaderStageFlagBits::eCompute);
  }
  if (rayQuery) {
    bindings.emplace_back(kRayTreeBinding, vk::DescriptorType::eAccelerationStructureKHR, 1,
                          vk::ShaderStageFlagBits::eCompute);
  }
  return {device, vk::DescriptorSetLayoutCreateInfo({}, bindings)};
}

std::vector<char> readCache(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::filesystem::path cacheFileFor(const std::filesystem::path& folder, const vk::raii::PhysicalDevice& physical) {
  if (folder.empty()) {
    return {};
  }
  std::error_code unwritable;
  std::filesystem::create_directories(folder, unwritable);
  const vk::PhysicalDeviceProperties core = physical.getProperties();
  return folder / fmt::format("pipelines-{:x}-{:x}-{:x}.bin", core.vendorID, core.deviceID, core.driverVersion);
}

} // namespace

Device::Device(const DeviceOptions& options) : impl_(std::make_unique<Impl>()) {
  impl_->instance = makeInstance(options.validation);
  const std::vector<vk::raii::PhysicalDevice> physicals = impl_->instance->instance.enumeratePhysicalDevices();
  std::vector<DeviceInfo> devices;
  for (const vk::raii::PhysicalDevice& physical : physicals) {
    devices.push_back(describe(physical, static_cast<std::uint32_t>(devices.size())));
  }
  impl_->info = choose(devices, options.select);
  impl_->physical = physicals[impl_->info.index];
  impl_->memory = impl_->physical.getMemoryProperties();
  const std::uint32_t family = computeFamily(impl_->physical);
  impl_->device = makeDevice(impl_->physical, family, impl_->info.rayQuery);
  impl_->queue = impl_->device.getQueue(family, 0);
  impl_->pool = vk::raii::CommandPool(impl_->device, {vk::CommandPoolCreateFlagBits::eTransient, family});
  impl_->setLayout = makeSetLayout(impl_->device, impl_->info.rayQuery);
  impl_->cacheFile = cacheFileFor(options.pipelineCache, impl_->physical);
  const std::vector<char> cached = readCache(impl_->cacheFile);
  impl_->cache = vk::raii::PipelineCache(impl_->device, {{}, cached.size(), cached.data()});
}

Device::~Device() {
  if (impl_->cacheFile.empty()) {
    return;
  }
  // A cache that cannot be written costs the next start some compile time and nothing else.
  try {
    const std::vector<std::uint8_t> data = impl_->cache.getData();
    writeFileAtomically(impl_->cacheFile, [&](const std::filesystem::path& path) {
      std::ofstream(path, std::ios::binary)
          .write(reinterpret_cast<const char*>(data.data()), static_cast<std::streamsize>(data.size()));
    });
  } catch (const std::exception& error) {
    spdlog::debug("pipeline cache not written: {}", error.what());
  }
}

const DeviceInfo& Device::info() const { return impl_->info; }
std::uint64_t Device::allocatedBytes() const { return impl_->allocated; }
std::uint64_t Device::peakBytes() const { return impl_->peak; }
const std::vector<std::string>& Device::messages() const { return impl_->instance->messages; }

std::uint32_t Device::Impl::memoryType(std::uint32_t allowed, vk::MemoryPropertyFlags wanted) const {
  for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
    if ((allowed & (1u << i)) != 0 && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) {
      return i;
    }
  }
  fail("the Vulkan device has no memory of the kind {}", vk::to_string(wanted));
}

vk::raii::DeviceMemory Device::Impl::allocate(const vk::MemoryRequirements& need, vk::MemoryPropertyFlags wanted,
                                              bool address) {
  const vk::MemoryAllocateFlagsInfo flags(vk::MemoryAllocateFlagBits::eDeviceAddress);
  vk::MemoryAllocateInfo allocation(need.size, memoryType(need.memoryTypeBits, wanted));
  if (address) {
    allocation.pNext = &flags;
  }
  try {
    vk::raii::DeviceMemory result(device, allocation);
    allocated += need.size;
    peak = std::max(peak, allocated);
    return result;
  } catch (const vk::SystemError& error) {
    fail("device memory exhausted: {:.1f} MB more are needed, {:.1f} MB are in use ({}); use a smaller volume, a "
         "\"clip\" box, \"storage\": \"unorm8\" or a smaller picture",
         static_cast<double>(need.size) * 1e-6, static_cast<double>(allocated) * 1e-6, error.what());
  }
}

void Device::Impl::runCommands(const std::function<void(const vk::raii::CommandBuffer&)>& record) {
  try {
    const vk::raii::CommandBuffers buffers(device, {*pool, vk::CommandBufferLevel::ePrimary, 1});
    const vk::raii::CommandBuffer& commands = buffers.front();
    commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    record(commands);
    // Results are read by the host after the fence, or by the next submission.
    const vk::MemoryBarrier2 barrier(vk::PipelineStageFlagBits2::eAllCommands, vk::AccessFlagBits2::eMemoryWrite,
                                     vk::PipelineStageFlagBits2::eAllCommands | vk::PipelineStageFlagBits2::eHost,
                                     vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite |
                                         vk::AccessFlagBits2::eHostRead);
    commands.pipelineBarrier2({{}, barrier});
    commands.end();
    const vk::raii::Fence fence(device, vk::FenceCreateInfo{});
    queue.submit(vk::SubmitInfo({}, {}, *commands), *fence);
    constexpr std::uint64_t kNoTimeout = UINT64_MAX;
    if (device.waitForFences(*fence, VK_TRUE, kNoTimeout) != vk::Result::eSuccess) {
      fail("waiting for the Vulkan device failed");
    }
  } catch (const vk::DeviceLostError&) {
    fail("the Vulkan device was lost (driver reset or watchdog); try a smaller --size or another --device");
  }
}

} // namespace tyndall::gpu
