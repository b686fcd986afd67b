// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "bench/contender.h"
#include "bench/process.h"

#include <nlohmann/json.hpp>

#include <algorithm>

/// Other renderers, through the scripts in peers/, whose README says what they are given and how that was checked.
namespace tyndall::bench {
namespace {

constexpr const char* kScripts = "peers";
constexpr double kProbeSeconds = 120.0;

/// A way to run a peer.
struct Variant {
  const char* name;
  const char* title; ///< after the program's own name and version
  std::vector<std::string> arguments;
};

struct Peer {
  const char* name;
  const char* script;
  std::vector<Variant> variants;
  /// A program without samples: its settings, from coarse to fine, for the argument --setting. None: it takes samples.
  std::vector<std::string> settings;
};

/// Coarse to fine: picture over the one wanted, step, shadow step [voxels], cutoff.
const std::vector<std::string> kMarchSettings{"1,1,3,0", "1,1,1,0", "1,1,0.5,0.005", "1,1,0.125,0.002",
                                              "2,1,0.125,0.001"};

const std::vector<Peer>& peers() {
  static const std::vector<Peer> all{{"mitsuba",
                                      "mitsuba_render.py",
                                      {{"mitsuba-llvm", "llvm", {"--variant", "llvm_ad_rgb"}},
                                       {"mitsuba-scalar", "scalar", {"--variant", "scalar_rgb"}}},
                                      {}},
                                     {"cycles", "cycles.py", {{"cycles", "CPU", {}}}, {}},
                                     {"vdb_render", "vdb_render.py", {{"vdb_render", "biased", {}}}, kMarchSettings}};
  return all;
}

/// What the script says that the program is. @throws Error with the script's last line if it is not there.
std::string nameAndVersion(const Peer& peer, const std::filesystem::path& script) {
  const ProcessOutcome outcome = runProcess({"python3", script.string(), "probe"}, {}, kProbeSeconds);
  if (outcome.exitCode != 0) {
    fail("--peer {}: {}", peer.name,
         outcome.errors.empty() ? "the script says nothing; is python3 installed?" : lastLine(outcome.errors));
  }
  const nlohmann::json answer = nlohmann::json::parse(outcome.output, nullptr, false);
  if (!answer.is_object() || !answer.contains("name") || !answer.contains("version")) {
    fail("--peer {}: {} did not say what it is; run it with \"probe\" by hand", peer.name, script.string());
  }
  return answer["name"].get<std::string>() + " " + answer["version"].get<std::string>();
}

Contender contenderOf(const Peer& peer, const Variant& variant, const std::filesystem::path& script,
                      const std::string& program) {
  Contender contender;
  contender.name = variant.name;
  contender.title = fmt::format("{}, {}", program, variant.title);
  contender.ours = false;
  contender.seeded = peer.settings.empty();
  contender.levels = [settings = peer.settings](const SuiteScene& scene) {
    std::vector<LevelPlan> levels;
    for (const std::string& setting : settings) {
      levels.push_back({setting, 0.0, {"--setting", setting}});
    }
    if (settings.empty()) {
      for (const std::uint32_t samples : scene.samples) {
        levels.push_back({std::to_string(samples), double(samples), {"--spp", std::to_string(samples)}});
      }
    }
    return levels;
  };
  contender.command = [script, arguments = variant.arguments](const Job& job) {
    std::vector<std::string> words{"python3", script.string(), "render", job.exported.string()};
    words.insert(words.end(), {"-o", job.output.string(), "--seed", std::to_string(job.seed)});
    if (job.threads > 0) {
      words.insert(words.end(), {"--threads", std::to_string(job.threads)});
    }
    words.insert(words.end(), job.level->arguments.begin(), job.level->arguments.end());
    words.insert(words.end(), arguments.begin(), arguments.end());
    return words;
  };
  return contender;
}

} // namespace

std::vector<std::string> peerNames() {
  std::vector<std::string> names;
  std::ranges::transform(peers(), std::back_inserter(names), [](const Peer& peer) { return peer.name; });
  return names;
}

std::vector<Contender> peerContenders(const std::string& name) {
  const auto peer = std::ranges::find_if(peers(), [&](const Peer& each) { return each.name == name; });
  if (peer == peers().end()) {
    const std::string nearest = nearestName(name, peerNames());
    fail("--peer {}: no such peer{}; there are {}", name,
         nearest.empty() ? "" : fmt::format(" (did you mean {}?)", nearest), joinNames(peerNames()));
  }
  const std::filesystem::path script = findShipped(std::filesystem::path(kScripts) / peer->script);
  if (script.empty()) {
    fail("--peer {}: the script {}/{} lies nowhere above the program; run Tyndall from its checkout", name, kScripts,
         peer->script);
  }
  const std::string program = nameAndVersion(*peer, script);
  std::vector<Contender> contenders;
  for (const Variant& variant : peer->variants) {
    contenders.push_back(contenderOf(*peer, variant, script, program));
  }
  return contenders;
}

} // namespace tyndall::bench
