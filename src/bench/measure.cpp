// SPDX-License-Identifier: Apache-2.0
#include "bench/measure.h"

#include "base/error.h"
#include "base/file.h"
#include "bench/evaluate.h"
#include "bench/exact_picture.h"
#include "bench/process.h"

#include <algorithm>
#include <cmath>

namespace tyndall::bench {
namespace {

constexpr int kCannot = 3;               ///< exit code of a peer that cannot render such a scene
constexpr std::uint32_t kTimesOfOne = 3; ///< runs of a program whose pictures depend on no seed, for its time
/// Where nothing is known, pictures of their own tell what errors are relative to: as many, of so many times the
/// samples of the highest effort. From the measured pictures themselves, one contender's outliers would make its own
/// errors look small and the others' large.
constexpr std::uint32_t kReferences = 4;
constexpr double kReferenceSamples = 4.0;
constexpr std::uint32_t kReferenceSeeds = 1u << 20; ///< above the measured ones

/// A contender on its way through its efforts.
struct Entrant : Rendered {
  std::vector<LevelPlan> plans;
};

class SceneRun {
public:
  SceneRun(const SuiteScene& scene, const std::vector<Contender>& contenders, const MeasureOptions& options,
           const Say& say)
      : scene_(scene), options_(options), say_(say) {
    for (const Contender& contender : contenders) {
      if (contender.everywhere || std::ranges::find(scene.contenders, contender.name) != scene.contenders.end()) {
        entrants_.push_back({{&contender, {}, {}}, contender.levels(scene)});
      }
    }
    TYNDALL_CHECK(!entrants_.empty());
  }

  SceneResult run() {
    exportForPeers();
    std::size_t levels = 0;
    for (const Entrant& entrant : entrants_) {
      levels = std::max(levels, entrant.plans.size());
    }
    for (std::size_t level = 0; level < levels; ++level) {
      for (Entrant& entrant : entrants_) {
        if (takesPart(entrant, level)) {
          entrant.levels.push_back({entrant.plans[level], {}, {}, {}, 0.0, {}, {}});
        }
      }
      for (std::uint32_t seed = 0; seed < options_.seeds; ++seed) {
        for (Entrant& entrant : entrants_) {
          const bool wanted = entrant.contender->seeded || seed < kTimesOfOne;
          if (entrant.refusal.empty() && wanted && entrant.levels.size() == level + 1) {
            render(entrant, entrant.levels.back(), seed);
          }
        }
      }
    }
    return result();
  }

private:
  /// Pictures by the first contender to measure against.
  Replicates references() {
    Entrant& first = entrants_.front();
    const Measured& best = first.levels.back();
    const double affordable = options_.limitSeconds / median(best.cpu);
    const double samples = std::floor(best.plan.samples * std::clamp(affordable, 1.0, kReferenceSamples));
    const std::string count = std::to_string(std::uint32_t(samples));
    const LevelPlan plan{count, samples, {"--spp", count}};
    Measured measured{plan, {}, {}, {}, 0.0, {}, {}};
    for (std::uint32_t i = 0; i < kReferences; ++i) {
      render(first, measured, kReferenceSeeds + i);
    }
    referenceText_ = fmt::format("scatter of {} seeds, relative to {} pictures of {} samples by {}", options_.seeds,
                                 kReferences, count, first.contender->name);
    return measured.pictures;
  }

  /// Whether a contender has an effort of this number that it may be expected to end in time.
  bool takesPart(const Entrant& entrant, std::size_t level) const {
    if (!entrant.refusal.empty() || level >= entrant.plans.size() || entrant.levels.size() != level) {
      return false;
    }
    if (level < 2) {
      return level == 0 || median(entrant.levels.back().cpu) <= options_.limitSeconds;
    }
    const Measured& last = entrant.levels[level - 1];
    const Measured& before = entrant.levels[level - 2];
    const double grown = last.plan.samples - before.plan.samples;
    const double growth = grown > 0.0 ? (entrant.plans[level].samples - last.plan.samples) / grown : 0.0;
    const double rise = std::max(median(last.cpu) - median(before.cpu), 0.0);
    return median(last.cpu) + growth * rise <= options_.limitSeconds;
  }

  void exportForPeers() {
    const bool any = std::ranges::any_of(entrants_, [](const Entrant& each) { return !each.contender->ours; });
    if (!any) {
      return;
    }
    exported_ = options_.folder / (scene_.name + ".export");
    std::vector<std::string> command{
        options_.program.string(), "export", scene_.file.string(),
        exported_.string(),        "--size", fmt::format("{}x{}", scene_.size.x, scene_.size.y)};
    const ProcessOutcome outcome = runProcess(command, {}, options_.limitSeconds);
    if (outcome.exitCode != 0) {
      for (Entrant& entrant : entrants_) {
        if (!entrant.contender->ours) {
          entrant.refusal = lastLine(outcome.errors);
        }
      }
    }
  }

