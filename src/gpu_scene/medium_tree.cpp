// SPDX-License-Identifier: Apache-2.0
#include "gpu_scene/medium_tree.h"

#include <algorithm>
#include <span>

namespace tyndall::gpu_scene {
namespace {

/// Of the largest coordinate: some 100 roundings of a float.
constexpr double kSlack = 1e-5;

struct Leaf {
  Bounds3 box;
  std::uint32_t medium = 0;
};

Bounds3 worldBox(const interop::Grid& grid) {
  const glm::dmat4 worldFromVoxel = glm::inverse(glm::dmat4(glm::dmat4x3(grid.voxelFromWorld)));
  Bounds3 box = transformed(worldFromVoxel, {glm::dvec3(grid.boundsMin), glm::dvec3(grid.boundsMax)});
  const glm::dvec3 farthest = glm::max(glm::abs(box.min), glm::abs(box.max));
  const double slack = kSlack * std::max({farthest.x, farthest.y, farthest.z});
  box.min -= slack;
  box.max += slack;
  return box;
}

void build(std::span<Leaf> leaves, std::vector<interop::MediumNode>& nodes) {
  Bounds3 bounds;
  for (const Leaf& leaf : leaves) {
    bounds.extend(leaf.box);
  }
  const std::size_t index = nodes.size();
  nodes.push_back({glm::vec3(bounds.min), 0, glm::vec3(bounds.max), interop::kNoMedium});
  if (leaves.size() == 1) {
    nodes[index].medium = leaves.front().medium;
  } else {
    const glm::dvec3 size = bounds.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t half = leaves.size() / 2;
    std::nth_element(leaves.begin(), leaves.begin() + std::ptrdiff_t(half), leaves.end(),
                     [axis](const Leaf& a, const Leaf& b) { return a.box.centre()[axis] < b.box.centre()[axis]; });
    build(leaves.subspan(0, half), nodes);
    build(leaves.subspan(half), nodes);
  }
  nodes[index].skip = static_cast<std::uint32_t>(nodes.size());
}

} // namespace

std::vector<interop::MediumNode> mediumTree(const PackedMedia& media) {
  std::vector<Leaf> leaves;
  for (std::size_t i = media.homogeneousCount; i < media.media.size(); ++i) {
    if (media.media[i].densityGrid != interop::kNoGrid) {
      leaves.push_back({worldBox(media.placements[media.media[i].densityGrid].header), static_cast<std::uint32_t>(i)});
    }
  }
  std::vector<interop::MediumNode> nodes;
  if (!leaves.empty()) {
    build(leaves, nodes);
  }
  return nodes;
}

} // namespace tyndall::gpu_scene
