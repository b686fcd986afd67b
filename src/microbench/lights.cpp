// SPDX-License-Identifier: Apache-2.0
#include "bench/path_run.h"
#include "bench/path_scenes.h"
#include "bench/variance.h"
#include "gpu/kernel.h"
#include "kernels/light_choice.h"
#include "microbench/commands.h"
#include "microbench/contender.h"
#include "passes/bench/light_choice_io.h"
#include "render/path_tracer.h"
#include "render/pixel_order.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <memory>
#include <numeric>

namespace tyndall::microbench {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::size_t, 4> kCounts{10, 100, 1000, 10000};
constexpr std::uint32_t kSamples = 16;
constexpr std::uint32_t kChoiceWidth = 128;
constexpr std::uint32_t kChoices = 64;

struct Selection {
  const char* name;
  std::uint32_t id;
};
constexpr std::array<Selection, 3> kSelections{
    {{"tree", interop::kSelectTree}, {"power", interop::kSelectPower}, {"even", interop::kSelectUniform}}};

/// Nanoseconds of one choice by each selection, random number and loop included. Choosing evenly is little else.
class ChoiceClock {
public:
  ChoiceClock(const gpu::Device& device, const gpu_scene::GpuScene& scene)
      : device_(&device), emitters_(device, {}, scene.emitters()),
        sums_(device, kChoiceWidth * kChoiceWidth, gpu::Memory::Host) {
    for (const Selection& selection : kSelections) {
      const std::array spec{gpu::SpecEntry{0, selection.id}};
      kernels_.emplace_back(device, k_light_choice_spirv, spec);
    }
    // Receivers: on the floor, which faces up; device coordinates are relative to the scene's centre.
    const glm::vec3 corner(glm::dvec3(-10.0, 0.0, 10.0) - scene.centre());
    inputs_.emitters = emitters_.emitters();
    inputs_.sums = sums_.ptr();
    inputs_.corner = corner;
    inputs_.edgeU = glm::vec3(20.0f, 0.0f, 0.0f);
    inputs_.edgeV = glm::vec3(0.0f, 0.0f, -20.0f);
    inputs_.count = kChoiceWidth * kChoiceWidth;
    inputs_.width = kChoiceWidth;
    inputs_.choices = kChoices;
  }

  void run(bool warmUp) {
    for (std::size_t i = 0; i < kernels_.size(); ++i) {
      const double seconds = secondsOf(costOf([&] { kernels_[i].run(inputs_, inputs_.count); }), *device_);
      if (!warmUp) {
        times_[i].push_back(1e9 * seconds / (double(inputs_.count) * kChoices));
      }
    }
  }

  double nanoseconds(std::size_t selection) const { return median(times_[selection]); }

private:
  const gpu::Device* device_;
  gpu_scene::SurfaceBuffers emitters_;
  gpu::Buffer<float> sums_;
  std::vector<gpu::Kernel> kernels_;
  interop::LightChoiceInputs inputs_{};
  std::array<std::vector<double>, kSelections.size()> times_;
};

struct LightTrial {
  LightTrial(const Session& session, LightScene kind, std::size_t count)
      : scene(lightsScene(kind, count, session.options.size)),
        gpuScene(session.device, scene.scene, scene.volumes, render::layoutOf(render::Method::Path)),
        clock(session.device, gpuScene) {
    const std::vector<std::uint32_t> pixels = render::dispatchOrder({glm::uvec2(0), scene.scene.film.size});
    for (const Selection& selection : kSelections) {
      render::EstimatorOptions options;
      options.lightSelection = selection.id;
      const passes::PathSpec spec = render::pathSpecFor(gpuScene.features(), options);
      runs.emplace_back(session.device, gpuScene, pathModule(), pathSpecEntries(spec), pixels);
    }
    for (std::uint32_t repeat = 0; repeat <= session.options.repeats; ++repeat) {
      for (PathRun& run : runs) {
        run.run(kSamples, repeat, repeat == 0);
      }
      clock.run(repeat == 0);
    }
  }

  BenchScene scene;
  gpu_scene::GpuScene gpuScene;
  ChoiceClock clock;
  std::vector<PathRun> runs;
};

Json trialRows(const Session& session, LightScene kind, std::size_t count) {
  const LightTrial trial(session, kind, count);
  const std::uint32_t repeats = session.options.repeats;
  const PathFigures& tree = trial.runs.front().figures();
  std::vector<std::size_t> pixels(tree.pictures.front().size());
  std::iota(pixels.begin(), pixels.end(), std::size_t{0});
  const Figure treeVariance = meanVariance(tree.pictures, pixels);
  Json rows = Json::array();
  for (std::size_t i = 0; i < kSelections.size(); ++i) {
    const PathFigures& figures = trial.runs[i].figures();
    const Figure variance = meanVariance(figures.pictures, pixels);
    // The times of rounds in turn, the variances of all rounds.
    const Figure gain = variance / treeVariance * ratioInTurn(figures.seconds, tree.seconds);
    const double seconds = median(figures.seconds);
    const Difference apart = difference(figures.pictures, tree.pictures, pixels, false);
    const std::string bias =
        i == 0 ? "" : fmt::format("{:+.2f} % ({:.2f})", 100.0 * apart.mean, 100.0 * apart.meanError);
    const double nanoseconds = trial.clock.nanoseconds(i);
    fmt::print("{:<28}{:>7} {:<6}{:>9}{:>10}{:>10}  {:<24}{:>8}  {}\n", lightSceneName(kind), count,
               kSelections[i].name, shortText(seconds), shortText(variance.value), shortText(variance.value * seconds),
               i == 0 ? "1" : rangeText(gain, repeats), shortText(nanoseconds), bias);
    rows.push_back({{"scene", lightSceneName(kind)},
                    {"lights", count},
                    {"selection", kSelections[i].name},
                    {"secondsPerPass", seconds},
                    {"variance", variance.value},
                    {"overTree", gain.value},
                    {"overTreeInterval", {interval(gain, repeats).low, interval(gain, repeats).high}},
                    {"nanosecondsPerChoice", nanoseconds},
                    {"meanAgainstTree", apart.mean},
                    {"meanError", apart.meanError}});
  }
  std::fflush(stdout);
  return rows;
}

} // namespace

Json lightsReport(const Session& session) {
  fmt::print("\n{} samples per pixel and pass. V s over the tree's: above 1 the tree is better.\n"
             "{:<28}{:>7} {:<6}{:>9}{:>10}{:>10}  {:<24}{:>8}  {}\n",
             kSamples, "scene", "lights", "choice", "s", "V", "V s", "over the tree's", "ns", "mean against the tree");
  Json report = Json::array();
  for (const LightScene kind : {LightScene::PointsOverFloor, LightScene::QuadsInMist}) {
    for (const std::size_t count : kCounts) {
      report.push_back(trialRows(session, kind, count));
    }
  }
  return report;
}

} // namespace tyndall::microbench
