// SPDX-License-Identifier: Apache-2.0
#include "render/estimator.h"

#include "render/marcher.h"
#include "render/tracer.h"

namespace tyndall::render {
namespace {

/// A CPU device answers to Ctrl-C between dispatches; a GPU needs this many invocations to be full.
constexpr std::uint32_t kChunkOnCpu = 16384;
constexpr std::uint32_t kChunkOnGpu = 262144;
/// A march counts many cells per pixel: the device's 32-bit counters must hold those of a dispatch.
constexpr std::uint32_t kMarchChunkOnGpu = 65536;

} // namespace

const char* methodName(Method method) { return method == Method::March ? "march" : "tracking"; }

gpu_scene::GridLayout layoutOf(Method method) {
  return method == Method::March ? gpu_scene::GridLayout::Cells : gpu_scene::GridLayout::Atlas;
}

std::uint32_t chunkFor(const gpu::Device& device, const EstimatorOptions& options) {
  if (options.chunkPixels > 0) {
    return options.chunkPixels;
  }
  const std::uint32_t onGpu = options.method == Method::March ? kMarchChunkOnGpu : kChunkOnGpu;
  return device.info().type == "cpu" ? kChunkOnCpu : onGpu;
}

std::unique_ptr<Estimator> makeEstimator(const gpu::Device& device, const gpu_scene::GpuScene& scene,
                                         const gpu_scene::VolumeSet& volumes, const EstimatorOptions& options) {
  if (options.method == Method::March) {
    return std::make_unique<Marcher>(device, scene, volumes, options);
  }
  return std::make_unique<Tracer>(device, scene, options);
}

double plannedBytes(const gpu::Device& device, const EstimatorOptions& options) {
  const double perPixel = sizeof(std::uint32_t) + sizeof(interop::PixelSums) +
                          (options.method == Method::Tracking ? 2.0 * sizeof(interop::TraceState) : 0.0);
  return perPixel * chunkFor(device, options);
}

} // namespace tyndall::render
