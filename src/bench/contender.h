// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/suite.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace tyndall::bench {

/// One effort of a contender.
struct LevelPlan {
  std::string label;
  double samples = 0.0; ///< per pixel; 0: the program takes none
  std::vector<std::string> arguments;
};

/// What a run is to make.
struct Job {
  const SuiteScene* scene = nullptr;
  std::filesystem::path exported; ///< the scene in the form that peers read
  std::filesystem::path output;   ///< EXR; ours write statistics beside it
  const LevelPlan* level = nullptr;
  std::uint32_t seed = 0;
  unsigned threads = 0; ///< 0: what the program chooses
};

/// A program with settings that renders a scene: ours, or somebody else's.
struct Contender {
  std::string name;
  std::string title;
  bool ours = true;
  bool everywhere = true; ///< false: in the scenes that name it
  bool seeded = true;     ///< false: its pictures depend on no seed
  std::function<std::vector<LevelPlan>(const SuiteScene&)> levels;
  std::function<std::vector<std::string>(const Job&)> command;
};

/// Ours: `program` with arguments of `tyndall render`.
Contender ownContender(const std::string& name, const std::filesystem::path& program,
                       const std::vector<std::string>& arguments, bool everywhere);

/// Where statistics of a run of ours are.
std::filesystem::path statisticsOf(const Job& job);

/// Names that --peer knows.
std::vector<std::string> peerNames();

/// What a peer offers on this machine: a contender or more.
/// @throws Error with what to install, if it is not there, or if no peer has this name.
std::vector<Contender> peerContenders(const std::string& name);

} // namespace tyndall::bench
