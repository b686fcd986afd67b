// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "geometry/bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <string>

namespace tyndall::geometry {
namespace {

using Inputs = std::vector<BvhInput>;

Inputs randomTriangles(std::size_t count, float size, const glm::vec3& shift) {
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  Inputs inputs;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 centre = shift + glm::vec3(normal(random), normal(random), normal(random));
    BvhInput input{};
    for (glm::vec3* vertex : {&input.primitive.v0, &input.primitive.v1, &input.primitive.v2}) {
      *vertex = centre + size * glm::vec3(normal(random), normal(random), normal(random));
    }
    input.primitive.id = static_cast<std::uint32_t>(i);
    inputs.push_back(input);
  }
  return inputs;
}

/// What a walk over the whole tree found wrong.
struct Findings {
  std::vector<std::uint32_t> seen; ///< per primitive: leaves that hold it
  std::size_t outside = 0;         ///< primitives that stick out of a box above them
  std::uint32_t depth = 0;
};

Bounds3 childBox(const interop::BvhNode& node, std::uint32_t child) {
  Bounds3 box;
  for (int axis = 0; axis < 3; ++axis) {
    const double origin(node.origin[axis]);
    const double scale(node.scale[axis]);
    box.min[axis] = origin + scale * double((node.lower[axis] >> (8 * child)) & 255u);
    box.max[axis] = origin + scale * double((node.upper[axis] >> (8 * child)) & 255u);
  }
  return box;
}

bool holds(const Bounds3& outer, const Bounds3& inner) {
  return glm::all(glm::lessThanEqual(outer.min, inner.min)) && glm::all(glm::greaterThanEqual(outer.max, inner.max));
}

void walk(const Bvh& bvh, const Inputs& inputs, std::uint32_t index, std::vector<Bounds3>& above, Findings& findings) {
  findings.depth = std::max(findings.depth, static_cast<std::uint32_t>(above.size()) + 1);
  const interop::BvhNode& node = bvh.nodes.at(index);
  for (std::uint32_t child = 0; child < 4; ++child) {
    const std::uint32_t entry = node.children[child];
    if (entry == interop::kBvhEmpty) {
      continue;
    }
    above.push_back(childBox(node, child));
    if ((entry & interop::kBvhLeaf) == 0) {
      walk(bvh, inputs, entry, above, findings);
    } else {
      const std::uint32_t first = entry & interop::kBvhFirstMask;
      const std::uint32_t last = first + ((entry >> interop::kBvhCountShift) & (interop::kBvhLargestLeaf - 1));
      for (std::uint32_t i = first; i <= last; ++i) {
        ++findings.seen.at(i);
        const std::uint32_t id = bvh.primitives.at(i).id & interop::kPrimitiveIndexMask;
        for (const Bounds3& box : above) {
          findings.outside += holds(box, primitiveBounds(inputs.at(id))) ? 0 : 1;
        }
      }
    }
    above.pop_back();
  }
}

Findings inspect(const Bvh& bvh, const Inputs& inputs) {
  Findings findings;
  findings.seen.resize(bvh.primitives.size());
  std::vector<Bounds3> above;
  walk(bvh, inputs, 0, above, findings);
  return findings;
}

void expectSound(const Inputs& inputs) {
  const Bvh bvh = buildBvh(inputs);
  ASSERT_EQ(bvh.primitives.size(), inputs.size());
  const Findings findings = inspect(bvh, inputs);
  EXPECT_EQ(findings.outside, 0u);
  EXPECT_EQ(findings.depth, bvh.depth);
  EXPECT_LE(bvh.depth, kBvhLevels);
  EXPECT_EQ(std::count(findings.seen.begin(), findings.seen.end(), 1u), std::ptrdiff_t(inputs.size()));
  for (const BvhInput& input : inputs) {
    ASSERT_TRUE(holds(bvh.bounds, primitiveBounds(input)));
  }
}

TEST(Bvh, BoxesHoldTheirPrimitives) {
  expectSound(randomTriangles(20000, 0.05f, glm::vec3(0.0f)));
  expectSound(randomTriangles(20000, 1e-6f, {1e5f, 3.0f, -1e-3f}));
  expectSound(randomTriangles(3, 1.0f, glm::vec3(0.0f)));
  expectSound(randomTriangles(1, 1e-30f, glm::vec3(0.0f)));
}

TEST(Bvh, FlatAndCoincidentPrimitivesAreKept) {
  Inputs flat = randomTriangles(5000, 0.1f, glm::vec3(0.0f));
  for (BvhInput& input : flat) {
    input.primitive.v0.y = input.primitive.v1.y = input.primitive.v2.y = 0.1f;
  }
  expectSound(flat);
  Inputs same(100000, flat.front());
  for (std::size_t i = 0; i < same.size(); ++i) {
    same[i].primitive.id = static_cast<std::uint32_t>(i);
  }
  expectSound(same);
}

TEST(Bvh, SpheresAndInstancesHaveTheirBoxes) {
  Inputs inputs = randomTriangles(100, 0.1f, glm::vec3(0.0f));
  for (std::uint32_t i = 100; i < 200; ++i) {
    BvhInput input = inputs[i - 100];
    if (i % 2 == 0) {
      input.primitive.id = interop::kPrimitiveSphere | i;
      input.primitive.v1 = glm::vec3(0.1f, 0.0f, 0.0f);
      EXPECT_TRUE(holds(primitiveBounds(input), {glm::dvec3(input.primitive.v0) - double(0.1f),
                                                 glm::dvec3(input.primitive.v0) + double(0.1f)}));
    } else {
      input.primitive.id = interop::kPrimitiveInstance | i;
      input.bounds = {glm::dvec3(-0.1), glm::dvec3(1.0 / 3.0)};
      EXPECT_TRUE(holds(primitiveBounds(input), input.bounds));
    }
    inputs.push_back(input);
  }
  expectSound(inputs);
  EXPECT_LE(buildBvh(inputs).depth, kBvhInstanceLevels);
}

TEST(Bvh, TheSameInputGivesTheSameTree) {
  const Inputs inputs = randomTriangles(50000, 0.05f, glm::vec3(0.0f));
  const Bvh one = buildBvh(inputs);
  const Bvh other = buildBvh(inputs);
  ASSERT_EQ(one.nodes.size(), other.nodes.size());
  EXPECT_EQ(std::memcmp(one.nodes.data(), other.nodes.data(), one.nodes.size() * sizeof(interop::BvhNode)), 0);
  EXPECT_EQ(std::memcmp(one.primitives.data(), other.primitives.data(),
                        one.primitives.size() * sizeof(interop::BvhPrimitive)),
            0);
}

TEST(Bvh, AppendedTreesKeepTheirPrimitives) {
  const Inputs first = randomTriangles(500, 0.1f, glm::vec3(0.0f));
  const Inputs second = randomTriangles(300, 0.1f, glm::vec3(5.0f));
  Bvh all = buildBvh(first);
  const std::size_t nodes = all.nodes.size();
  EXPECT_EQ(appendBvh(all, buildBvh(second)), nodes);
  EXPECT_EQ(all.primitives.size(), 800u);
  Findings findings;
  findings.seen.resize(800);
  std::vector<Bounds3> above;
  walk(all, second, static_cast<std::uint32_t>(nodes), above, findings);
  EXPECT_EQ(findings.outside, 0u);
  for (std::size_t i = 0; i < 800; ++i) {
    EXPECT_EQ(findings.seen[i], i < 500 ? 0u : 1u);
  }
}

TEST(Bvh, NothingGivesAnEmptyRoot) {
  const Bvh bvh = buildBvh({});
  ASSERT_EQ(bvh.nodes.size(), 1u);
  for (const std::uint32_t child : bvh.nodes[0].children) {
    EXPECT_EQ(child, interop::kBvhEmpty);
  }
  EXPECT_TRUE(bvh.bounds.empty());
}

TEST(Bvh, TooManyInstancesAreRefused) {
  BvhInput instance{};
  instance.primitive.id = interop::kPrimitiveInstance;
  instance.bounds = {glm::dvec3(0.0), glm::dvec3(1.0)};
  const Inputs inputs(interop::kBvhLargestLeaf * (1u << (2 * kBvhInstanceLevels)) + 1, instance);
  EXPECT_THROW(buildBvh(inputs), Error);
}

/// A box a step too small on one side, in one node of many.
TEST(Bvh, APlantedStepIsSeen) {
  const Inputs inputs = randomTriangles(1000, 0.05f, glm::vec3(0.0f));
  Bvh bvh = buildBvh(inputs);
  bvh.nodes[bvh.nodes.size() / 2].lower[1] += 1;
  EXPECT_GT(inspect(bvh, inputs).outside, 0u);
}

} // namespace
} // namespace tyndall::geometry
