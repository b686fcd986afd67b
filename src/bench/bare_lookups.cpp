// SPDX-License-Identifier: Apache-2.0
#include "bench/ceilings.h"
#include "bench/figure.h"
#include "bench/scenes.h"
#include "gpu/kernel.h"
#include "passes/bench/bench_io.h"
#include "render/pixel_order.h"

// Needs <cstdint> before it.
#include "kernels/bare_lookup.h"

#include <algorithm>
#include <array>

namespace tyndall::bench {

Cost bareLookups(const gpu::Device& device, const gpu_scene::GpuScene& gpuScene, std::uint32_t size,
                 std::uint32_t repeats, double meanStep) {
  const std::array spec{gpu::SpecEntry{0, gpuScene.features().formatMask}};
  const gpu::Kernel kernel(device, k_bare_lookup_spirv, spec, gpuScene.images());
  const std::vector<std::uint32_t> order = render::dispatchOrder({glm::uvec2(0), glm::uvec2(size)});
  const gpu::Buffer<std::uint32_t> pixels(device, std::span<const std::uint32_t>(order), gpu::Memory::Host);
  const gpu::Buffer<float> sums(device, order.size(), gpu::Memory::Host);
  constexpr std::uint32_t kLookups = 64;
  const interop::BareLookupInputs inputs{gpuScene.ptr(), pixels.ptr(),
                                         sums.ptr(),     static_cast<std::uint32_t>(order.size()),
                                         kLookups,       static_cast<float>(meanStep)};
  kernel.run(inputs, inputs.count);
  std::vector<double> wall;
  std::vector<double> cpu;
  for (std::uint32_t i = 0; i < repeats; ++i) {
    const Cost cost = costOf([&] { kernel.run(inputs, inputs.count); });
    wall.push_back(cost.wall);
    cpu.push_back(cost.cpu);
  }
  const auto hits = std::count_if(sums.mapped().begin(), sums.mapped().end(), [](float sum) { return sum != 0.0f; });
  const double lookups = double(hits) * kLookups;
  return {lookups / median(wall), lookups / median(cpu)};
}

BareRates measureBareRates(const gpu::Device& device) {
  constexpr int kCloudEdge = 64;
  constexpr std::uint32_t kEdge = 128; // of the pictures, pixels
  constexpr std::uint32_t kRepeats = 8;
  constexpr double kMeanStep = 8.0; // voxels
  const BenchScene cloud = sunScene(cloudOfEdge(kCloudEdge), 5.0, kEdge);
  const gpu_scene::GpuScene gpuScene(device, cloud.scene, cloud.volumes);
  const RayRates rays = rayRates(device, boxScene(), kEdge, kRepeats, Clock::Wall);
  return {bareLookups(device, gpuScene, kEdge, kRepeats, kMeanStep).wall,
          1.0 / (0.5 / rays.diffuse + 0.5 / rays.shadow)};
}

} // namespace tyndall::bench
