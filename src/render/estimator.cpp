// SPDX-License-Identifier: Apache-2.0
#include "render/estimator.h"

#include "render/marcher.h"
#include "render/path_tracer.h"
#include "render/tracer.h"

namespace tyndall::render {
namespace {

/// A CPU device answers to Ctrl-C between dispatches; a GPU needs this many invocations to be full.
constexpr std::uint32_t kChunkOnCpu = 16384;
constexpr std::uint32_t kChunkOnGpu = 262144;
/// A march counts many cells per pixel: the device's 32-bit counters must hold those of a dispatch.
constexpr std::uint32_t kMarchChunkOnGpu = 65536;
/// Guided paths whose bits repeat learn from chunk to chunk: what one is must not depend on the device.
constexpr std::uint32_t kChunkLogged = 16384;

/// Well below what old Mesa cuts (65535 iterations), and on a GPU below what its watchdog allows.
constexpr std::uint32_t kStepsOnCpu = 16384;
constexpr std::uint32_t kStepsOnGpu = 2048;

} // namespace

const char* methodName(Method method) {
  switch (method) {
  case Method::March:
    return "march";
  case Method::Tracking:
    return "tracking";
  case Method::Path:
    return "path";
  }
  return "";
}

gpu_scene::GridLayout layoutOf(Method method) {
  switch (method) {
  case Method::March:
    return gpu_scene::GridLayout::Cells;
  case Method::Tracking:
    return gpu_scene::GridLayout::Atlas;
  case Method::Path:
    return gpu_scene::GridLayout::Paths;
  }
  return gpu_scene::GridLayout::Atlas;
}

/// Of a state that waits for the next dispatch.
double stateBytes(Method method) {
  switch (method) {
  case Method::March:
    return 0.0;
  case Method::Tracking:
    return sizeof(interop::TraceState);
  case Method::Path:
    return sizeof(interop::PathState);
  }
  return 0.0;
}

std::uint32_t stepBoundFor(const gpu::Device& device, const EstimatorOptions& options) {
  if (options.stepBound > 0) {
    return options.stepBound;
  }
  return device.info().type == "cpu" ? kStepsOnCpu : kStepsOnGpu;
}

std::uint32_t chunkFor(const gpu::Device& device, const EstimatorOptions& options) {
  if (options.chunkPixels > 0) {
    return options.chunkPixels;
  }
  if (options.guide && options.guide->ordered()) {
    return kChunkLogged;
  }
  const std::uint32_t onGpu = options.method == Method::March ? kMarchChunkOnGpu : kChunkOnGpu;
  return device.info().type == "cpu" ? kChunkOnCpu : onGpu;
}

std::unique_ptr<Estimator> makeEstimator(const gpu::Device& device, const gpu_scene::GpuScene& scene,
                                         const gpu_scene::VolumeSet& volumes, const EstimatorOptions& options) {
  if (options.method == Method::March) {
    return std::make_unique<Marcher>(device, scene, volumes, options);
  }
  if (options.method == Method::Path) {
    return std::make_unique<PathTracer>(device, scene, options);
  }
  return std::make_unique<Tracer>(device, scene, options);
}

double plannedBytes(const gpu::Device& device, const EstimatorOptions& options) {
  const double perPixel = sizeof(std::uint32_t) + sizeof(interop::PixelSums) + 2.0 * stateBytes(options.method);
  const double guiding = options.guide ? guidingBytes(*options.guide, chunkFor(device, options)) : 0.0;
  return perPixel * chunkFor(device, options) + guiding;
}

} // namespace tyndall::render
