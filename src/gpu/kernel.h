// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/acceleration.h"
#include "gpu/buffer.h"
#include "gpu/image.h"

#include <array>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace tyndall::gpu {

/// One specialization constant; floats and bools travel as their 32 bits.
struct SpecEntry {
  std::uint32_t id;
  std::uint32_t bits;
};

/// The 32 bits of a uint, int, float or bool specialization value (bool: VkBool32).
template <class T>
std::uint32_t specBits(T value) {
  if constexpr (std::is_same_v<T, bool>) {
    return value ? 1u : 0u;
  } else {
    static_assert(sizeof(T) == 4);
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, 4);
    return bits;
  }
}

/// The images every kernel may read, one binding per texel format (shaders/medium/atlas.glsl).
/// Missing ones are never read: specialization removes their code.
struct AtlasImages {
  const Image3D* uint8 = nullptr;
  const Image3D* half = nullptr;
  const Image3D* single = nullptr;
};

/// A compute pipeline. Workgroup size is what the SPIR-V states (x only; y = z = 1).
class Kernel {
public:
  /// @param rays what the kernel's ray queries go through; it must outlive the kernel. Null: the kernel has none.
  Kernel(const Device& device, std::span<const std::uint32_t> spirv, std::span<const SpecEntry> spec,
         const AtlasImages& images = {}, const AccelerationStructure* rays = nullptr);
  Kernel(Kernel&&) noexcept;
  ~Kernel();

  std::uint32_t workgroupSize() const { return workgroupSize_; }
  std::size_t spirvBytes() const { return spirvBytes_; }

  /// Runs at least `invocations` invocations (whole workgroups) with the push constants and waits for the end.
  template <class Push>
  void run(const Push& push, std::uint32_t invocations) const {
    static_assert(std::is_trivially_copyable_v<Push> && sizeof(Push) <= 128);
    runRaw(std::as_bytes(std::span(&push, 1)), invocations);
  }

  struct Impl;

private:
  void runRaw(std::span<const std::byte> push, std::uint32_t invocations) const;

  std::unique_ptr<Impl> impl_;
  std::uint32_t workgroupSize_ = 0;
  std::size_t spirvBytes_ = 0;
};

} // namespace tyndall::gpu
