// SPDX-License-Identifier: Apache-2.0
// A bare volume's picture: framed, scaled, and the same as its written scene.
#include "scene/auto_scene.h"
#include "scene/load.h"
#include "volume/depth.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace tyndall::scene {
namespace {

/// A soft ellipsoid that fills `size` voxels.
volume::BrickGrid ellipsoid(const glm::ivec3& size, const glm::dmat4& worldFromIndex, float peak = 1.0f) {
  std::vector<float> values;
  for (int z = 0; z < size.z; ++z) {
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x) {
        const glm::dvec3 place = (2.0 * (glm::dvec3(x, y, z) + 0.5) / glm::dvec3(size)) - 1.0;
        values.push_back(peak * static_cast<float>(std::max(0.0, 1.0 - glm::length(place))));
      }
    }
  }
  return volume::gridFromDense(values, size, glm::ivec3(-3, 5, 11), worldFromIndex);
}

AutoInput inputOf(const std::vector<AutoFrame>& frames, const glm::uvec2& size = {640, 480}) {
  AutoInput input;
  input.file = "thing.vdb";
  input.grids.density = "density";
  input.frames = frames;
  input.size = size;
  return input;
}

/// The longer side of what is more than 5 % opaque, over the picture's shorter side; from rays through every
/// fourth pixel, written without the code that frames.
double framedShare(const Scene& scene, const volume::BrickGrid& grid) {
  constexpr int kStep = 4;
  const glm::dvec3 forward = glm::normalize(scene.camera.target - scene.camera.position);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, scene.camera.up));
  const glm::dvec3 up = glm::cross(right, forward);
  const glm::dmat4 mediumFromWorld = glm::inverse(scene.media.front().worldFromMedium);
  const double half = std::tan(glm::radians(0.5 * scene.camera.verticalFov));
  const glm::ivec2 size(scene.film.size);
  glm::ivec2 low(size);
  glm::ivec2 high(-1);
  for (int y = 0; y < size.y; y += kStep) {
    for (int x = 0; x < size.x; x += kStep) {
      const double u = half * (2.0 * x - size.x) / size.y;
      const double v = half * (size.y - 2.0 * y) / size.y;
      const glm::dvec3 direction = glm::normalize(forward + u * right + v * up);
      const double depth = volume::exactOpticalDepth(
          grid, glm::dvec3(mediumFromWorld * glm::dvec4(scene.camera.position, 1.0)),
          glm::dvec3(mediumFromWorld * glm::dvec4(direction, 0.0)), 0.0, INFINITY);
      if (1.0 - std::exp(-scene.media.front().densityScale * depth) > 0.05) {
        low = glm::min(low, glm::ivec2(x, y));
        high = glm::max(high, glm::ivec2(x, y));
      }
    }
  }
  return double(std::max(high.x - low.x, high.y - low.y) + kStep) / std::min(size.x, size.y);
}

struct Placement {
  const char* name;
  glm::ivec3 voxels;
  glm::dmat4 worldFromIndex;
  glm::uvec2 size;
};

std::vector<Placement> placements() {
  const glm::dmat4 identity(1.0);
  const glm::dmat4 far = glm::translate(identity, glm::dvec3(1e5, -3e4, 2e3));
  const glm::dmat4 turned = glm::rotate(identity, 0.8, glm::normalize(glm::dvec3(1, 2, 3)));
  const glm::dmat4 tiny = glm::scale(identity, glm::dvec3(1e-4));
  const glm::dmat4 uneven = glm::scale(identity, glm::dvec3(0.3, 2.0, 0.7));
  return {{"cube", {32, 32, 32}, identity, {640, 480}},       {"tower", {16, 80, 16}, identity, {640, 480}},
          {"plate", {64, 8, 64}, identity, {640, 480}},       {"rodInDepth", {12, 12, 96}, identity, {640, 480}},
          {"rodAcross", {96, 12, 12}, identity, {640, 480}},  {"farAway", {32, 24, 32}, far, {640, 480}},
          {"turned", {24, 64, 16}, turned, {640, 480}},       {"tiny", {32, 24, 32}, tiny, {640, 480}},
          {"uneven", {32, 32, 32}, uneven, {640, 480}},       {"portrait", {32, 64, 32}, identity, {300, 500}},
          {"panorama", {64, 16, 32}, identity, {800, 200}}};
}

TEST(AutoScene, FramesAnyShapeToBetween60And90PercentOfTheShorterSide) {
  for (const Placement& placement : placements()) {
    const volume::BrickGrid grid = ellipsoid(placement.voxels, placement.worldFromIndex);
    const AutoScene made = makeAutoScene(inputOf({{&grid, nullptr}}, placement.size));
    const double share = framedShare(made.scene, grid);
    EXPECT_GE(share, 0.6) << placement.name;
    EXPECT_LE(share, 0.9) << placement.name;
  }
}

