// SPDX-License-Identifier: Apache-2.0
// Devices, buffers, kernels; the validation layer is on, and seen to speak.
#include "base/error.h"
#include "gpu/buffer.h"
#include "gpu/kernel.h"

// Needs <cstdint> before it.
#include "kernels/doubling.h"
#include "kernels/pushes_too_much.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace tyndall::test {
namespace {

struct Push {
  interop::Ptr<float> inputs;
  interop::Ptr<float> outputs;
  std::uint32_t count;
};

const gpu::Device& validatedDevice() {
  static const gpu::Device device(gpu::DeviceOptions{.select = {}, .validation = true, .pipelineCache = {}});
  return device;
}

std::vector<float> numbers(std::size_t count) {
  std::vector<float> values(count);
  std::iota(values.begin(), values.end(), -5.0f);
  return values;
}

TEST(Device, IsListedWithWhatItIs) {
  const std::vector<gpu::DeviceInfo> devices = gpu::listDevices();
  ASSERT_FALSE(devices.empty());
  for (const gpu::DeviceInfo& info : devices) {
    EXPECT_FALSE(info.name.empty());
    EXPECT_FALSE(info.type.empty());
    EXPECT_GT(info.memoryBytes, 0u);
  }
}

TEST(Device, UnknownNameIsAnErrorThatNamesWhatIsThere) {
  try {
    const gpu::Device device(gpu::DeviceOptions{.select = "no such device", .validation = false, .pipelineCache = {}});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(gpu::listDevices().front().name), std::string::npos) << error.what();
  }
}

TEST(Kernel, MapsBuffersOfEveryKindOfMemory) {
  for (const std::size_t count : {1u, 63u, 64u, 65u, 100000u}) {
    const std::vector<float> values = numbers(count);
    for (const auto memory : {gpu::Memory::Device, gpu::Memory::Host}) {
      const gpu::Buffer<float> input(validatedDevice(), std::span<const float>(values), memory);
      gpu::Buffer<float> output(validatedDevice(), count, gpu::Memory::Host);
      output.fillZero();
      const std::vector<gpu::SpecEntry> spec{{0, gpu::specBits(3.0f)}};
      const gpu::Kernel kernel(validatedDevice(), k_doubling_spirv, spec);
      kernel.run(Push{input.ptr(), output.ptr(), static_cast<std::uint32_t>(count)}, static_cast<std::uint32_t>(count));
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < count; ++i) {
        wrong += output.mapped()[i] != 3.0f * values[i];
      }
      EXPECT_EQ(wrong, 0u) << count;
    }
  }
  EXPECT_TRUE(validatedDevice().messages().empty()) << validatedDevice().messages().front();
}

TEST(Kernel, SpecializationDefaultsToWhatTheShaderSays) {
  const std::vector<float> values = numbers(8);
  const gpu::Buffer<float> input(validatedDevice(), std::span<const float>(values));
  const gpu::Buffer<float> output(validatedDevice(), 8, gpu::Memory::Host);
  gpu::Kernel(validatedDevice(), k_doubling_spirv, {}).run(Push{input.ptr(), output.ptr(), 8}, 8);
  EXPECT_EQ(output.mapped()[7], 4.0f);
}

TEST(Buffer, MemoryIsAccountedForAndGivenBack) {
  const std::uint64_t before = validatedDevice().allocatedBytes();
  {
    const gpu::Buffer<float> buffer(validatedDevice(), 1u << 20, gpu::Memory::Device);
    EXPECT_GE(validatedDevice().allocatedBytes(), before + (4u << 20));
  }
  EXPECT_EQ(validatedDevice().allocatedBytes(), before);
  EXPECT_GE(validatedDevice().peakBytes(), before + (4u << 20));
}

TEST(Buffer, AddressZeroWithoutElements) {
  const gpu::Buffer<float> buffer(validatedDevice(), std::span<const float>());
  EXPECT_EQ(buffer.ptr().address, 0u);
}

/// A misuse that the layer must report.
TEST(Validation, ReportsAPlantedMisuse) {
  const gpu::Device device(gpu::DeviceOptions{.select = {}, .validation = true, .pipelineCache = {}});
  EXPECT_TRUE(device.messages().empty());
  const gpu::Kernel kernel(device, k_pushes_too_much_spirv, {});
  EXPECT_FALSE(device.messages().empty());
}

} // namespace
} // namespace tyndall::test
