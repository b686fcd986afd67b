// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "interop/surfaces.h"
#include "math/bounds.h"

#include <cstdint>
#include <span>
#include <vector>

namespace tyndall::geometry {

/// Wide levels that a tree has at most: of the world where it holds instances, and of every other tree. A traversal
/// keeps 3 entries for a level, and 2 to come back from an instance.
inline constexpr std::uint32_t kBvhInstanceLevels = 8;
inline constexpr std::uint32_t kBvhLevels = 12;
static_assert(3 * (kBvhInstanceLevels + kBvhLevels) + 2 <= interop::kBvhStack);

struct BvhInput {
  interop::BvhPrimitive primitive; ///< finite
  Bounds3 bounds;                  ///< of an instance, in world space; triangles and spheres have their own
};

/// A quantised tree of four children a node; node 0 is the root of what was built first.
struct Bvh {
  std::vector<interop::BvhNode> nodes;
  std::vector<interop::BvhPrimitive> primitives; ///< in the order of the leaves
  Bounds3 bounds;                                ///< of the world; empty without primitives
  std::uint32_t depth = 0;                       ///< levels of nodes
};

/// The box that a tree keeps of a primitive: floats, rounded outward.
Bounds3 primitiveBounds(const BvhInput& input);

/// Builds by the surface area heuristic in bins [Wald07], in parallel; the same input gives the same tree. Boxes of
/// children hold their primitives' boxes whole. Without input: a root with four empty children.
/// @throws Error for more primitives than a tree, or than a tree with instances, can hold.
Bvh buildBvh(std::span<const BvhInput> inputs);

/// Adds the tree of a mesh that is instanced to the world's. @return its root's index.
/// @throws Error where node or primitive indices run out.
std::uint32_t appendBvh(Bvh& all, const Bvh& part);

} // namespace tyndall::geometry
