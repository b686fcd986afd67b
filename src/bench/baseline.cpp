// SPDX-License-Identifier: Apache-2.0
#include "bench/baseline.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace tyndall::bench {
namespace {

constexpr double kSureErrors =
    4.0; ///< standard errors: a suite has dozens of products, of which none may fail by chance

struct Kind {
  const char* measure;
  double Work::*count;
};
constexpr Kind kKinds[] = {{"relMSE x lookups", &Work::lookups},
                           {"relMSE x segments", &Work::segments},
                           {"relMSE x pieces", &Work::pieces},
                           {"relMSE x dispatches", &Work::dispatches}};

const SceneResult* findScene(const Report& report, const SceneResult& like) {
  const auto found = std::ranges::find_if(
      report.scenes, [&](const SceneResult& each) { return each.name == like.name && each.size == like.size; });
  return found == report.scenes.end() ? nullptr : &*found;
}

const Level* findLevel(const ContenderResult& contender, const std::string& label) {
  const auto found = std::ranges::find_if(contender.levels, [&](const Level& each) { return each.label == label; });
  return found == contender.levels.end() ? nullptr : &*found;
}

void compareLevels(std::vector<Change>& changes, const Change& place, const Level& now, const Level& then) {
  for (const Kind& kind : kKinds) {
    const double before = (*then.work).*kind.count;
    const double after = (*now.work).*kind.count;
    if (before <= 0.0 || after <= 0.0 || then.errors.relMse.value <= 0.0) {
      continue;
    }
    Change change = place;
    change.measure = kind.measure;
    change.ratio = now.errors.relMse / then.errors.relMse;
    change.ratio.value *= after / before;
    change.runs = std::min(now.runs, then.runs);
    const bool same = now.errors.relMse.value == then.errors.relMse.value; // the same pictures
    const double doubt = same ? 1.0 : std::exp(kSureErrors * change.ratio.logError);
    change.worse = change.ratio.value / doubt > kAllowedRise;
    change.better = change.ratio.value * doubt < 1.0 / kAllowedRise;
    changes.push_back(change);
  }
}

} // namespace

std::vector<Change> compareReports(const Report& now, const Report& then) {
  std::vector<Change> changes;
  for (const SceneResult& scene : now.scenes) {
    const SceneResult* before = findScene(then, scene);
    if (before == nullptr) {
      continue;
    }
    for (const ContenderResult& contender : scene.contenders) {
      const ContenderResult* other = findContender(*before, contender.name);
      if (!contender.ours || other == nullptr) {
        continue;
      }
      for (const Level& level : contender.levels) {
        const Level* earlier = findLevel(*other, level.label);
        if (earlier != nullptr && level.work && earlier->work) {
          compareLevels(changes, {scene.name, contender.name, level.label, {}, {}, 0, false, false}, level, *earlier);
        }
      }
    }
  }
  if (changes.empty()) {
    fail("--against: the two reports have no scene, size, contender and samples in common; run the same suite");
  }
  return changes;
}

std::string formatChanges(const std::vector<Change>& changes) {
  std::vector<Change> sorted = changes;
  std::ranges::stable_sort(sorted, std::greater<>(), [](const Change& change) { return change.ratio.value; });
  std::string text;
  for (const Change& change : sorted) {
    if (change.worse || change.better) {
      text += fmt::format("{:<7}{:<20} {:<14} {:>7} samples  {:<20} {}\n", change.worse ? "WORSE" : "better",
                          change.scene, change.contender, change.effort, change.measure,
                          rangeText(change.ratio, std::max<std::size_t>(change.runs, 2)));
    }
  }
  return text;
}

} // namespace tyndall::bench
