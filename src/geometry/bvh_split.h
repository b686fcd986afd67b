// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

/// The binary tree from which the wide one is collapsed.
namespace tyndall::geometry {

struct Box {
  glm::vec3 min{std::numeric_limits<float>::infinity()};
  glm::vec3 max{-std::numeric_limits<float>::infinity()};

  void extend(const Box& other) {
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
  }
  /// Half the surface; 0 where empty. In double: coordinates squared may leave the floats.
  double area() const;
};

struct BvhReference {
  Box box;
  std::uint32_t input = 0;
};

struct BinaryNode {
  Box box;
  std::uint32_t first = 0; ///< of its references
  std::uint32_t count = 0;
  std::uint32_t second = 0; ///< index of the second child, the first one follows its parent; 0: a leaf
};

/// Nodes of the binary tree over `references`, which end up in the order of the leaves; not all are used.
/// Deterministic.
/// @param levels of splits at most; needs references.size() <= kBvhLargestLeaf * 2^levels.
std::vector<BinaryNode> splitReferences(std::span<BvhReference> references, std::uint32_t levels);

} // namespace tyndall::geometry