TEST(AutoScene, TheCheckOfFramingSeesABadCamera) {
  const volume::BrickGrid grid = ellipsoid({32, 32, 32}, glm::dmat4(1.0));
  Scene scene = makeAutoScene(inputOf({{&grid, nullptr}})).scene;
  scene.camera.position += 0.5 * (scene.camera.position - scene.camera.target);
  EXPECT_LT(framedShare(scene, grid), 0.6);
}

TEST(AutoScene, ScalesTheMedianOpticalDepthInto3To8WhateverTheUnits) {
  for (const float peak : {1e-3f, 1.0f, 500.0f}) {
    for (const double voxel : {1e-3, 1.0, 50.0}) {
      const volume::BrickGrid grid = ellipsoid({32, 40, 32}, glm::scale(glm::dmat4(1.0), glm::dvec3(voxel)), peak);
      const Scene scene = makeAutoScene(inputOf({{&grid, nullptr}})).scene;
      // Another number of lines than the code takes.
      const double depth = scene.media.front().densityScale * volume::medianOpticalDepth(grid, 900);
      EXPECT_GT(depth, 3.0) << peak << " " << voxel;
      EXPECT_LT(depth, 8.0) << peak << " " << voxel;
    }
  }
}

TEST(AutoScene, AGivenDensityScaleIsTaken) {
  const volume::BrickGrid grid = ellipsoid({16, 16, 16}, glm::dmat4(1.0));
  AutoInput input = inputOf({{&grid, nullptr}});
  input.densityScale = 0.125;
  EXPECT_EQ(makeAutoScene(input).scene.media.front().densityScale, 0.125);
}

TEST(AutoScene, OneFramingAndOneScaleServeAllFrames) {
  const volume::BrickGrid thin = ellipsoid({16, 16, 16}, glm::dmat4(1.0), 0.5f);
  const volume::BrickGrid thick = ellipsoid({24, 48, 24}, glm::translate(glm::dmat4(1.0), glm::dvec3(0, 10, 0)), 2.0f);
  const volume::BrickGrid nothing;
  const AutoScene all = makeAutoScene(inputOf({{&nothing, nullptr}, {&thin, nullptr}, {&thick, nullptr}}));
  EXPECT_FALSE(all.empty);
  EXPECT_EQ(all.densestFrame, 2u);
  EXPECT_NEAR(all.medianOpticalDepth, 5.0, 1e-9);
  EXPECT_LE(framedShare(all.scene, thin), 0.9);
  EXPECT_LE(framedShare(all.scene, thick), 0.9);
  EXPECT_GE(std::max(framedShare(all.scene, thin), framedShare(all.scene, thick)), 0.5);
}

TEST(AutoScene, AnEmptyVolumeGivesABackground) {
  const volume::BrickGrid nothing;
  const AutoScene made = makeAutoScene(inputOf({{&nothing, nullptr}}));
  EXPECT_TRUE(made.empty);
  EXPECT_FALSE(made.scene.lights.empty());
}

TEST(AutoScene, AHeatGridGlowsAsKelvinAlsoWhereItIsNotIn) {
  const volume::BrickGrid density = ellipsoid({24, 24, 24}, glm::dmat4(1.0));
  for (const float peak : {0.8f, 1800.0f}) {
    const volume::BrickGrid heat = ellipsoid({24, 24, 24}, glm::dmat4(1.0), peak);
    AutoInput input = inputOf({{&density, &heat}});
    input.grids.temperature = "heat";
    const Scene scene = makeAutoScene(input).scene;
    ASSERT_TRUE(scene.media.front().emission);
    const Emission& emission = *scene.media.front().emission;
    const double hottest = emission.temperatureScale * double(heat.maximum());
    EXPECT_GT(hottest, 1500.0);
    EXPECT_LT(hottest, 2100.0);
    EXPECT_TRUE(std::isfinite(emission.scale) && emission.scale > 0.0);
  }
}

TEST(AutoScene, ZUpTurnsTheVolume) {
  const volume::BrickGrid tower = ellipsoid({16, 16, 80}, glm::dmat4(1.0));
  AutoInput input = inputOf({{&tower, nullptr}});
  input.up = UpAxis::Z;
  const Scene scene = makeAutoScene(input).scene;
  const glm::dvec3 up(scene.media.front().worldFromMedium * glm::dvec4(0, 0, 1, 0));
  EXPECT_NEAR(up.y, 1.0, 1e-12);
  EXPECT_GE(framedShare(scene, tower), 0.6);
}

TEST(AutoScene, WrittenAndReadAgainItIsTheSame) {
  const volume::BrickGrid grid = ellipsoid({24, 48, 24}, glm::dmat4(1.0));
  Scene scene = makeAutoScene(inputOf({{&grid, nullptr}})).scene;
  scene.media.front().file = "frame_####.vdb"; // a sequence's files need not be there
  const std::string text = toJson(scene);
  const LoadResult again = parseScene(text, "made.json", "");
  ASSERT_TRUE(again.ok()) << again.problems.front().message;
  EXPECT_EQ(toJson(again.scene), text);
}

} // namespace
} // namespace tyndall::scene
