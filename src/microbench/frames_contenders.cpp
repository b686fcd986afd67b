// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "microbench/frames.h"

#include <algorithm>

namespace tyndall::microbench {
namespace {

/// An integrator with settings for the room's lamps, and one of them changed.
struct Change {
  const char* name;
  const char* integrator;
  const char* path; ///< null: none
  const char* value;
};

constexpr Change kChanges[] = {
    {"path", "path", nullptr, nullptr},
    {"mcpg-paper", "mcpg-paper", nullptr, nullptr},
    {"mcpg-paper without velocity", "mcpg-paper", "guide.most_time", "0"},
    {"mcpg-paper without static grid", "mcpg-paper", "guide.static_grid", "false"},
    {"mcpg-paper without invalidation", "mcpg-paper", "guide.weight", "accepted"},
    {"mcpg-paper without previous look-up", "mcpg-paper", "guide.previous_lookup", "false"},
    {"mcpg", "mcpg", nullptr, nullptr},
    {"mcpg without velocity", "mcpg", "guide.most_time", "0"},
    {"mcpg without static grid", "mcpg", "guide.static_grid", "false"},
    {"mcpg without forgetting", "mcpg", "guide.forget_rate", "0"},
    {"mcpg with least_rate 0.03", "mcpg", "guide.least_rate", "0.03"},
};

/// Lobes as wide as the lamps.
std::vector<scene::Override> settingsOf(const std::string& integrator) {
  std::vector<scene::Override> settings{{"render.integrator", integrator}};
  if (integrator == "mcpg-paper") {
    settings.push_back({"guide.prior_radius", "20"});
  } else if (integrator == "mcpg") {
    settings.push_back({"guide.prior_radius", "40"});
    settings.push_back({"guide.most_kappa", "1000"});
  }
  return settings;
}

std::vector<std::string> allNames() {
  std::vector<std::string> names;
  std::transform(std::begin(kChanges), std::end(kChanges), std::back_inserter(names),
                 [](const Change& change) { return change.name; });
  return names;
}

FrameContender contenderOf(const Change& change, const std::vector<scene::Override>& overrides) {
  FrameContender contender{change.name, settingsOf(change.integrator)};
  if (change.path != nullptr) {
    contender.overrides.push_back({change.path, change.value});
  }
  if (std::string(change.integrator) != "path") {
    contender.overrides.insert(contender.overrides.end(), overrides.begin(), overrides.end());
  }
  return contender;
}

} // namespace

std::vector<FrameContender> frameContenders(const std::vector<std::string>& names,
                                            const std::vector<scene::Override>& overrides) {
  std::vector<FrameContender> contenders;
  for (const std::string& name : names.empty() ? allNames() : names) {
    const auto* change = std::find_if(std::begin(kChanges), std::end(kChanges),
                                      [&name](const Change& each) { return each.name == name; });
    if (change == std::end(kChanges)) {
      fail("no contender \"{}\"; there are {}", name, joinNames(allNames()));
    }
    contenders.push_back(contenderOf(*change, overrides));
  }
  return contenders;
}

} // namespace tyndall::microbench
