// SPDX-License-Identifier: Apache-2.0
#include "geometry/bvh.h"

#include "base/error.h"
#include "geometry/bvh_split.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tyndall::geometry {
namespace {

using interop::BvhNode;

constexpr std::uint32_t kWidth = 4;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::uint32_t kindOf(const BvhInput& input) { return input.primitive.id & interop::kPrimitiveKindMask; }

/// Floats around a box of doubles.
Box roundedOutward(const Bounds3& bounds) {
  Box box{glm::vec3(bounds.min), glm::vec3(bounds.max)};
  for (int axis = 0; axis < 3; ++axis) {
    if (double(box.min[axis]) > bounds.min[axis]) {
      box.min[axis] = std::nextafter(box.min[axis], -kInfinity);
    }
    if (double(box.max[axis]) < bounds.max[axis]) {
      box.max[axis] = std::nextafter(box.max[axis], kInfinity);
    }
  }
  return box;
}

Box boxOf(const BvhInput& input) {
  const interop::BvhPrimitive& primitive = input.primitive;
  switch (kindOf(input)) {
  case interop::kPrimitiveTriangle:
    return {glm::min(primitive.v0, glm::min(primitive.v1, primitive.v2)),
            glm::max(primitive.v0, glm::max(primitive.v1, primitive.v2))};
  case interop::kPrimitiveSphere: {
    const glm::dvec3 centre(primitive.v0);
    const double radius = std::abs(double(primitive.v1.x));
    return roundedOutward({centre - radius, centre + radius});
  }
  default:
    TYNDALL_CHECK(!input.bounds.empty());
    return roundedOutward(input.bounds);
  }
}

/// The least float step whose 255th multiple covers `extent`; 0 for 0.
float stepFor(double extent) {
  float step = std::max(static_cast<float>(extent / 255.0), std::numeric_limits<float>::min());
  while (255.0 * double(step) < extent) {
    step = std::nextafter(step, kInfinity);
  }
  return extent > 0.0 ? step : 0.0f;
}

void quantiseChild(BvhNode& node, std::uint32_t child, const Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const double origin(node.origin[axis]);
    const double step(node.scale[axis]);
    double lower = 0.0;
    double upper = 0.0;
    if (step > 0.0) {
      lower = std::clamp(std::floor((double(box.min[axis]) - origin) / step), 0.0, 255.0);
      upper = std::clamp(std::ceil((double(box.max[axis]) - origin) / step), 0.0, 255.0);
      // The quotients are rounded: one step more where that cut into the box.
      lower -= lower > 0.0 && origin + lower * step > double(box.min[axis]) ? 1.0 : 0.0;
      upper += upper < 255.0 && origin + upper * step < double(box.max[axis]) ? 1.0 : 0.0;
    }
    node.lower[axis] |= static_cast<std::uint32_t>(lower) << (8 * child);
    node.upper[axis] |= static_cast<std::uint32_t>(upper) << (8 * child);
  }
}

/// A node whose children are all empty: no ray enters their boxes, and kBvhEmpty says so again for flat ones.
BvhNode emptyNode() {
  BvhNode node{};
  std::fill(std::begin(node.children), std::end(node.children), interop::kBvhEmpty);
  return node;
}

struct Children {
  std::array<std::uint32_t, kWidth> nodes{};
  std::uint32_t count = 0;
};

/// Replaces the binary tree's levels two by two. So the wide tree has at most half as many.
class Collapse {
public:
  Collapse(const std::vector<BinaryNode>& binary, Bvh& bvh) : binary_(binary), bvh_(bvh) {}

  /// @return the node's index.
  std::uint32_t emit(std::uint32_t root, std::uint32_t level) {
    bvh_.depth = std::max(bvh_.depth, level);
    const auto index = static_cast<std::uint32_t>(bvh_.nodes.size());
    bvh_.nodes.push_back(emptyNode());
    const Children children = childrenOf(root);
    const Box& box = binary_[root].box;
    BvhNode node = emptyNode();
    node.origin = box.min;
    for (int axis = 0; axis < 3; ++axis) {
      node.scale[axis] = stepFor(double(box.max[axis]) - double(box.min[axis]));
    }
    for (std::uint32_t i = 0; i < children.count; ++i) {
      const BinaryNode& child = binary_[children.nodes[i]];
      quantiseChild(node, i, child.box);
      node.children[i] = child.second == 0
                             ? interop::kBvhLeaf | (child.count - 1) << interop::kBvhCountShift | child.first
                             : emit(children.nodes[i], level + 1);
    }
    bvh_.nodes[index] = node;
    return index;
  }

private:
  bool inner(std::uint32_t node) const { return binary_[node].second != 0; }

