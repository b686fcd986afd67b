// SPDX-License-Identifier: Apache-2.0
// Layers that show what has been learnt, of a corridor with one lamp, where what they must be is known.
#include "app/program.h"
#include "film/exr.h"
#include "support/fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace tyndall::test {
namespace {

using testing::HasSubstr;
using Channels = std::map<std::string, std::vector<float>>;

constexpr int kSize = 32;
constexpr double kLampHeight = 0.9;
constexpr double kLampHalf = 0.5;
constexpr double kLampZ = -4.0;
constexpr double kUnit = 0.01;
constexpr double kAngle = 0.1;

/// The camera looks along the corridor; light that has been scattered once comes from the lamp alone.
const std::string kCorridor = R"({"camera": {"position": [0, 0, 0], "target": [0, 0, -1], "vertical_fov": 60},
"film": {"size": [32, 32]}, "render": {"samples": 32, "depth": 1, "integrator": "mcpg", "light_sampling": false},
"guide": {"unit": 0.01, "fit_samples": 1, "watch": false, "cells": {"angle": 0.1}},
"materials": [{"name": "white", "type": "diffuse", "colour": 0.7},
  {"name": "lamp", "type": "diffuse", "colour": 0, "emission": 5}],
"objects": [{"name": "walls", "type": "box", "min": [-1, -1, -8], "max": [1, 1, 0.5], "material": "white"},
  {"name": "lamp", "type": "quad", "origin": [-0.5, 0.9, -4.5], "edge_u": [1, 0, 0], "edge_v": [0, 0, 1],
   "material": "lamp"}],
"animation": {"tracks": [{"target": "camera.position", "keys": [[1, [0, 0, 0]], [2, [0, 0, -0.1]]]}]}})";

const std::vector<std::string> kLayers{"cell.R",      "cell.G", "cell.B", "cosine", "direction.X", "direction.Y",
                                       "direction.Z", "level",  "N",      "share",  "states",      "weight"};

struct Floor {
  std::size_t pixel;
  glm::dvec3 point;
};

/// Where the centres of pixels see the floor.
std::vector<Floor> floorPoints() {
  std::vector<Floor> points;
  const double slope = std::tan(M_PI / 6.0);
  for (int y = kSize / 2; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const glm::dvec3 ray(slope * (2.0 * (x + 0.5) / kSize - 1.0), slope * (1.0 - 2.0 * (y + 0.5) / kSize), -1.0);
      const glm::dvec3 point = ray * (-1.0 / ray.y);
      if (std::abs(point.x) < 1.0 && point.z > -8.0) {
        points.push_back({std::size_t(y * kSize + x), point});
      }
    }
  }
  return points;
}

class GuideViews : public testing::Test {
protected:
  Outcome render(const std::string& options) const {
    writeFile(folder_ / "corridor.json", kCorridor);
    return runProgram(wordsOf("render corridor.json --quiet " + options, ""), folder_.path());
  }
  Channels picture(const std::string& name) const { return film::readExr(folder_ / name).channels; }

  TemporaryFolder folder_;
};

glm::dvec3 directionAt(const Channels& channels, std::size_t pixel, const std::string& order = "XYZ") {
  const auto component = [&](int i) {
    return double(channels.at(std::string("guide.direction.") + order[std::size_t(i)])[pixel]);
  };
  return {component(0), component(1), component(2)};
}

/// Of the floor's pixels that hold states, the share whose direction meets the lamp. A state's target is a mean of
/// points of the lamp, hence on it.
double shareAtLamp(const Channels& channels, const std::string& order = "XYZ") {
  constexpr double kRounding = 1e-3;
  int held = 0;
  int met = 0;
  for (const Floor& floor : floorPoints()) {
    if (channels.at("guide.states")[floor.pixel] > 0.0f) {
      const glm::dvec3 direction = directionAt(channels, floor.pixel, order);
      const glm::dvec3 place = floor.point + direction * ((kLampHeight + 1.0) / direction.y);
      ++held;
      met += std::abs(place.x) <= kLampHalf + kRounding && std::abs(place.z - kLampZ) <= kLampHalf + kRounding ? 1 : 0;
    }
  }
  EXPECT_GT(held, 200) << "of " << floorPoints().size();
  return double(met) / std::max(held, 1);
}

