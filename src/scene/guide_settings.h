// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace tyndall::scene {

/// How directions of paths are drawn.
enum class Integrator {
  Path,         ///< by scattering and light samples alone
  ScreenChains, ///< Markov chains in screen space, at the first surface alone [Dittebrandt23]
  McpgPaper,    ///< Markov chains as published [Alber25]
  Mcpg,         ///< the same parts, set for multiple scattering beside light sampling
};

/// Where the score of a direction comes from.
enum class GuideScore {
  Path, ///< what the path itself has found there
  Cache ///< light that it has hit, else a cache of outgoing radiance
};

/// What the weight of a chain's state is.
enum class GuideWeight {
  Accepted, ///< mean score of accepted samples
  Forgets,  ///< ... lost where a sample in the middle of the lobe misses, as published
  Mean      ///< mean score of all samples that its lobe drew
};

/// How the cells of a hash grid grow with the distance from the camera.
struct GuideLevels {
  double angle = 0.02; ///< width of a cell per distance
  double finest = 1.0; ///< width of the finest cells [units]
  double ratio = 2.0;  ///< of the widths from level to level
  double spread = 1.0; ///< a vertex k levels coarser is taken with probability 2^-k spread; 0: never
};

/// Markov chain path guiding. Lengths are in units of `unit`; docs/guiding.md says what each is for and why it is what
/// it is.
struct GuideSettings {
  Integrator preset = Integrator::Path; ///< whose defaults they began with
  double unit = 0.0;                    ///< scene units; 0: the scene's diagonal / 1000
  GuideScore score = GuideScore::Path;
  std::uint32_t loads = 2;  ///< cells loaded at a vertex
  std::uint32_t states = 4; ///< of a cell; loads * states <= 16
  bool staticGrid = true;   ///< a coarse grid beside the adaptive one
  bool normals = false;     ///< adaptive cells differ by normal
  bool learnShare = true;   ///< of scattering's own directions
  GuideWeight weight = GuideWeight::Mean;
  bool fit = true;               ///< the states of a cell are fitted together
  double newbornShare = 0.1;     ///< of a fitted cell's weight that stands for what no state explains
  std::uint32_t fitSamples = 16; ///< of a fitted fine cell before it is read
  bool learn = true;             ///< false: the store is read alone
  bool watch = true;             ///< measure what guiding gains, and leave it away where it does not pay
  GuideLevels cells;
  GuideLevels radiance{.angle = 0.02, .finest = 1.0, .ratio = 2.0, .spread = 0.0};
  double staticWidth = 100.0;
  double adaptiveShare = 0.7; ///< of the loads, where there is a static grid
  double priorRadius = 150.0; ///< what one sample is taken for covers this radius at the light
  double priorLeast = 1e-4;   ///< 1 - cos that a single sample's lobe has at least
  double mostKappa = 100.0;   ///< of a state of one sample
  double kappaGrowth = 0.0;   ///< mostKappa grows with the number of samples to this power
  double scatterShare = 0.5;  ///< of directions that scattering draws; while it is learnt, until then
  double leastShare = 0.3;
  double mostShare = 0.85;
  std::uint32_t shareSamples = 8;
  double leastRate = 0.01; ///< of a chain's means
  double forgetBelow = 0.05;
  double forgetRate = 0.5;
  double radianceLimit = 8.0;
  double mostTime = 0.25;         ///< seconds that a target is moved ahead for at most
  bool previousLookup = true;     ///< in a frame's first round cells are looked up where surfaces were before it
  std::uint32_t roundSamples = 4; ///< of a pixel that know nothing of each other; 0: as many as a batch has
  std::uint32_t records = 8;      ///< vertices of a path that learn
  std::uint32_t window = 4;       ///< cells that a vertex may be in
  std::uint32_t slots = 0;        ///< adaptive cells; 0: by the picture and the memory
  double distanceShare = 0.0;     ///< of camera rays' distances that chains draw; where it is learnt, at most; 0: none
  double distanceWidth = 25.0;    ///< between the vertices of their chains [pixels]
  std::uint32_t distanceStates = 10; ///< of a vertex
  std::uint32_t distanceLoads = 3;
  double distanceSigma = 30.0; ///< of a chain that knows nothing [units]
};

/// Whether distance chains are kept.
bool guidesDistances(const GuideSettings& settings);

/// The settings that an integrator begins with.
GuideSettings guideSettings(Integrator integrator);

const char* integratorName(Integrator integrator);

} // namespace tyndall::scene