  /// Grandchildren; where a child is a leaf, the largest of the others is opened instead.
  Children childrenOf(std::uint32_t root) const {
    Children children{{root}, 1};
    if (!inner(root)) {
      return children;
    }
    open(children, 0);
    const bool bothInner = inner(children.nodes[0]) && inner(children.nodes[1]);
    if (bothInner) {
      open(children, 0);
      open(children, 1);
      return children;
    }
    while (children.count < kWidth) {
      int largest = -1;
      for (std::uint32_t i = 0; i < children.count; ++i) {
        if (inner(children.nodes[i]) &&
            (largest < 0 || area(children.nodes[i]) > area(children.nodes[std::size_t(largest)]))) {
          largest = static_cast<int>(i);
        }
      }
      if (largest < 0) {
        break;
      }
      open(children, static_cast<std::uint32_t>(largest));
    }
    return children;
  }

  double area(std::uint32_t node) const { return binary_[node].box.area(); }

  void open(Children& children, std::uint32_t slot) const {
    const std::uint32_t node = children.nodes[slot];
    children.nodes[slot] = node + 1;
    children.nodes[children.count++] = binary_[node].second;
  }

  const std::vector<BinaryNode>& binary_;
  Bvh& bvh_;
};

} // namespace

Bounds3 primitiveBounds(const BvhInput& input) {
  const Box box = boxOf(input);
  return {glm::dvec3(box.min), glm::dvec3(box.max)};
}

Bvh buildBvh(std::span<const BvhInput> inputs) {
  const bool instances = std::any_of(inputs.begin(), inputs.end(),
                                     [](const BvhInput& each) { return kindOf(each) == interop::kPrimitiveInstance; });
  const std::uint32_t levels = 2 * (instances ? kBvhInstanceLevels : kBvhLevels);
  const std::uint64_t most =
      std::min<std::uint64_t>(std::uint64_t(interop::kBvhLargestLeaf) << levels, interop::kBvhFirstMask);
  if (inputs.size() > most) {
    fail("{} {} are more than one tree holds, {}; {}", inputs.size(), instances ? "instances and surfaces" : "surfaces",
         most, instances ? "merge objects into meshes" : "use simpler meshes, or instances of one mesh");
  }
  std::vector<BvhReference> references(inputs.size());
  tbb::parallel_for(std::size_t{0}, inputs.size(), [&](std::size_t i) {
    references[i] = {boxOf(inputs[i]), static_cast<std::uint32_t>(i)};
  });
  Bvh bvh;
  if (inputs.empty()) {
    bvh.nodes.push_back(emptyNode());
    bvh.depth = 1;
    return bvh;
  }
  const std::vector<BinaryNode> binary = splitReferences(references, levels);
  Collapse(binary, bvh).emit(0, 1);
  bvh.bounds = {glm::dvec3(binary[0].box.min), glm::dvec3(binary[0].box.max)};
  bvh.primitives.reserve(references.size());
  for (const BvhReference& reference : references) {
    bvh.primitives.push_back(inputs[reference.input].primitive);
  }
  return bvh;
}

std::uint32_t appendBvh(Bvh& all, const Bvh& part) {
  const std::uint64_t root = all.nodes.size();
  const std::uint64_t first = all.primitives.size();
  if (root + part.nodes.size() > interop::kBvhLeaf || first + part.primitives.size() > interop::kBvhFirstMask) {
    fail("all meshes together have more than {} surfaces; use simpler meshes", interop::kBvhFirstMask);
  }
  for (BvhNode node : part.nodes) {
    for (std::uint32_t& child : node.children) {
      if (child != interop::kBvhEmpty) {
        child += static_cast<std::uint32_t>((child & interop::kBvhLeaf) != 0 ? first : root);
      }
    }
    all.nodes.push_back(node);
  }
  all.primitives.insert(all.primitives.end(), part.primitives.begin(), part.primitives.end());
  return static_cast<std::uint32_t>(root);
}

} // namespace tyndall::geometry
