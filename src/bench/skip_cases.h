// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/scenes.h"
#include "passes/path/path_pass.h"

#include <span>
#include <string>
#include <vector>

namespace tyndall::bench {

/// A scene that lacks what its cases turn on.
struct SkipScene {
  std::string name;
  BenchScene scene;
};

/// Scenes by the index that SkipCase::scene has.
enum SkipSceneIndex : std::size_t { kMist, kMistAndFarSurface, kBox, kCloud, kCloudAndFarSurface, kCloudRow };
std::vector<SkipScene> skipScenes(const volume::BrickGrid& grid, double opticalDepth, std::uint32_t size);

/// A feature that the scene does without: with its code or not, the expectation is the same.
struct SkipCase {
  const char* feature;
  std::size_t scene;
  void (*set)(passes::PathSpec& spec, bool on);
};
std::span<const SkipCase> skipCases();

} // namespace tyndall::bench
