// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace tyndall::bench {

/// How one value of an axis is rendered.
struct ScalingRun {
  std::filesystem::path scene;
  glm::uvec2 size{32};
  unsigned threads = 0; ///< 0: what the options say
};

/// An axis and what is rendered along it.
struct ScalingPlan {
  std::string name;
  std::string title;
  std::string axis;
  std::string theory; ///< in words
  std::vector<double> values = {};
  std::vector<std::string> arguments = {}; ///< of `tyndall render`
  bool wallClock = false;
  double anchor = 0.0; ///< where theory and measurement are made equal; 0: at the first value
  /// Cost of a sample over the value, up to a factor.
  std::function<double(double value)> cost;
  /// Bytes over the value, up to a factor and a constant.
  std::function<double(double value)> size;
  /// Makes the scene of a value, with all its files, in a folder.
  std::function<ScalingRun(double value, const std::filesystem::path& folder)> make;
};

/// All axes. @param cores up to which threads are counted
std::vector<ScalingPlan> scalingPlans(unsigned cores);

/// A ball of that optical depth along its diameter, in edge^3 voxels of index space, under a sun; one event.
std::filesystem::path writeBallScene(int edge, double opticalDepth, const std::filesystem::path& folder);
/// As many shining triangles over a floor, direct light alone. In a mesh file: scene files have a limit to their size.
std::filesystem::path writeLightsScene(std::size_t count, const std::filesystem::path& folder);
/// Bumpy balls of as many triangles in all as `trianglesOf` says, under a shining square.
std::filesystem::path writeTrianglesScene(int rings, const std::filesystem::path& folder);
double trianglesOf(int rings);

} // namespace tyndall::bench
