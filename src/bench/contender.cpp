// SPDX-License-Identifier: Apache-2.0
#include "bench/contender.h"

#include <fmt/format.h>

namespace tyndall::bench {
namespace {

std::vector<LevelPlan> sampleLevels(const SuiteScene& scene) {
  std::vector<LevelPlan> levels;
  for (const std::uint32_t samples : scene.samples) {
    levels.push_back({std::to_string(samples), double(samples), {"--spp", std::to_string(samples)}});
  }
  return levels;
}

void append(std::vector<std::string>& words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
}

} // namespace

std::filesystem::path statisticsOf(const Job& job) {
  std::filesystem::path path = job.output;
  return path.replace_extension(".json");
}

Contender ownContender(const std::string& name, const std::filesystem::path& program,
                       const std::vector<std::string>& arguments, bool everywhere) {
  const auto command = [program, arguments](const Job& job) {
    std::vector<std::string> words{program.string(), "render", job.scene->file.string(), "--quiet"};
    append(words, {"-o", job.output.string(), "--stats", statisticsOf(job).string()});
    append(words, {"--size", fmt::format("{}x{}", job.scene->size.x, job.scene->size.y)});
    append(words, {"--seed", std::to_string(job.seed), "--aov", "transmittance"});
    append(words, job.level->arguments);
    append(words, job.scene->arguments);
    append(words, arguments);
    return words;
  };
  return {name, name, true, everywhere, true, sampleLevels, command};
}

} // namespace tyndall::bench
