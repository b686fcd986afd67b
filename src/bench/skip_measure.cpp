// SPDX-License-Identifier: Apache-2.0
#include "bench/skip_measure.h"

#include "bench/path_run.h"
#include "bench/skip_cases.h"
#include "bench/variance.h"
#include "gpu/specialise.h"
#include "render/path_tracer.h"
#include "render/pixel_order.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <optional>

namespace tyndall::bench {
namespace {

constexpr std::uint32_t kSamples = 16;
constexpr std::uint32_t kEdge = 48;   ///< of the pictures, pixels
constexpr int kCloudEdge = 64;        ///< voxels
constexpr double kOpticalDepth = 5.0; ///< of the cloud, median
constexpr std::size_t kFirstPixels = 64;

/// Pictures of the same seeds.
std::string pictureText(const PathFigures& a, const PathFigures& b) {
  if (a.pictures == b.pictures) {
    return "same bits";
  }
  std::vector<std::size_t> pixels(a.pictures.front().size());
  std::iota(pixels.begin(), pixels.end(), std::size_t{0});
  const Difference apart = difference(a.pictures, b.pictures, pixels, false);
  const double sigmas = apart.mean / apart.meanError;
  return std::isfinite(sigmas) ? fmt::format("{:+.1f} sigma", sigmas) : "other"; // black, or without noise
}

/// One of a scene's two pipelines.
struct Pipeline {
  Pipeline(const gpu::Device& device, const gpu_scene::GpuScene& scene, double sceneBytes, const passes::PathSpec& spec,
           const std::vector<std::uint32_t>& pixels) {
    const double before = double(device.allocatedBytes());
    run.emplace(device, scene, pathModule(), pathSpecEntries(spec), pixels);
    cost.deviceBytes = sceneBytes + double(device.allocatedBytes()) - before;
    cost.moduleBytes = 4.0 * double(gpu::specialise(pathModule(), pathSpecEntries(spec)).size());
    cost.compileSeconds = run->compileSeconds();
  }

  std::optional<PathRun> run;
  PipelineCost cost;
};

/// A scene on the device.
struct Uploaded {
  Uploaded(const gpu::Device& device, const BenchScene& scene, render::Method method)
      : pixels(render::dispatchOrder({glm::uvec2(0), scene.scene.film.size})) {
    const double before = double(device.allocatedBytes());
    gpuScene.emplace(device, scene.scene, scene.volumes, render::layoutOf(method));
    bytes = double(device.allocatedBytes()) - before;
  }

  std::vector<std::uint32_t> pixels;
  std::optional<gpu_scene::GpuScene> gpuScene;
  double bytes = 0.0;
};

SkipRow featureRow(const gpu::Device& device, const std::string& scene, const Uploaded& uploaded, const SkipCase& each,
                   std::uint32_t repeats) {
  passes::PathSpec without = render::pathSpecFor(uploaded.gpuScene->features(), {});
  passes::PathSpec with = without;
  each.set(without, false);
  each.set(with, true);
  Pipeline left(device, *uploaded.gpuScene, uploaded.bytes, without, uploaded.pixels);
  Pipeline kept(device, *uploaded.gpuScene, uploaded.bytes, with, uploaded.pixels);
  for (std::uint32_t repeat = 0; repeat <= repeats; ++repeat) {
    left.run->run(kSamples, repeat, repeat == 0);
    kept.run->run(kSamples, repeat, repeat == 0);
  }
  const PathFigures& figures = left.run->figures();
  return {scene,
          each.feature,
          1e6 * median(figures.seconds) * double(figures.seconds.size()) / figures.samples,
          ratioInTurn(kept.run->figures().seconds, figures.seconds),
          left.cost,
          kept.cost,
          pictureText(kept.run->figures(), figures)};
}

/// A method on a scene of its own upload, as the renderer makes it.
MethodRow methodRow(const gpu::Device& device, const SkipScene& each, render::Method method, std::uint32_t repeats) {
  const Uploaded uploaded(device, each.scene, method);
  render::EstimatorOptions options;
  options.method = method;
  options.rays = render::RayCaster::Tree; // as the feature rows have it
  const double before = double(device.allocatedBytes());
  std::unique_ptr<render::Estimator> estimator;
  const std::span<const std::uint32_t> pixels(uploaded.pixels);
  const auto take = [&](std::span<const std::uint32_t> some, std::uint32_t samples, std::uint32_t seed) {
    const std::size_t chunk = estimator->chunkPixels();
    for (std::size_t first = 0; first < some.size(); first += chunk) {
      estimator->run(some.subspan(first, std::min(chunk, some.size() - first)), {0, samples}, seed);
    }
  };
  const Cost cold = costOf([&] {
    estimator = render::makeEstimator(device, *uploaded.gpuScene, each.scene.volumes, options);
    take(pixels.first(std::min(kFirstPixels, pixels.size())), 1, 0);
  });
  const double passBytes = double(device.allocatedBytes()) - before;
  std::vector<double> seconds;
  for (std::uint32_t repeat = 0; repeat < repeats; ++repeat) {
    seconds.push_back(secondsOf(costOf([&] { take(pixels, kSamples, repeat); }), device));
  }
  return {each.name,
          render::methodName(method),
          1e6 * median(seconds) / (double(pixels.size()) * kSamples),
          uploaded.bytes,
          double(uploaded.gpuScene->surfaceBytes()),
          passBytes,
          secondsOf(cold, device)};
}

void addMethods(const gpu::Device& device, std::vector<SkipScene>& scenes, SkipTable& table) {
  for (const std::size_t media : {kMist, kCloud}) {
    SkipScene single = scenes[media];
    single.name += ", one event";
    single.scene.scene.render.depth = 1;
    for (const render::Method method : {render::Method::March, render::Method::Tracking, render::Method::Path}) {
      table.methods.push_back(methodRow(device, single, method, std::uint32_t(table.repeats)));
    }
  }
  for (const SkipScene& scene : scenes) {
    table.methods.push_back(methodRow(device, scene, render::Method::Path, std::uint32_t(table.repeats)));
  }
}

} // namespace

SkipTable measureSkip(const gpu::Device& device, std::uint32_t repeats, const Say& say) {
  std::vector<SkipScene> scenes = skipScenes(cloudOfEdge(kCloudEdge), kOpticalDepth, kEdge);
  SkipTable table{device.info().type == "cpu" ? "CPU" : "wall", repeats, {}, {}};
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Uploaded uploaded(device, scenes[i].scene, render::Method::Path);
    for (const SkipCase& each : skipCases()) {
      if (each.scene == i) {
        const SkipRow row = featureRow(device, scenes[i].name, uploaded, each, repeats);
        say(fmt::format("{:<22}{:<26}time {:<22} {}", row.scene, row.feature, rangeText(row.time, repeats),
                        row.pictures));
        table.features.push_back(row);
      }
    }
  }
  addMethods(device, scenes, table);
  return table;
}

} // namespace tyndall::bench
