// SPDX-License-Identifier: Apache-2.0
#include "app/device_options.h"

#include <spdlog/spdlog.h>

#include <cstdlib>

namespace tyndall::app {
namespace {

/// The value of an environment variable, empty if it is not set.
std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// Empty, so that nothing is cached, if the user has no home.
std::filesystem::path cacheFolder() {
  if (const std::string cache = environment("XDG_CACHE_HOME"); cache.starts_with('/')) {
    return std::filesystem::path(cache) / "tyndall";
  }
  const std::string home = environment("HOME");
  return home.starts_with('/') ? std::filesystem::path(home) / ".cache" / "tyndall" : std::filesystem::path();
}

} // namespace

gpu::DeviceOptions deviceOptions(const std::string& select) {
  const std::string validation = environment("TYNDALL_VALIDATION");
  return {.select = select, .validation = !validation.empty() && validation != "0", .pipelineCache = cacheFolder()};
}

int withValidation(const gpu::Device& device, int code) {
  if (device.messages().empty()) {
    return code;
  }
  spdlog::error("{} message(s) from the Vulkan validation layer", device.messages().size());
  return kValidation;
}

} // namespace tyndall::app