  void render(Entrant& entrant, Measured& measured, std::uint32_t seed) {
    Job job{&scene_, exported_, {}, &measured.plan, options_.firstSeed + seed, options_.threads};
    job.output = options_.folder /
                 fmt::format("{}.{}.{}.{}.exr", scene_.name, entrant.contender->name, entrant.levels.size(), seed);
    std::vector<std::string> environment;
    if (entrant.contender->ours && options_.threads > 0) {
      environment.push_back(fmt::format("LP_NUM_THREADS={}", options_.threads)); // read by the CPU device
    }
    constexpr double kPatience = 10.0; // wall over expected CPU time, on a busy machine
    const ProcessOutcome outcome =
        runProcess(entrant.contender->command(job), environment, kPatience * options_.limitSeconds);
    if (outcome.exitCode != 0) {
      refuse(entrant, outcome);
      return;
    }
    measured.cpu.push_back(outcome.cpu);
    measured.wall.push_back(outcome.wall);
    measured.peakBytes = std::max(measured.peakBytes, double(outcome.peakBytes));
    if (entrant.contender->seeded || seed == 0) {
      measured.pictures.push_back(readPicture(job.output));
      if (measured.pictures.back().size != scene_.size) {
        fail("{} made a picture of {}x{} pixels where {}x{} were asked for", entrant.contender->name,
             measured.pictures.back().size.x, measured.pictures.back().size.y, scene_.size.x, scene_.size.y);
      }
    }
    if (seed == 0) {
      measured.first = job.output;
    }
    if (entrant.contender->ours) {
      measured.statistics.push_back(Json::parse(readTextFile(statisticsOf(job))));
    }
  }

  void refuse(Entrant& entrant, const ProcessOutcome& outcome) {
    const std::string why = lastLine(outcome.errors);
    if (entrant.contender->ours) {
      fail("{}: {} could not render it: {}", scene_.name, entrant.contender->name, why);
    }
    entrant.refusal = outcome.exitCode == kCannot ? why : "failed: " + why;
    entrant.levels.clear();
    say_(fmt::format("{:<20} {:<16} {}", scene_.name, entrant.contender->name, entrant.refusal));
  }

  SceneResult result() {
    const std::optional<ExactPicture> exact = exactPicture(scene_);
    const Replicates against = exact ? Replicates() : references();
    const Reference reference =
        exact ? referenceOf(exact->picture, true, exact->sure) : referenceOf(meanOf(against), false);
    const Measured& best = entrants_.front().levels.back();
    SceneResult result{scene_.name, scene_.title, scene_.size, {}, {}, {}, {}};
    result.reference = exact ? "against quadrature" : referenceText_;
    const Json& first = best.statistics.front();
    result.device = fmt::format("{}, {}", first.value("/device/name"_json_pointer, std::string()),
                                first.value("/device/driver"_json_pointer, std::string()));
    result.estimator = fmt::format("{} ({})", first.value("/estimator/name"_json_pointer, std::string()),
                                   first.value("/estimator/reason"_json_pointer, std::string()));
    const Showing showing{first.value("/settings/exposure_stops"_json_pointer, 0.0),
                          first.value("/settings/view"_json_pointer, std::string())};
    for (const Entrant& entrant : entrants_) {
      result.contenders.push_back(evaluate(entrant, reference, against, showing));
      tell(result.contenders.back());
    }
    return result;
  }

  void tell(const ContenderResult& contender) const {
    if (contender.levels.empty()) {
      return;
    }
    const Level& last = contender.levels.back();
    say_(fmt::format("{:<20} {:<16} {:>7} samples: relMSE {:<9} in {:>7} s CPU{}", scene_.name, contender.name,
                     last.label, shortText(last.errors.relMse.value), shortText(last.cpu.value),
                     contender.bias.found ? fmt::format(", mean {:+.2f} %", 100.0 * contender.bias.mean) : ""));
  }

  const SuiteScene& scene_;
  const MeasureOptions& options_;
  const Say& say_;
  std::vector<Entrant> entrants_;
  std::filesystem::path exported_;
  std::string referenceText_;
};

} // namespace

SceneResult measureScene(const SuiteScene& scene, const std::vector<Contender>& contenders,
                         const MeasureOptions& options, const Say& say) {
  return SceneRun(scene, contenders, options, say).run();
}

} // namespace tyndall::bench
