// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "support/fixtures.h"
#include "volume/load.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

namespace tyndall::volume {
namespace {

namespace fs = std::filesystem;

/// What OpenVDB itself says about a point of a grid in index space.
class Oracle {
public:
  Oracle(const fs::path& path, const std::string& name) {
    openvdb::initialize();
    openvdb::io::File file(path.string());
    file.open(false);
    grid_ = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid(name));
  }
  double at(const glm::dvec3& index) const {
    return double(openvdb::tools::BoxSampler::sample(grid_->tree(), openvdb::Vec3R(index.x, index.y, index.z)));
  }
  glm::dvec3 world(const glm::dvec3& index) const {
    const openvdb::Vec3d w = grid_->indexToWorld(openvdb::Vec3d(index.x, index.y, index.z));
    return {w.x(), w.y(), w.z()};
  }

private:
  openvdb::FloatGrid::Ptr grid_;
};

/// Float fog grids under an affine transform, whose voxels are used as they are.
bool comparable(const GridInfo& grid) {
  return (grid.type == "float" || grid.type == "half") && grid.gridClass != "level set" && grid.transform != "frustum" &&
         grid.minValue >= 0.0 && grid.background >= 0.0 && grid.warnings.empty() && !grid.empty() && !grid.name.empty();
}

void compareGrid(const fs::path& path, const GridInfo& info) {
  LoadOptions options;
  options.grid = info.name;
  options.storage = Storage::Float;
  const BrickGrid grid = loadGrid(path, options);
  const Oracle oracle(path, info.name);
  const double tolerance = 1e-6 * double(grid.maximum());
  const Bounds3 bounds = grid.indexBounds();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-0.05, 1.05); // some outside
  for (int i = 0; i < 3000; ++i) {
    glm::dvec3 at = bounds.min + bounds.size() * glm::dvec3(uniform(random), uniform(random), uniform(random));
    at = random() % 4 == 0 ? glm::round(at) : at;
    const double expected = oracle.at(at);
    ASSERT_NEAR(grid.value(at), expected, tolerance) << path << " " << info.name;
    const glm::dvec3 world(grid.worldFromIndex * glm::dvec4(at, 1.0));
    ASSERT_LE(glm::length(world - oracle.world(at)), 1e-12 * (1.0 + glm::length(world) + glm::length(at)));
  }
}

int compareFile(const fs::path& path) {
  int compared = 0;
  for (const GridInfo& info : inspectFile(path).grids) {
    if (comparable(info)) {
      compareGrid(path, info);
      ++compared;
    }
  }
  return compared;
}

TEST(BoxSampler, AgreesOnEveryAffineFixture) {
  const test::TemporaryFolder folder;
  int compared = 0;
  for (const std::string& name : test::writeFixtures(folder.path())) {
    if (name != "far_tile.vdb" && name != "streamed.vdb") { // too large a box; not readable by io::File alone
      compared += compareFile(folder / name);
    }
  }
  EXPECT_GE(compared, 35);
}

/// More volumes, of the user's choice: TYNDALL_TEST_VOLUMES=FOLDER.
TEST(BoxSampler, AgreesOnTheFilesOfTheEnvironment) {
  const char* folder = std::getenv("TYNDALL_TEST_VOLUMES");
  if (folder == nullptr) {
    GTEST_SKIP() << "TYNDALL_TEST_VOLUMES is not set";
  }
  int compared = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".vdb") {
      EXPECT_NO_THROW(compared += compareFile(entry.path())) << entry.path();
      try {
        loadGrid(entry.path(), {});
      } catch (const Error& problem) { // points, velocities: said in words, and nothing else escapes
        std::printf("%s\n", problem.what());
      }
    }
  }
  EXPECT_GT(compared, 0);
}

} // namespace
} // namespace tyndall::volume
