// SPDX-License-Identifier: Apache-2.0
#include "volume/load.h"

#include "base/error.h"
#include "support/fixtures.h"
#include "volume/depth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

namespace tyndall::volume {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

class Load : public testing::Test {
protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<test::TemporaryFolder>();
    names_ = test::writeFixtures(folder_->path());
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::filesystem::path path(const std::string& name) { return *folder_ / (name + ".vdb"); }
  static BrickGrid load(const std::string& name, LoadOptions options = {}) {
    options.storage = Storage::Float;
    return loadGrid(path(name), options);
  }
  static std::string messageOf(const std::function<void()>& work) {
    try {
      work();
    } catch (const Error& problem) {
      return problem.what();
    }
    return "no error";
  }

  static std::unique_ptr<test::TemporaryFolder> folder_;
  static std::vector<std::string> names_;
};
std::unique_ptr<test::TemporaryFolder> Load::folder_;
std::vector<std::string> Load::names_;

TEST_F(Load, EveryFixtureLoadsOrSaysWhyNot) {
  for (const std::string& name : names_) {
    const FileInfo info = inspectFile(folder_->path() / name);
    EXPECT_TRUE(info.version.starts_with("v2")) << name;
    try {
      const BrickGrid grid = loadGrid(folder_->path() / name, {});
      EXPECT_EQ(grid.ranges.size(), grid.bricks.size()) << name;
    } catch (const Error& problem) {
      EXPECT_THAT(problem.what(), HasSubstr(name)); // says which file
    }
  }
}

TEST_F(Load, ScalarTypesGiveTheSameBall) {
  const BrickGrid plain = load("plain");
  EXPECT_EQ(plain.activeVoxels, inspectFile(path("plain")).grids.at(0).activeVoxels);
  for (const char* name : {"double", "half"}) {
    const BrickGrid grid = load(name);
    for (int x = -10; x < 11; ++x) {
      EXPECT_NEAR(grid.voxel({x, 1, -2}), plain.voxel({x, 1, -2}), 1e-3) << name;
    }
  }
  EXPECT_EQ(inspectFile(path("half")).grids.at(0).type, "half");
  for (const char* name : {"int32", "int64"}) {
    EXPECT_EQ(load(name).voxel({0, 0, 0}), 50.0f);
    EXPECT_EQ(load(name).voxel({9, 0, 0}), float(int(50.0 * (1.0 - 9.0 / 9.5))));
  }
  EXPECT_EQ(load("bool").maximum(), 1.0f);
  const BrickGrid mask = load("mask");
  EXPECT_EQ(mask.voxel({10, 4, 20}), 1.0f);
  EXPECT_EQ(mask.voxel({11, 4, 20}), 0.0f);
}

TEST_F(Load, TilesAreConstantBricks) {
  const BrickGrid grid = load("tiles");
  EXPECT_EQ(grid.voxel({31, 0, 17}), 0.5f);
  EXPECT_EQ(grid.voxel({255, 128, 200}), 0.25f);
  EXPECT_EQ(grid.voxel({256, 128, 200}), 0.0f);
  EXPECT_EQ(grid.voxel({10, 42, 3}), 0.75f) << "inactive tiles hold values too";
  EXPECT_LT(grid.slotCount(), 100u);
  EXPECT_EQ(grid.indexMax, glm::ivec3(255));
}

TEST_F(Load, ActiveZerosExtendTheBoundsAndNothingElse) {
  const BrickGrid grid = load("active_zeros");
  EXPECT_EQ(grid.indexMin, glm::ivec3(-30));
  EXPECT_EQ(grid.maximum(), load("plain").maximum());
}

TEST_F(Load, LevelSetsBecomeFog) {
  const BrickGrid grid = load("level_set"); // radius 4 at (0.5, -1, 2), voxels of 0.2
  const glm::dmat4 indexFromWorld = glm::inverse(grid.worldFromIndex);
  const auto density = [&](const glm::dvec3& world) {
    return grid.value(glm::dvec3(indexFromWorld * glm::dvec4(world, 1.0)));
  };
  EXPECT_EQ(density({0.5, -1.0, 2.0}), 1.0);
  EXPECT_EQ(density({0.5 + 3.0, -1.0, 2.0}), 1.0);
  EXPECT_EQ(density({0.5 + 4.3, -1.0, 2.0}), 0.0);
  EXPECT_EQ(grid.maximum(), 1.0f);
  EXPECT_THAT(grid.report.notes, Contains(HasSubstr("level set")));
  EXPECT_LT(grid.slotCount(), grid.bricks.size()) << "the interior stays sparse";
  // A chord through the middle: 8 long, less a linear ramp of three voxels at each end.
  EXPECT_NEAR(exactOpticalDepth(grid, {0.5, -1, -10}, {0, 0, 1}, 0, 100), 8.0 - 3 * 0.2, 0.05);
}

TEST_F(Load, EmptyGridsAreEmptyVolumes) {
  const BrickGrid grid = load("empty_grids");
  EXPECT_TRUE(grid.empty());
  EXPECT_EQ(grid.value({0, 0, 0}), 0.0);
  EXPECT_EQ(grid.deviceBytes(), 0.0);
  EXPECT_THAT(grid.report.notes, Contains(HasSubstr("empty")));
}

TEST_F(Load, BadValuesAreCountedAndZero) {
  const BrickGrid grid = load("bad_values");
  EXPECT_EQ(grid.report.nonFiniteVoxels, 3u);
  EXPECT_EQ(grid.report.negativeVoxels, 5u);
  EXPECT_EQ(grid.voxel({0, 0, 0}), 0.0f);
  EXPECT_EQ(grid.voxel({0, 3, 0}), 0.0f);
  LoadOptions options;
  options.signedValues = true;
  EXPECT_EQ(load("bad_values", options).voxel({0, 3, 0}), -0.5f);
  EXPECT_EQ(load("bad_values", options).report.negativeVoxels, 0u);
}

TEST_F(Load, TheBackgroundEndsOneVoxelOutsideTheActiveBox) {
  const BrickGrid grid = load("background_one"); // active 3..12
  EXPECT_EQ(grid.voxel({4, 4, 4}), 1.0f);
  EXPECT_EQ(grid.voxel({2, 2, 13}), 1.0f);
  EXPECT_EQ(grid.voxel({1, 4, 4}), 0.0f);
  EXPECT_EQ(grid.voxel({14, 4, 4}), 0.0f);
  EXPECT_EQ(grid.value({1.999, 4, 4}), 0.0);
  EXPECT_THAT(grid.report.notes, Contains(HasSubstr("background is 1")));
  EXPECT_EQ(load("background_negative").voxel({2, 2, 13}), 0.0f);
}

TEST_F(Load, AKeptBackgroundFillsTheClipBox) {
  LoadOptions options;
  options.keepBackground = true;
  options.clip = Bounds3{glm::dvec3(-20.0), glm::dvec3(30.0)};
  const BrickGrid grid = load("background_one", options);
  EXPECT_EQ(grid.voxel({-20, 30, 0}), 1.0f);
  EXPECT_EQ(grid.voxel({6, 6, 6}), 2.0f);
  EXPECT_EQ(grid.value({40, 0, 0}), 0.0);
}

TEST_F(Load, ClippingKeepsTheFieldInsideAndDropsTheRest) {
  for (const test::NamedTransform& transform : test::affineTransforms()) {
    const BrickGrid whole = load("ball_" + transform.name);
    const glm::dvec3 centre(transform.worldFromIndex * glm::dvec4(2, 0, -1, 1));
    const double reach = 2.0 * glm::length(glm::dvec3(transform.worldFromIndex[0]));
    LoadOptions options;
    options.clip = Bounds3{centre - reach, centre + reach};
    const BrickGrid clipped = load("ball_" + transform.name, options);
    EXPECT_LE(clipped.activeVoxels, whole.activeVoxels) << transform.name;
    const glm::dmat4 indexFromWorld = glm::inverse(whole.worldFromIndex);
    for (int i = 0; i < 200; ++i) {
      const glm::dvec3 at = centre + reach * (2.0 * glm::fract(double(i) * glm::dvec3(0.618, 0.755, 0.57)) - 1.0);
      const glm::dvec3 index(indexFromWorld * glm::dvec4(at, 1.0));
      ASSERT_DOUBLE_EQ(clipped.value(index), whole.value(index)) << transform.name;
    }
  }
  LoadOptions options;
  options.clip = Bounds3{glm::dvec3(500.0), glm::dvec3(600.0)};
  EXPECT_TRUE(load("plain", options).empty());
}

TEST_F(Load, FrustumsAreResampled) {
  const BrickGrid grid = load("frustum");
  EXPECT_THAT(grid.report.notes, Contains(HasSubstr("frustum")));
  EXPECT_NEAR(grid.maximum(), 0.5, 1e-6);
  EXPECT_EQ(inspectFile(path("frustum")).grids.at(0).transform, "frustum");
  // Along the frustum's axis the density is 0.5 over voxels 2..29 of 0..31, which span a depth of 6 units.
  const glm::dvec3 from = grid.worldBounds().centre();
  EXPECT_NEAR(exactOpticalDepth(grid, from, {0, 0, 1}, -100, 100), 0.5 * 6.0 * 28.0 / 31.0, 0.05);
}

TEST_F(Load, GridsAreFoundByName) {
  LoadOptions options;
  options.grid = "density[1]";
  EXPECT_EQ(load("odd_names", options).indexMin.x, 21);
  options.grid = "density[0]";
  EXPECT_EQ(load("odd_names", options).indexMin.x, -9);
  options.grid = "smoke density/2 \xc3\xa9";
  EXPECT_EQ(load("odd_names", options).name, options.grid);
  options.grid = "densty";
  EXPECT_THAT(messageOf([&] { load("two_boxes", options); }),
              AllOf(HasSubstr("two_boxes.vdb"), HasSubstr("did you mean 'density'"), HasSubstr("'heat'")));
}

TEST_F(Load, GridsThatShareATreeKeepTheirTransforms) {
  LoadOptions options;
  options.grid = "moved";
  const BrickGrid grid = load("shared_tree", options);
  EXPECT_EQ(grid.worldFromIndex[0][0], 0.5);
  EXPECT_EQ(grid.voxel({1, 1, 1}), load("plain").voxel({1, 1, 1}));
}

TEST_F(Load, StreamedFilesReadLikeOthers) {
  for (const char* name : {"heat", "density"}) {
    LoadOptions options;
    options.grid = name;
    const BrickGrid streamed = load("streamed", options);
    const BrickGrid usual = load("two_boxes", options);
    EXPECT_EQ(streamed.voxels, usual.voxels);
    EXPECT_EQ(streamed.indexMin, usual.indexMin);
  }
}

TEST_F(Load, OtherGridsAreRefusedInWords) {
  EXPECT_THAT(messageOf([] { load("vec3_only"); }), AllOf(HasSubstr("vectors"), HasSubstr("'vel'")));
  EXPECT_THAT(messageOf([] { load("points_only"); }), HasSubstr("points"));
  EXPECT_THAT(messageOf([] { load("no_grids"); }), HasSubstr("no grids"));
  LoadOptions options;
  options.grid = "vel";
  EXPECT_THAT(messageOf([&] { load("vec3_only", options); }), HasSubstr("vec3s"));
}

TEST_F(Load, BoxesBeyondReasonAskForAClip) {
  EXPECT_THAT(messageOf([] { load("far_tile"); }), HasSubstr("clip"));
  LoadOptions options;
  options.clip = Bounds3{glm::dvec3(1000.0), glm::dvec3(1050.0)};
  const BrickGrid grid = load("far_tile", options);
  EXPECT_EQ(grid.voxel({1020, 1010, 1049}), 0.5f);
}

TEST_F(Load, ExtremeValuesStayFinite) {
  for (const std::optional<Storage> storage : {std::optional<Storage>(), std::optional(Storage::Unorm8)}) {
    LoadOptions options;
    options.storage = storage;
    const BrickGrid grid = loadGrid(path("extremes"), options);
    EXPECT_FLOAT_EQ(grid.maximum(), 3e38f);
    EXPECT_NE(grid.storage, Storage::Half);
  }
}

TEST_F(Load, OneVoxelAndThinSheets) {
  const BrickGrid point = load("one_voxel");
  EXPECT_EQ(point.indexMin, glm::ivec3(-1, 7, 8));
  EXPECT_NEAR(exactOpticalDepth(point, {-1, 7, 0}, {0, 0, 1}, 0, 100), 3.0, 1e-12);
  const BrickGrid sheet = load("thin");
  EXPECT_NEAR(exactOpticalDepth(sheet, {20, 0, 20}, {0, 1, 0}, 0, 100), 1.5, 1e-12);
}

} // namespace
} // namespace tyndall::volume
