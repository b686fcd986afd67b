// SPDX-License-Identifier: Apache-2.0
#include "bench/ceilings.h"
#include "bench/path_run.h"
#include "bench/path_scenes.h"
#include "microbench/commands.h"
#include "microbench/measure.h"
#include "microbench/contender.h"
#include "render/path_tracer.h"
#include "render/pixel_order.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <optional>

namespace tyndall::microbench {
namespace {

using Json = nlohmann::ordered_json;
using passes::PathSpec;

constexpr std::uint32_t kSamples = 16;

/// The pass with a part left out, to see what the part costs; the expectation may change.
struct Variant {
  const char* name;
  void (*set)(PathSpec& spec);
};
constexpr Variant kVariants[] = {
    {"as rendered", [](PathSpec&) {}},
    {"nothing counted", [](PathSpec& spec) { spec.kCount = false; }},
    {"lights chosen evenly", [](PathSpec& spec) { spec.kLightSelection = interop::kSelectUniform; }},
    {"no shadow rays",
     [](PathSpec& spec) {
       spec.kTechniques = interop::kTechniqueDirection;
       spec.kAimed = false; // it casts some too
     }},
};

struct PathScene {
  std::string name;
  BenchScene scene;
  std::optional<RayScene> rays; ///< whose bare casts are the ceiling
};

struct Ceiling {
  double secondsPerSegment = 0.0; ///< of the bare cast: half closest, half any hit
  double secondsPerLookup = 0.0;
  std::string text;
  Json json;
};

Ceiling ceilingOf(const Session& session, const PathScene& scene, const gpu_scene::GpuScene& gpuScene) {
  Ceiling ceiling;
  if (scene.rays) {
    const RayRates rates =
        rayRates(session.device, *scene.rays, session.options.size, session.options.repeats, Clock::Device);
    ceiling.secondsPerSegment = 0.5 / rates.diffuse + 0.5 / rates.shadow;
    ceiling.text =
        fmt::format("bare casts, M per second: {} primary, {} diffuse, {} shadow", shortText(rates.primary * 1e-6),
                    shortText(rates.diffuse * 1e-6), shortText(rates.shadow * 1e-6));
    ceiling.json = {{"primary", rates.primary}, {"diffuse", rates.diffuse}, {"shadow", rates.shadow}};
  } else {
    constexpr double kMeanStep = 8.0;
    const Cost rates = bareLookups(session.device, gpuScene, session.options.size, session.options.repeats, kMeanStep);
    const double rate = secondsOf(rates, session.device);
    ceiling.secondsPerLookup = 1.0 / rate;
    ceiling.text = fmt::format("bare lookups, M per second: {}", shortText(rate * 1e-6));
    ceiling.json = {{"lookups", rate}};
  }
  return ceiling;
}

Json variantRow(const Session& session, const Variant& variant, const PathFigures& figures, const PathFigures& whole,
                const Ceiling& ceiling) {
  const double seconds = figures.totalSeconds();
  const double bare = figures.segments * ceiling.secondsPerSegment + figures.lookups * ceiling.secondsPerLookup;
  const Figure ratio = ratioInTurn(figures.seconds, whole.seconds);
  fmt::print("  {:<22}{:>9}{:>9}{:>9}{:>8}{:>8}{:>8}{:>9}  {}\n", variant.name,
             shortText(1e-6 * figures.samples / seconds), shortText(1e-6 * figures.segments / seconds),
             shortText(1e-6 * figures.lookups / seconds), shortText(figures.segments / figures.samples),
             shortText(figures.events / figures.samples), shortText(figures.lookups / figures.samples),
             shortText(bare / seconds), rangeText(ratio, session.options.repeats));
  return {{"variant", variant.name},
          {"samplesPerSecond", figures.samples / seconds},
          {"segmentsPerSecond", figures.segments / seconds},
          {"lookupsPerSecond", figures.lookups / seconds},
          {"segmentsPerSample", figures.segments / figures.samples},
          {"eventsPerSample", figures.events / figures.samples},
          {"lookupsPerSample", figures.lookups / figures.samples},
          {"bareShare", bare / seconds},
          {"timeOverWhole", ratio.value}};
}

Json sceneRows(const Session& session, const PathScene& scene) {
  const gpu_scene::GpuScene gpuScene(session.device, scene.scene.scene, scene.scene.volumes,
                                     render::layoutOf(render::Method::Path));
  const std::vector<std::uint32_t> pixels = render::dispatchOrder({glm::uvec2(0), scene.scene.scene.film.size});
  std::vector<PathRun> runs;
  for (const Variant& variant : kVariants) {
    PathSpec spec = render::pathSpecFor(gpuScene.features(), {});
    variant.set(spec);
    runs.emplace_back(session.device, gpuScene, pathModule(), pathSpecEntries(spec), pixels);
  }
  for (std::uint32_t repeat = 0; repeat <= session.options.repeats; ++repeat) {
    for (PathRun& run : runs) {
      run.run(kSamples, repeat, repeat == 0);
    }
  }
  const Ceiling ceiling = ceilingOf(session, scene, gpuScene);
  fmt::print("{}; {}\n", scene.name, ceiling.text);
  Json rows = Json::array();
  const PathFigures counted = runs.front().figures();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    PathFigures figures = runs[i].figures();
    if (figures.segments == 0.0) { // not counted, but the same paths
      figures.segments = counted.segments;
      figures.events = counted.events;
      figures.lookups = counted.lookups;
    }
    rows.push_back(variantRow(session, kVariants[i], figures, counted, ceiling));
  }
  std::fflush(stdout);
  return {{"scene", scene.name}, {"ceiling", ceiling.json}, {"rows", rows}};
}

} // namespace

Json pathsReport(const Session& session) {
  const std::uint32_t size = session.options.size;
  constexpr double kFog = 0.5;
  constexpr int kRings = 64;
  PathScene box{"box, 36 triangles", surfaceScene(boxScene(), size), boxScene()};
  PathScene foggy{"the box in fog, 0.5 per unit", box.scene, boxScene()};
  addFog(foggy.scene, kFog);
  PathScene cloud{fmt::format("cloud, multiple scattering, optical depth {}", session.options.opticalDepth),
                  sunScene(session.grid, session.options.opticalDepth, size), std::nullopt};
  cloud.scene.scene.render.depth = 0;
  const RayScene spheres = bumpySpheres(kRings);
  PathScene many{spheres.name, surfaceScene(spheres, size), spheres};
  fmt::print("\nM samples, M segments (camera, bounce and shadow rays) and M lookups per {}; per sample; share of the "
             "time that bare casts and lookups would take; time over the whole's\n  {:<22}{:>9}{:>9}{:>9}{:>8}{:>8}"
             "{:>8}{:>9}  {}\n",
             session.device.info().type == "cpu" ? "CPU core second" : "second", "", "samples/s", "segm./s",
             "lookups/s", "segm.", "events", "lookups", "bare", "time");
  Json report = Json::array();
  for (const PathScene* scene : {&box, &foggy, &cloud, &many}) {
    report.push_back(sceneRows(session, *scene));
  }
  return report;
}

} // namespace tyndall::microbench
