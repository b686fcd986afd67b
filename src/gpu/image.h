// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <span>

namespace tyndall::gpu {

enum class TexelFormat { Uint8, Half, Float };

/// A 3D image that kernels read by texelFetch.
class Image3D {
public:
  Image3D();
  /// @param texels tightly packed, x fastest; extent.x * y * z of them.
  /// @throws Error if an edge is beyond the device's limit or memory is exhausted.
  Image3D(const Device& device, const glm::uvec3& extent, TexelFormat format, std::span<const std::byte> texels);
  Image3D(Image3D&&) noexcept;
  Image3D& operator=(Image3D&&) noexcept;
  ~Image3D();

  bool empty() const { return impl_ == nullptr; }

  struct Impl;
  const Impl& impl() const { return *impl_; }

private:
  std::unique_ptr<Impl> impl_;
};

} // namespace tyndall::gpu
