// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "light/light_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>

namespace tyndall::light {
namespace {

constexpr double kPi = std::numbers::pi;

interop::Emitter emitterOf(std::uint32_t kind, const glm::vec3& position, const glm::vec3& edge1,
                           const glm::vec3& edge2, std::uint32_t flags = 0) {
  interop::Emitter emitter{};
  emitter.kind = kind;
  emitter.flags = flags;
  emitter.position = position;
  emitter.edge1 = edge1;
  emitter.edge2 = edge2;
  emitter.radiance = glm::vec3(1.0f);
  return emitter;
}

std::vector<interop::Emitter> mixed(std::size_t count) {
  std::mt19937 engine(11);
  std::normal_distribution<float> normal;
  std::exponential_distribution<float> exponential;
  const auto vector = [&] { return glm::vec3(normal(engine), normal(engine), normal(engine)); };
  std::vector<interop::Emitter> emitters;
  for (std::size_t i = 0; i < count; ++i) {
    const auto kind = static_cast<std::uint32_t>(i % 4);
    glm::vec3 edge1 = 0.1f * vector();
    glm::vec3 edge2 = 0.1f * vector();
    if (kind == interop::kEmitterSpot) {
      edge1 = glm::normalize(edge1);
      edge2 = glm::vec3(0.2f, 0.1f, 0.0f);
    } else if (kind == interop::kEmitterSphere) {
      edge1 = glm::vec3(0.05f);
    }
    emitters.push_back(emitterOf(kind, 10.0f * vector(), edge1, edge2, i % 8 == 2 ? interop::kEmitterTwoSided : 0u));
    emitters.back().radiance = glm::vec3(std::pow(exponential(engine), 3.0f) + 1e-6f);
  }
  return emitters;
}

std::vector<LightBounds> boundsOf(const std::vector<interop::Emitter>& emitters) {
  std::vector<LightBounds> bounds;
  for (const interop::Emitter& emitter : emitters) {
    bounds.push_back(lightBounds(emitter));
  }
  return bounds;
}

/// What is wrong with a tree; empty when nothing is.
class Inspection {
public:
  Inspection(const LightTree& tree, const std::vector<interop::Emitter>& emitters,
             const std::vector<LightBounds>& bounds)
      : tree_(tree), emitters_(emitters), bounds_(bounds), seen_(emitters.size(), 0) {
    visited_ = visit(0, 0, 0);
    expect(visited_ == tree.nodes.size() && tree.nodes.size() == 2 * emitters.size() - 1, "nodes are missing or loose");
    expect(tree.depth == deepest_ && deepest_ <= interop::kLightTreeDepth, "wrong depth");
    for (const int times : seen_) {
      expect(times == 1, "an emitter does not have one leaf");
    }
  }
  const std::string& complaint() const { return complaint_; }

private:
  void expect(bool condition, const char* complaint) {
    if (!condition) {
      complaint_ = complaint;
    }
  }

  /// Returns the number of nodes in the subtree.
  std::size_t visit(std::size_t index, std::uint32_t depth, std::uint32_t trail) {
    const interop::LightTreeNode& node = tree_.nodes.at(index);
    deepest_ = std::max(deepest_, depth);
    if ((node.child & interop::kLightTreeLeaf) != 0) {
      const std::uint32_t emitter = node.child & ~interop::kLightTreeLeaf;
      ++seen_.at(emitter);
      expect(emitters_[emitter].trail == trail, "a trail leads elsewhere");
      const LightBounds& own = bounds_[emitter];
      for (const std::size_t each : path_) {
        holds(tree_.nodes[each], own);
      }
      holds(node, own);
      near(own.power, node);
      return 1;
    }
    path_.push_back(index);
    const std::size_t first = visit(index + 1, depth + 1, trail);
    expect(node.child == index + 1 + first, "not depth first");
    const std::size_t second = visit(node.child, depth + 1, trail | 1u << depth);
    path_.pop_back();
    near(double(tree_.nodes[index + 1].power) + double(tree_.nodes[node.child].power), node);
    return 1 + first + second;
  }

  void near(double power, const interop::LightTreeNode& node) {
    expect(std::abs(power - static_cast<double>(node.power)) < 1e-5 * power, "wrong power");
  }

  void holds(const interop::LightTreeNode& node, const LightBounds& bounds) {
    expect(glm::all(glm::lessThanEqual(glm::dvec3(node.boundsMin), bounds.box.min)) &&
               glm::all(glm::greaterThanEqual(glm::dvec3(node.boundsMax), bounds.box.max)),
           "a box sticks out");
    const glm::dvec3 own(node.axis);
    const double between = std::atan2(glm::length(glm::cross(own, bounds.axis)), glm::dot(own, bounds.axis));
    const double reach = std::min(kPi, between + std::acos(bounds.cosNormals));
    expect(std::cos(reach) >= static_cast<double>(node.cosNormals), "a cone of normals sticks out");
    expect(bounds.cosEmission >= static_cast<double>(node.cosEmission), "a cone of emission sticks out");
  }

