// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

/// Vulkan 1.3 compute with the domain words removed. The only user of vulkan.hpp; headers stay free of it.
namespace tyndall::gpu {

/// A physical device and what it offers.
struct DeviceInfo {
  std::uint32_t index = 0; ///< place in the loader's list, what --device takes
  std::string name;
  std::string driver; ///< driver name and version text
  std::string type;   ///< "discrete", "integrated", "virtual", "cpu" or "other"
  std::string apiVersion;
  std::uint32_t subgroupSize = 0;
  std::uint32_t maxImage3D = 0;     ///< texels per edge
  std::uint64_t memoryBytes = 0;    ///< largest device-local heap
  std::uint64_t maxAllocation = 0;  ///< bytes of one allocation
  bool rayQuery = false;            ///< acceleration structures and ray queries in compute kernels
  std::vector<std::string> missing; ///< what Tyndall needs and the device lacks; empty = usable

  bool usable() const { return missing.empty(); }
};

/// All devices of the machine. @throws Error without a Vulkan driver.
std::vector<DeviceInfo> listDevices();

struct DeviceOptions {
  std::string select;                  ///< index or part of the name; empty = the fastest kind
  bool validation = false;             ///< core and synchronisation validation, messages collected
  std::filesystem::path pipelineCache; ///< folder; empty = no cache on disk
};

/// A logical device with one compute queue. Not copyable; everything made from it must die before it.
class Device {
public:
  /// @throws Error if no device fits, with what is missing and how to get it.
  explicit Device(const DeviceOptions& options);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const DeviceInfo& info() const;
  /// Bytes of buffers and images alive, and the most there ever were.
  std::uint64_t allocatedBytes() const;
  std::uint64_t peakBytes() const;
  /// Validation messages so far (warnings and errors).
  const std::vector<std::string>& messages() const;

  struct Impl;
  Impl& impl() const { return *impl_; }

private:
  std::unique_ptr<Impl> impl_;
};

} // namespace tyndall::gpu
