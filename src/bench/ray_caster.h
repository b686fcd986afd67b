// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/ray_scenes.h"
#include "gpu/buffer.h"
#include "gpu/kernel.h"
#include "passes/bench/ray_cast_io.h"

#include <span>
#include <vector>

namespace tyndall::bench {

using BenchRays = std::vector<interop::BenchRay>;

/// The bare ray cast: a kernel that casts given rays against a tree of triangles and does nothing else.
class DeviceCaster {
public:
  DeviceCaster(const gpu::Device& device, const geometry::Bvh& bvh);

  void load(const BenchRays& rays);
  void run(bool anyHit) const;
  std::span<const interop::BenchHit> hits() const { return hits_.mapped(); }

private:
  const gpu::Device& device_;
  gpu::Kernel kernel_;
  gpu::Buffer<interop::BvhNode> nodes_;
  gpu::Buffer<interop::BvhPrimitive> primitives_;
  gpu::Buffer<interop::Surfaces> surfaces_;
  gpu::Buffer<interop::BenchRay> rays_;
  gpu::Buffer<interop::BenchHit> hits_;
};

/// Through the centres of size x size pixels.
BenchRays primaryRays(const RayScene& scene, std::uint32_t size);

/// One ray each from where `primary` rays hit: cosine-distributed, or to a random point of the light.
BenchRays secondaryRays(const RayScene& scene, const geometry::Bvh& bvh, const BenchRays& primary,
                        std::span<const interop::BenchHit> hits, bool toLight);

} // namespace tyndall::bench