  const LightTree& tree_;
  const std::vector<interop::Emitter>& emitters_;
  const std::vector<LightBounds>& bounds_;
  std::vector<int> seen_;
  std::vector<std::size_t> path_; ///< nodes above the one that is visited
  std::size_t visited_ = 0;
  std::uint32_t deepest_ = 0;
  std::string complaint_;
};

std::string complaintAbout(std::vector<interop::Emitter> emitters, const std::vector<LightBounds>& bounds) {
  const LightTree tree = buildLightTree(emitters, bounds);
  return Inspection(tree, emitters, bounds).complaint();
}

TEST(LightTree, HoldsAllEmittersInItsBounds) {
  for (const std::size_t count : {1u, 2u, 3u, 13u, 1000u, 20000u}) {
    const std::vector<interop::Emitter> emitters = mixed(count);
    EXPECT_EQ(complaintAbout(emitters, boundsOf(emitters)), "") << count;
  }
}

TEST(LightTree, IsNeverDeeperThanATrail) {
  std::vector<interop::Emitter> line; // each half as far away and a tenth as strong: splits want to peel one off
  for (int i = 0; i < 120; ++i) {
    line.push_back(emitterOf(interop::kEmitterPoint, glm::vec3(std::ldexp(1.0f, 15 - i), 0.0f, 0.0f), {}, {}));
    line.back().radiance = glm::vec3(std::pow(10.0f, 12.0f - 0.2f * static_cast<float>(i)));
  }
  EXPECT_EQ(complaintAbout(line, boundsOf(line)), "");
  const std::vector<interop::Emitter> heap(5000, line[0]); // all in one place: halved by their order
  EXPECT_EQ(complaintAbout(heap, boundsOf(heap)), "");
  std::vector<interop::Emitter> emitters = heap;
  EXPECT_EQ(buildLightTree(emitters, boundsOf(heap)).depth, 13u);
  EXPECT_GT(buildLightTree(line, boundsOf(line)).depth, 20u); // deep enough for the bound to matter
}

TEST(LightTree, InspectionSeesPlantedBugs) {
  const std::vector<interop::Emitter> emitters = mixed(500);
  const std::vector<LightBounds> bounds = boundsOf(emitters);
  std::vector<interop::Emitter> trailed = emitters;
  const LightTree sound = buildLightTree(trailed, bounds);
  ASSERT_EQ(Inspection(sound, trailed, bounds).complaint(), "");
  const auto spoilt = [&](const std::function<void(interop::LightTreeNode&)>& spoil) {
    LightTree tree = sound;
    spoil(tree.nodes[1]);
    return Inspection(tree, trailed, bounds).complaint();
  };
  EXPECT_NE(spoilt([](auto& node) { node.boundsMax.x -= 1e-4f; }), "");
  EXPECT_NE(spoilt([](auto& node) { node.cosNormals += 1e-4f; }), "");
  EXPECT_NE(spoilt([](auto& node) { node.cosEmission += 1e-4f; }), "");
  EXPECT_NE(spoilt([](auto& node) { node.power *= 1.001f; }), "");
  EXPECT_NE(spoilt([](auto& node) { node.child = interop::kLightTreeLeaf; }), "");
  trailed[77].trail ^= 2u;
  EXPECT_NE(Inspection(sound, trailed, bounds).complaint(), "");
}

TEST(LightTree, IsTheSameEachTime) {
  std::vector<interop::Emitter> emitters = mixed(3000);
  const std::vector<LightBounds> bounds = boundsOf(emitters);
  const LightTree first = buildLightTree(emitters, bounds);
  const LightTree second = buildLightTree(emitters, bounds);
  ASSERT_EQ(first.nodes.size(), second.nodes.size());
  EXPECT_EQ(std::memcmp(first.nodes.data(), second.nodes.data(), first.nodes.size() * sizeof(interop::LightTreeNode)),
            0);
}

TEST(LightTree, SeparatesWhatLiesApartAndWhatFacesApart) {
  // Two groups of triangles, far apart: no child of the root may hold some of each.
  std::vector<interop::Emitter> emitters;
  for (int i = 0; i < 40; ++i) {
    const float x = (i % 2 == 0 ? -100.0f : 100.0f) + static_cast<float>(i % 7);
    emitters.push_back(emitterOf(interop::kEmitterTriangle, {x, static_cast<float>(i % 3), 0.0f}, {1.0f, 0.0f, 0.0f},
                                 {0.0f, 1.0f, 0.0f}));
  }
  buildLightTree(emitters, boundsOf(emitters));
  for (std::size_t i = 0; i < emitters.size(); ++i) {
    EXPECT_EQ(emitters[i].trail & 1u, i % 2) << i;
  }
  // Two walls back to back, a little apart beside their size: the orientation decides against the longer axes.
  emitters.clear();
  for (int i = 0; i < 200; ++i) {
    const bool back = i % 2 == 1;
    const glm::vec3 corner(static_cast<float>(i / 2 % 10), static_cast<float>(i / 20), back ? -4.0f : 0.0f);
    emitters.push_back(
        emitterOf(interop::kEmitterTriangle, corner, {back ? -1.0f : 1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}));
  }
  buildLightTree(emitters, boundsOf(emitters));
  for (std::size_t i = 0; i < emitters.size(); ++i) {
    EXPECT_EQ(emitters[i].trail & 1u, emitters[1].trail & 1u ? i % 2 : 1 - i % 2) << i;
  }
}

TEST(LightBounds, AreThoseOfTheEmitters) {
  const glm::vec3 at(1.0f, 2.0f, 3.0f);
  const LightBounds point = lightBounds(emitterOf(interop::kEmitterPoint, at, {}, {}));
  EXPECT_DOUBLE_EQ(point.power, 4.0 * kPi);
  EXPECT_EQ(point.cosNormals, -1.0);
  EXPECT_EQ(point.box.min, point.box.max);
  const LightBounds spot =
      lightBounds(emitterOf(interop::kEmitterSpot, at, {0.0f, -1.0f, 0.0f}, {0.25f, 0.125f, 0.0f}));
  EXPECT_DOUBLE_EQ(spot.power, 4.0 * kPi);
  EXPECT_DOUBLE_EQ(spot.cosEmission, 0.75);
  EXPECT_EQ(spot.axis, glm::dvec3(0.0, -1.0, 0.0));
  const LightBounds triangle =
      lightBounds(emitterOf(interop::kEmitterTriangle, at, {2.0f, 0.0f, 0.0f}, {0.0f, 3.0f, 0.0f}));
  EXPECT_DOUBLE_EQ(triangle.power, 4.0 * kPi * 3.0);
  EXPECT_EQ(triangle.axis, glm::dvec3(0.0, 0.0, 1.0));
  EXPECT_EQ(triangle.cosNormals, 1.0);
  EXPECT_EQ(triangle.cosEmission, 0.0);
  EXPECT_EQ(triangle.box.max, glm::dvec3(3.0, 5.0, 3.0));
  const auto twoSided =
      emitterOf(interop::kEmitterTriangle, at, {2.0f, 0.0f, 0.0f}, {0.0f, 3.0f, 0.0f}, interop::kEmitterTwoSided);
  EXPECT_EQ(lightBounds(twoSided).cosNormals, -1.0);
  const LightBounds sphere = lightBounds(emitterOf(interop::kEmitterSphere, at, {2.0f, 0.0f, 0.0f}, {}));
  EXPECT_DOUBLE_EQ(sphere.power, 4.0 * kPi * kPi * 4.0);
  EXPECT_EQ(sphere.box.min, glm::dvec3(-1.0, 0.0, 1.0));
  const LightBounds volume = lightBounds(emitterOf(interop::kEmitterVolume, at, {2.0f, 3.0f, 4.0f}, {}));
  EXPECT_DOUBLE_EQ(volume.power, 4.0 * kPi * 24.0);
  EXPECT_EQ(volume.box.max, glm::dvec3(3.0, 5.0, 7.0));
}

TEST(LightBounds, RefuseWhatGivesNoLight) {
  interop::Emitter dark = emitterOf(interop::kEmitterPoint, {}, {}, {});
  dark.radiance = glm::vec3(0.0f);
  EXPECT_THROW(lightBounds(dark), Error);
  EXPECT_THROW(lightBounds(emitterOf(interop::kEmitterTriangle, {}, {1.0f, 0.0f, 0.0f}, {2.0f, 0.0f, 0.0f})), Error);
  EXPECT_THROW(lightBounds(emitterOf(interop::kEmitterSphere, {}, {}, {})), Error);
  EXPECT_THROW(lightBounds(emitterOf(interop::kEmitterSpot, {}, {1.0f, 0.0f, 0.0f}, {})), Error);
  EXPECT_THROW(lightBounds(emitterOf(interop::kEmitterVolume, {}, {1.0f, 0.0f, 1.0f}, {})), Error);
  std::vector<interop::Emitter> emitters = mixed(3);
  for (const double power :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    std::vector<LightBounds> bounds = boundsOf(emitters);
    bounds[1].power = power;
    try {
      buildLightTree(emitters, bounds);
      ADD_FAILURE() << "took power " << power;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("light 1"));
    }
  }
  std::vector<interop::Emitter> none;
  EXPECT_TRUE(buildLightTree(none, {}).nodes.empty());
}

} // namespace
} // namespace tyndall::light
