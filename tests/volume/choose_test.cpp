// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "volume/load.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tyndall::volume {
namespace {

using testing::HasSubstr;

GridInfo scalarGrid(const std::string& name, const std::string& gridClass = "unknown", std::uint64_t voxels = 100) {
  GridInfo grid;
  grid.name = name;
  grid.type = "float";
  grid.gridClass = gridClass;
  grid.activeVoxels = voxels;
  grid.scalar = true;
  return grid;
}

GridInfo velocity() {
  GridInfo grid = scalarGrid("vel");
  grid.type = "vec3s";
  grid.scalar = false;
  grid.whyNot = "vectors (vec3s), such as a velocity";
  return grid;
}

GridChoice choose(std::vector<GridInfo> grids) {
  FileInfo info;
  info.path = "file.vdb";
  info.grids = std::move(grids);
  return chooseGrids(info);
}

TEST(ChooseGrids, NamesComeFirst) {
  const GridChoice choice = choose({scalarGrid("other", "fog volume", 9999), scalarGrid("heat"), scalarGrid("Density"), velocity()});
  EXPECT_EQ(choice.density, "Density");
  EXPECT_EQ(choice.temperature, "heat");
  EXPECT_THAT(choice.reason, HasSubstr("by its name"));
}

TEST(ChooseGrids, FindsTheNamesThatProgramsUse) {
  for (const char* name : {"voxel_fog_density", "soot", "smoke", "cloud", "density[1]", "rho", "fluid.density"}) {
    const GridChoice choice = choose({scalarGrid("temperature"), scalarGrid("stuff", "fog volume", 5000), scalarGrid(name)});
    EXPECT_EQ(choice.density, name);
    EXPECT_EQ(choice.temperature, "temperature");
  }
}

TEST(ChooseGrids, NeverTakesATemperatureOrADistanceIfAnotherFits) {
  for (const char* name : {"temperature", "heat", "flame", "fire", "velocity_x", "vel.x", "sdf", "pressure", "fuel"}) {
    const GridChoice choice = choose({scalarGrid(name, "unknown", 100000), scalarGrid("matter", "unknown", 10)});
    EXPECT_EQ(choice.density, "matter") << name;
  }
}

TEST(ChooseGrids, ClassThenSizeDecideBetweenStrangers) {
  EXPECT_EQ(choose({scalarGrid("a", "unknown", 900), scalarGrid("b", "fog volume", 10)}).density, "b");
  EXPECT_EQ(choose({scalarGrid("a", "unknown", 10), scalarGrid("b", "unknown", 900)}).density, "b");
  EXPECT_EQ(choose({scalarGrid("surface", "level set")}).density, "surface");
}

TEST(ChooseGrids, FilledGridsComeBeforeEmptyOnes) {
  EXPECT_EQ(choose({scalarGrid("density", "fog volume", 0), scalarGrid("matter")}).density, "matter");
  const GridChoice empty = choose({scalarGrid("density", "unknown", 0)});
  EXPECT_EQ(empty.density, "density");
  EXPECT_THAT(empty.reason, HasSubstr("empty"));
}

TEST(ChooseGrids, EmissionAloneIsNoDensity) {
  const GridChoice choice = choose({scalarGrid("temperature"), velocity()});
  EXPECT_EQ(choice.density, "");
  EXPECT_EQ(choice.temperature, "temperature");
}

TEST(ChooseGrids, NamesWhatIsThereWhenNothingFits) {
  try {
    choose({velocity()});
    FAIL();
  } catch (const Error& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("file.vdb"));
    EXPECT_THAT(problem.what(), HasSubstr("'vel' (vectors (vec3s)"));
  }
  EXPECT_THROW(choose({}), Error);
}

} // namespace
} // namespace tyndall::volume
