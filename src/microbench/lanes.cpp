// SPDX-License-Identifier: Apache-2.0
#include "microbench/commands.h"
#include "microbench/contender.h"
#include "kernels/cell_walk.h"
#include "kernels/lane_use.h"
#include "passes/bench/lane_io.h"
#include "render/march_scene.h"
#include "render/marcher.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>

namespace tyndall::microbench {
namespace {

using Json = nlohmann::ordered_json;
using interop::LaneUse;

auto specEntries(const passes::MarchSpec& spec) {
  return std::array{
#define SPEC(type, name, id, value) gpu::SpecEntry{id, gpu::specBits(spec.name)},
      TYNDALL_MARCH_SPEC(SPEC)
#undef SPEC
  };
}

/// What the rays of one kernel took, and what they cost.
struct Walks {
  std::vector<LaneUse> uses; ///< [pixel * samples + sample]
  double seconds = 0.0;
};

/// Device memory of one measurement, shared by its kernels.
class Rays {
public:
  Rays(const Session& session, const BenchScene& scene)
      : session_(session), pixels_(measuredPixels(scene)),
        cells_(session.device, scene.scene, scene.volumes, gpu_scene::GridLayout::Cells),
        march_(session.device, cells_, scene.volumes, session.options.cacheBytes),
        pixelTable_(session.device, std::span<const std::uint32_t>(pixels_), gpu::Memory::Host),
        uses_(session.device, pixels_.size() * film::kBatchSamples, gpu::Memory::Host),
        sums_(session.device, pixels_.size(), gpu::Memory::Host) {}

  passes::MarchSpec spec(bool correction) const {
    render::EstimatorOptions options;
    options.method = render::Method::March;
    options.preview = !correction;
    return render::marchSpecFor(cells_, march_.plan(), options);
  }

  /// Median time over the repeats, after one that compiles.
  Walks run(const gpu::Kernel& kernel) {
    const interop::LaneInputs inputs{cells_.ptr(),        march_.ptr(),
                                     pixelTable_.ptr(),   uses_.ptr(),
                                     sums_.ptr(),         static_cast<std::uint32_t>(pixels_.size()),
                                     film::kBatchSamples, 0};
    std::vector<double> seconds;
    for (std::uint32_t repeat = 0; repeat <= session_.options.repeats; ++repeat) {
      const Cost cost = costOf([&] { kernel.run(inputs, inputs.count); });
      if (repeat > 0) {
        seconds.push_back(secondsOf(cost, session_.device));
      }
    }
    return {{uses_.mapped().begin(), uses_.mapped().end()}, median(seconds)};
  }

  std::size_t pixelCount() const { return pixels_.size(); }

private:
  const Session& session_;
  std::vector<std::uint32_t> pixels_;
  gpu_scene::GpuScene cells_;
  render::MarchScene march_;
  gpu::Buffer<std::uint32_t> pixelTable_;
  gpu::Buffer<LaneUse> uses_;
  gpu::Buffer<float> sums_;
};

/// Steps of all rays over those that their groups of `lanes` neighbouring pixels would take with every lane as long as
/// the longest.
template <class Steps>
double activeShare(const std::vector<LaneUse>& uses, std::size_t lanes, const Steps& stepsOf) {
  const std::size_t samples = film::kBatchSamples;
  const std::size_t pixels = uses.size() / samples;
  double taken = 0.0;
  double occupied = 0.0;
  for (std::size_t first = 0; first < pixels; first += lanes) {
    for (std::size_t sample = 0; sample < samples; ++sample) {
      double longest = 0.0;
      for (std::size_t pixel = first; pixel < std::min(first + lanes, pixels); ++pixel) {
        const double steps = stepsOf(pixel * samples + sample);
        taken += steps;
        longest = std::max(longest, steps);
      }
      occupied += longest * double(lanes);
    }
  }
  return occupied > 0.0 ? taken / occupied : 0.0;
}

template <class Steps>
double meanOf(const std::vector<LaneUse>& uses, const Steps& stepsOf) {
  double sum = 0.0;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    sum += stepsOf(i);
  }
  return sum / double(uses.size());
}

Json laneRow(const Session& session, const std::string& name, const BenchScene& scene) {
  Rays rays(session, scene);
  const auto kernelFor = [&](bool correction) {
    return gpu::Kernel(session.device, k_lane_use_spirv, specEntries(rays.spec(correction)));
  };
  const Walks march = rays.run(kernelFor(true));
  const Walks preview = rays.run(kernelFor(false));
  const Walks bare = rays.run(gpu::Kernel(session.device, k_cell_walk_spirv, std::span<const gpu::SpecEntry>{}));
  const std::size_t lanes = session.device.info().subgroupSize;
  const auto cameraSteps = [&](std::size_t i) { return double(march.uses[i].steps); };
  const auto corrections = [&](std::size_t i) { return double(march.uses[i].cells - preview.uses[i].cells); };
  const auto bareSteps = [&](std::size_t i) { return double(bare.uses[i].steps); };
  const double camera = meanOf(march.uses, cameraSteps);
  const double correction = meanOf(march.uses, corrections);
  const double walked = meanOf(bare.uses, bareSteps);
  const double samples = double(rays.pixelCount()) * film::kBatchSamples;
  Json row{{"scene", name},
           {"lanes", lanes},
           {"cameraActive", activeShare(march.uses, lanes, cameraSteps)},
           {"correctionActive", activeShare(march.uses, lanes, corrections)},
           {"bareActive", activeShare(bare.uses, lanes, bareSteps)},
           {"cameraStepsPerSample", camera},
           {"correctionStepsPerSample", correction},
           {"bareStepsPerSample", walked},
           {"previewStepsPerSecond", camera * samples / preview.seconds},
           {"marchStepsPerSecond", (camera + correction) * samples / march.seconds},
           {"bareStepsPerSecond", walked * samples / bare.seconds}};
  const auto number = [&](const char* key, double scale) { return shortText(scale * row.at(key).get<double>()); };
  fmt::print("{:<36}{:>10}{:>12}{:>8}{:>10}{:>14}{:>8}{:>12}{:>12}{:>12}\n", name, number("cameraActive", 1.0),
             number("correctionActive", 1.0), number("bareActive", 1.0), number("cameraStepsPerSample", 1.0),
             number("correctionStepsPerSample", 1.0), number("bareStepsPerSample", 1.0),
             number("marchStepsPerSecond", 1e-6), number("previewStepsPerSecond", 1e-6),
             number("bareStepsPerSecond", 1e-6));
  std::fflush(stdout);
  return row;
}

} // namespace

Json lanesReport(const Session& session) {
  const Options& options = session.options;
  fmt::print("\nshares of active lanes of {}; steps per sample; M steps per second\n",
             session.device.info().subgroupSize);
  fmt::print("{:<36}{:>10}{:>12}{:>8}{:>10}{:>14}{:>8}{:>12}{:>12}{:>12}\n", "", "camera", "correction", "bare",
             "steps/n", "correction/n", "bare/n", "march M/s", "preview M/s", "bare M/s");
  Json rows = Json::array();
  for (const double factor : {0.1, 1.0, 10.0}) {
    const double depth = factor * options.opticalDepth;
    rows.push_back(
        laneRow(session, fmt::format("sun, optical depth {}", depth), sunScene(session.grid, depth, options.size)));
  }
  rows.push_back(laneRow(session, fmt::format("point light in fog, optical depth {}", options.opticalDepth),
                         foggyPointScene(session.grid, options.opticalDepth, options.size)));
  return rows;
}

} // namespace tyndall::microbench
