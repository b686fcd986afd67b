// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "gpu/vulkan_impl.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>

namespace tyndall::gpu {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  static_cast<std::vector<std::string>*>(user)->emplace_back(data->pMessage);
  spdlog::error("Vulkan validation: {}", data->pMessage);
  return VK_FALSE;
}

bool hasLayer(const vk::raii::Context& context, const std::string& name) {
  const auto layers = context.enumerateInstanceLayerProperties();
  return std::any_of(layers.begin(), layers.end(),
                     [&](const vk::LayerProperties& layer) { return name == layer.layerName; });
}

vk::DebugUtilsMessengerCreateInfoEXT messengerInfo(std::vector<std::string>& messages) {
  using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
  using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
  return {{},
          Severity::eWarning | Severity::eError,
          Type::eGeneral | Type::eValidation | Type::ePerformance,
          onMessage,
          &messages};
}

const char* typeName(vk::PhysicalDeviceType type) {
  switch (type) {
  case vk::PhysicalDeviceType::eDiscreteGpu:
    return "discrete";
  case vk::PhysicalDeviceType::eIntegratedGpu:
    return "integrated";
  case vk::PhysicalDeviceType::eVirtualGpu:
    return "virtual";
  case vk::PhysicalDeviceType::eCpu:
    return "cpu";
  default:
    return "other";
  }
}

std::string versionText(std::uint32_t version) {
  return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                     VK_API_VERSION_PATCH(version));
}

std::vector<std::string> missingFeatures(const vk::raii::PhysicalDevice& physical) {
  if (physical.getProperties().apiVersion < VK_API_VERSION_1_3) {
    return {"Vulkan 1.3"};
  }
  const auto chain = physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features,
                                           vk::PhysicalDeviceVulkan13Features>();
  const auto& v12 = chain.get<vk::PhysicalDeviceVulkan12Features>();
  const auto& v13 = chain.get<vk::PhysicalDeviceVulkan13Features>();
  std::vector<std::string> missing;
  const auto need = [&](vk::Bool32 there, const char* name) {
    if (there == VK_FALSE) {
      missing.emplace_back(name);
    }
  };
  need(v12.bufferDeviceAddress, "bufferDeviceAddress");
  need(v12.scalarBlockLayout, "scalarBlockLayout");
  need(v13.synchronization2, "synchronization2");
  need(v13.maintenance4, "maintenance4");
  return missing;
}

bool hasRayQuery(const vk::raii::PhysicalDevice& physical) {
  const std::vector<vk::ExtensionProperties> extensions = physical.enumerateDeviceExtensionProperties();
  const bool there = std::all_of(kRayQueryExtensions.begin(), kRayQueryExtensions.end(), [&](const std::string& name) {
    return std::any_of(extensions.begin(), extensions.end(),
                       [&](const vk::ExtensionProperties& each) { return name == each.extensionName; });
  });
  if (!there) {
    return false;
  }
  const auto chain =
      physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceAccelerationStructureFeaturesKHR,
                            vk::PhysicalDeviceRayQueryFeaturesKHR>();
  return chain.get<vk::PhysicalDeviceAccelerationStructureFeaturesKHR>().accelerationStructure == VK_TRUE &&
         chain.get<vk::PhysicalDeviceRayQueryFeaturesKHR>().rayQuery == VK_TRUE;
}

} // namespace

std::unique_ptr<Instance> makeInstance(bool validation) {
  auto result = std::make_unique<Instance>();
  const vk::ApplicationInfo application("tyndall", 1, "tyndall", 1, VK_API_VERSION_1_3);
  std::vector<const char*> layers;
  std::vector<const char*> extensions;
  if (validation) {
    if (!hasLayer(result->context, kValidationLayer)) {
      fail("the Vulkan validation layer is not installed; install the package vulkan-validationlayers");
    }
    layers.push_back(kValidationLayer);
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  }
  const std::array checks{vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
  const vk::ValidationFeaturesEXT features(checks);
  vk::InstanceCreateInfo info({}, &application, layers, extensions);
  if (validation) {
    info.pNext = &features;
  }
  try {
    result->instance = vk::raii::Instance(result->context, info);
  } catch (const vk::SystemError& error) {
    fail("no Vulkan driver could be loaded ({}); install one, for the CPU the package mesa-vulkan-drivers",
         error.what());
  }
  if (validation) {
    result->messenger = vk::raii::DebugUtilsMessengerEXT(result->instance, messengerInfo(result->messages));
  }
  return result;
}

DeviceInfo describe(const vk::raii::PhysicalDevice& physical, std::uint32_t index) {
  const auto chain = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceVulkan11Properties,
                                             vk::PhysicalDeviceVulkan12Properties>();
  const vk::PhysicalDeviceProperties& core = chain.get<vk::PhysicalDeviceProperties2>().properties;
  const auto& v12 = chain.get<vk::PhysicalDeviceVulkan12Properties>();
  DeviceInfo info;
  info.index = index;
  info.name = core.deviceName.data();
  info.driver = fmt::format("{} {}", v12.driverName.data(), v12.driverInfo.data());
  info.type = typeName(core.deviceType);
  info.apiVersion = versionText(core.apiVersion);
  info.subgroupSize = chain.get<vk::PhysicalDeviceVulkan11Properties>().subgroupSize;
  info.maxAllocation = chain.get<vk::PhysicalDeviceVulkan11Properties>().maxMemoryAllocationSize;
  info.maxImage3D = core.limits.maxImageDimension3D;
  const vk::PhysicalDeviceMemoryProperties memory = physical.getMemoryProperties();
  for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
    if (memory.memoryHeaps[i].flags & vk::MemoryHeapFlagBits::eDeviceLocal) {
      info.memoryBytes = std::max<std::uint64_t>(info.memoryBytes, memory.memoryHeaps[i].size);
    }
  }
  info.missing = missingFeatures(physical);
  info.rayQuery = info.usable() && hasRayQuery(physical);
  return info;
}

std::vector<DeviceInfo> listDevices() {
  const std::unique_ptr<Instance> instance = makeInstance(false);
  std::vector<DeviceInfo> devices;
  for (const vk::raii::PhysicalDevice& physical : instance->instance.enumeratePhysicalDevices()) {
    devices.push_back(describe(physical, static_cast<std::uint32_t>(devices.size())));
  }
  return devices;
}

} // namespace tyndall::gpu
