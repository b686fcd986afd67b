// SPDX-License-Identifier: Apache-2.0
#include "microbench/commands.h"
#include "microbench/contender.h"
#include "microbench/frozen.h"
#include "microbench/path_run.h"
#include "microbench/skip_cases.h"
#include "render/path_tracer.h"
#include "render/pixel_order.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <numeric>
#include <optional>

namespace tyndall::microbench {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint32_t kSamples = 16;

std::vector<std::uint32_t> allPixels(const BenchScene& scene) {
  return render::dispatchOrder({glm::uvec2(0), scene.scene.film.size});
}

/// The pictures of both with the same seeds: "same", or how far their means are apart in standard errors.
std::string pictureText(const PathFigures& a, const PathFigures& b) {
  if (a.pictures == b.pictures) {
    return "same";
  }
  std::vector<std::size_t> pixels(a.pictures.front().size());
  std::iota(pixels.begin(), pixels.end(), std::size_t{0});
  const Difference apart = difference(a.pictures, b.pictures, pixels, false);
  const double sigmas = apart.mean / apart.meanError;
  return std::isfinite(sigmas) ? fmt::format("{:+.1f} sigma", sigmas) : "other"; // black, or without noise
}

/// The same scene without a feature's code, with it, and from a module that never had it.
struct Trio {
  Trio(const gpu::Device& device, const gpu_scene::GpuScene& scene, const SkipCase& each,
       const std::vector<std::uint32_t>& pixels)
      : without(render::pathSpecFor(scene.features(), {})), with(without) {
    each.set(without, false);
    each.set(with, true);
    cutModule = frozenModule(pathModule(), pathSpecEntries(without));
    fullModule = frozenModule(pathModule(), pathSpecEntries(with));
    left.emplace(device, scene, pathModule(), pathSpecEntries(without), pixels);
    kept.emplace(device, scene, pathModule(), pathSpecEntries(with), pixels);
    if (!cutModule.empty()) {
      cut.emplace(device, scene, cutModule, std::span<const gpu::SpecEntry>(), pixels);
    }
  }

  void run(std::uint32_t repeats) {
    for (std::uint32_t repeat = 0; repeat <= repeats; ++repeat) {
      for (std::optional<PathRun>* each : {&left, &kept, &cut}) {
        if (*each) {
          (*each)->run(kSamples, repeat, repeat == 0);
        }
      }
    }
  }

  passes::PathSpec without;
  passes::PathSpec with;
  std::vector<std::uint32_t> cutModule; ///< `without` folded; empty without SPIRV-Tools
  std::vector<std::uint32_t> fullModule;
  std::optional<PathRun> left;
  std::optional<PathRun> kept;
  std::optional<PathRun> cut;
};

Json caseRow(const Session& session, const std::string& sceneName, const SkipCase& each, Trio& trio) {
  const std::uint32_t repeats = session.options.repeats;
  trio.run(repeats);
  const PathFigures& left = trio.left->figures();
  const PathFigures& kept = trio.kept->figures();
  const double microseconds = 1e6 * median(left.seconds) * double(left.seconds.size()) / left.samples;
  const Figure keptOverLeft = ratioInTurn(kept.seconds, left.seconds);
  std::string cutText = "-";
  Json row{{"scene", sceneName},
           {"feature", each.feature},
           {"microsecondsPerSample", microseconds},
           {"withOverWithout", keptOverLeft.value},
           {"compileSecondsWithout", trio.left->compileSeconds()},
           {"compileSecondsWith", trio.kept->compileSeconds()},
           {"pictures", pictureText(kept, left)}};
  if (trio.cut) {
    const Figure cutOverLeft = ratioInTurn(trio.cut->figures().seconds, left.seconds);
    cutText = rangeText(cutOverLeft, repeats);
    row["builtWithoutOverSpecialized"] = cutOverLeft.value;
    row["moduleBytesWithout"] = trio.cutModule.size() * 4;
    row["moduleBytesWith"] = trio.fullModule.size() * 4;
    row["picturesOfBuiltWithout"] = pictureText(trio.cut->figures(), left);
  }
  fmt::print("{:<20}{:<25}{:>8}  {:<21}{:<21}{:>6.0f} {:>6.0f} {:>7} {:>6}  {}{}\n", sceneName, each.feature,
             shortText(microseconds), rangeText(keptOverLeft, repeats), cutText, double(trio.cutModule.size()) * 4e-3,
             double(trio.fullModule.size()) * 4e-3, shortText(trio.left->compileSeconds()),
             shortText(trio.kept->compileSeconds()), row["pictures"].get<std::string>(),
             trio.cut ? ", " + row["picturesOfBuiltWithout"].get<std::string>() : "");
  std::fflush(stdout);
  return row;
}

Json caseRows(const Session& session, const std::vector<SkipScene>& scenes) {
  fmt::print("\nPass `path`, {} kB of SPIR-V for all scenes. Left out: what the renderer does. Built without: from a "
             "module folded beforehand.\n{:<20}{:<25}{:>8}  {:<21}{:<21}{:>13} {:>14}  {}\n",
             pathModule().size_bytes() / 1000, "scene", "feature", "us/samp.", "kept / left out", "built w. / left out",
             "kB left, kept", "compile s", "picture of kept, of built without");
  Json rows = Json::array();
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const gpu_scene::GpuScene gpuScene(session.device, scenes[i].scene.scene, scenes[i].scene.volumes,
                                       render::layoutOf(render::Method::Path));
    const std::vector<std::uint32_t> pixels = allPixels(scenes[i].scene);
    for (const SkipCase& each : skipCases()) {
      if (each.scene == i) {
        Trio trio(session.device, gpuScene, each, pixels);
        rows.push_back(caseRow(session, scenes[i].name, each, trio));
      }
    }
  }
  return rows;
}