/// The most that levels differ from those that the distance stands for, by rounding alone 1/2.
double levelError(const Channels& channels, double angle) {
  double worst = 0.0;
  std::set<float> levels;
  for (const Floor& floor : floorPoints()) {
    const float level = channels.at("guide.level")[floor.pixel];
    if (channels.at("guide.cell.R")[floor.pixel] > 0.0f && level >= 0.0f) {
      const double wanted = std::log2(std::max(angle * glm::length(floor.point) / kUnit, 1.0));
      worst = std::max(worst, std::abs(double(level) - wanted));
      levels.insert(level);
    }
  }
  EXPECT_GE(levels.size(), 3u);
  return worst;
}

void expectSound(const Channels& channels) {
  for (const std::string& layer : kLayers) {
    const auto found = channels.find("guide." + layer);
    ASSERT_NE(found, channels.end()) << layer;
    EXPECT_TRUE(std::ranges::all_of(found->second, [](float value) { return std::isfinite(value); })) << layer;
  }
  for (std::size_t i = 0; i < std::size_t(kSize) * kSize; ++i) {
    const auto value = [&](const char* name) { return channels.at(std::string("guide.") + name)[i]; };
    const double length = glm::length(directionAt(channels, i));
    ASSERT_NEAR(length, value("states") > 0.0f ? 1.0 : 0.0, 1e-5) << i;
    ASSERT_EQ(value("weight") > 0.0f, value("states") > 0.0f) << i;
    ASSERT_EQ(value("share") > 0.0f, value("cell.G") > 0.0f) << i;
    ASSERT_TRUE(value("cosine") >= 0.0f && value("cosine") < 1.0f && value("share") <= 1.0f) << i;
  }
}

/// Directions meet the lamp, and levels are those of the distance; the same checks refuse components that are swapped,
/// and cells of half the angle.
TEST_F(GuideViews, ShowWhatHasBeenLearnt) {
  ASSERT_EQ(render("--guide-views -o a.exr").exitCode, 0);
  const Channels channels = picture("a.exr");
  expectSound(channels);
  EXPECT_EQ(shareAtLamp(channels), 1.0);
  EXPECT_LT(shareAtLamp(channels, "ZYX"), 0.5) << "the planted swap was not seen";
  EXPECT_LT(levelError(channels, kAngle), 0.501);
  EXPECT_GT(levelError(channels, 0.5 * kAngle), 0.501) << "the planted angle was not seen";
}

TEST_F(GuideViews, OfChainsInScreenSpace) {
  ASSERT_EQ(render("--integrator screen-chains --guide-views -o a.exr").exitCode, 0);
  expectSound(picture("a.exr"));
}

/// Looking changes neither the picture nor what the next frame goes on from. Seen to fail where it clears the store.
TEST_F(GuideViews, LeaveThePictureAsItIs) {
  ASSERT_EQ(render("--deterministic --spp 4 --frames 1-2 -o a#.exr").exitCode, 0);
  ASSERT_EQ(render("--deterministic --spp 4 --frames 1-2 -o b#.exr --guide-views").exitCode, 0);
  for (const std::string frame : {"1", "2"}) {
    const Channels plain = picture("a" + frame + ".exr");
    const Channels viewed = picture("b" + frame + ".exr");
    EXPECT_EQ(viewed.size(), plain.size() + kLayers.size());
    for (const auto& [name, values] : plain) {
      EXPECT_EQ(viewed.at(name), values) << frame << name;
    }
  }
}

TEST_F(GuideViews, NeedPathsThatAreGuided) {
  const Outcome outcome = render("--integrator path --guide-views -o a.exr");
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_THAT(outcome.errors, HasSubstr("--guide-views"));
  EXPECT_THAT(outcome.errors, HasSubstr("mcpg"));
}

} // namespace
} // namespace tyndall::test
