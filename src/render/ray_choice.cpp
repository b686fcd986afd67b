// SPDX-License-Identifier: Apache-2.0
#include "render/ray_choice.h"

#include "base/error.h"
#include "gpu_scene/ray_query.h"

#include <algorithm>
#include <limits>

namespace tyndall::render {
namespace {

constexpr int kRounds = 5; ///< the fastest of each counts: what disturbs a round only makes it longer

} // namespace

RayChoice fasterRays(const RayTimer& time) {
  time(false); // the first dispatch compiles
  time(true);
  double tree = std::numeric_limits<double>::infinity();
  double query = tree;
  for (int round = 0; round < kRounds; ++round) {
    tree = std::min(tree, time(false));
    query = std::min(query, time(true));
  }
  return query < tree ? RayChoice{true, fmt::format("ray query (own tree takes {:.2f} times as long)", tree / query)}
                      : RayChoice{false, fmt::format("own tree (ray query takes {:.2f} times as long)", query / tree)};
}

RayChoice chooseRays(RayCaster wanted, const gpu::Device& device, const gpu_scene::GpuScene& scene,
                     const RayTimer& time) {
  if (!scene.features().surfaces) {
    return {false, "none (no surfaces)"};
  }
  if (wanted == RayCaster::Tree) {
    return {false, "own tree (asked for)"};
  }
  const std::optional<std::string> obstacle = gpu_scene::rayQueryObstacle(device, scene.surfaces());
  if (wanted == RayCaster::Query) {
    if (obstacle) {
      fail("--rays query: {}; leave --rays away, or give --rays tree", *obstacle);
    }
    return {true, "ray query (asked for)"};
  }
  if (obstacle) {
    return {false, fmt::format("own tree ({})", *obstacle)};
  }
  if (device.info().type == "cpu") {
    return {false, "own tree (a CPU's ray queries are slower)"};
  }
  try {
    return fasterRays(time);
  } catch (const Error& error) { // of memory: our tree needs no more
    return {false, fmt::format("own tree (ray queries failed: {})", error.what())};
  }
}

} // namespace tyndall::render