/// A method on a scene: what it keeps on the device, what the driver compiles, what a sample costs.
struct MethodRun {
  MethodRun(const Session& session, const BenchScene& scene, render::Method method) {
    const double before = double(session.device.allocatedBytes());
    gpuScene =
        std::make_unique<gpu_scene::GpuScene>(session.device, scene.scene, scene.volumes, render::layoutOf(method));
    sceneBytes = double(session.device.allocatedBytes()) - before;
    render::EstimatorOptions options;
    options.method = method;
    options.rays = render::RayCaster::Tree; // PathRun has this module too
    options.cacheBytes = session.options.cacheBytes;
    const std::vector<std::uint32_t> pixels = allPixels(scene);
    const Cost cold = costOf([&] {
      contender.emplace(render::methodName(method), session.device, scene, *gpuScene, options);
      contender->run({pixels.begin(), pixels.begin() + 64}, 1, 0, true);
    });
    coldSeconds = secondsOf(cold, session.device);
    passBytes = double(session.device.allocatedBytes()) - before - sceneBytes;
  }

  std::unique_ptr<gpu_scene::GpuScene> gpuScene;
  std::optional<Contender> contender;
  double sceneBytes = 0.0;
  double passBytes = 0.0; ///< pixels, sums, suspended states, light caches
  double coldSeconds = 0.0;
};

Json methodRows(const Session& session, const SkipScene& each) {
  std::vector<MethodRun> runs;
  std::vector<render::Method> methods{render::Method::Path};
  if (each.scene.scene.objects.empty() && each.scene.scene.depth() == 1) {
    methods = {render::Method::March, render::Method::Tracking, render::Method::Path};
  }
  for (const render::Method method : methods) {
    runs.emplace_back(session, each.scene, method);
  }
  const std::vector<std::uint32_t> pixels = allPixels(each.scene);
  for (std::uint32_t repeat = 0; repeat <= session.options.repeats; ++repeat) {
    for (MethodRun& run : runs) {
      run.contender->run(pixels, kSamples, repeat, repeat == 0);
    }
  }
  Json rows = Json::array();
  for (const MethodRun& run : runs) {
    const Passes& passes = run.contender->passes(kSamples);
    const double perSample = 1e6 * median(passes.seconds) / (double(pixels.size()) * kSamples);
    fmt::print("{:<30}{:<10}{:>10}{:>10}{:>10}{:>10}{:>12}\n", each.name, run.contender->name(), shortText(perSample),
               shortText(run.sceneBytes * 1e-6), shortText(double(run.gpuScene->surfaceBytes()) * 1e-6),
               shortText(run.passBytes * 1e-6), shortText(run.coldSeconds));
    rows.push_back({{"scene", each.name},
                    {"method", run.contender->name()},
                    {"microsecondsPerSample", perSample},
                    {"sceneBytes", run.sceneBytes},
                    {"surfaceBytes", run.gpuScene->surfaceBytes()},
                    {"passBytes", run.passBytes},
                    {"coldSeconds", run.coldSeconds}});
  }
  std::fflush(stdout);
  return rows;
}

} // namespace

Json skipReport(const Session& session) {
  const Options& options = session.options;
  std::vector<SkipScene> scenes = skipScenes(session.grid, options.opticalDepth, options.size);
  Json report{{"features", caseRows(session, scenes)}, {"methods", Json::array()}};
  fmt::print("\n{:<30}{:<10}{:>10}{:>10}{:>10}{:>10}{:>12}\n", "scene", "method", "us/samp.", "scene MB", "surfaces",
             "pass MB", "first s");
  for (const std::size_t media : {kMist, kCloud}) {
    SkipScene single = scenes[media];
    single.name += ", one event";
    single.scene.scene.render.depth = 1;
    report["methods"].push_back(methodRows(session, single));
  }
  for (const SkipScene& scene : scenes) {
    report["methods"].push_back(methodRows(session, scene));
  }
  return report;
}

} // namespace tyndall::microbench
