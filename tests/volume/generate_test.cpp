// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "support/fixtures.h"
#include "volume/depth.h"
#include "volume/generate.h"
#include "volume/load.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tyndall::volume {
namespace {

struct Written {
  test::TemporaryFolder folder;
  GeneratedVolume volume;
  FileInfo info;
  explicit Written(GeneratedVolume made) : volume(std::move(made)) {
    writeVolume(folder / "v.vdb", volume);
    info = inspectFile(folder / "v.vdb");
  }
  BrickGrid grid(const std::string& name) const {
    LoadOptions options;
    options.grid = name;
    options.storage = Storage::Float;
    return loadGrid(folder / "v.vdb", options);
  }
};

/// Nothing may be cut off by the box: its faces are empty, the floor apart.
void expectInsideItsBox(const GeneratedVolume& volume) {
  std::size_t at = 0;
  for (int z = 0; z < volume.size.z; ++z) {
    for (int y = 0; y < volume.size.y; ++y) {
      for (int x = 0; x < volume.size.x; ++x, ++at) {
        const bool face = x == 0 || z == 0 || y == 0 || x == volume.size.x - 1 || z == volume.size.z - 1 ||
                          y == volume.size.y - 1;
        ASSERT_TRUE(!face || volume.density[at] == 0.0f) << x << " " << y << " " << z;
      }
    }
  }
}

TEST(Generate, VolumesComeBackAsTheyWereMade) {
  const Written flame(makeFlame());
  for (const char* name : {"density", "temperature"}) {
    const BrickGrid grid = flame.grid(name);
    const std::vector<float>& field = name[0] == 'd' ? flame.volume.density : flame.volume.temperature;
    for (std::size_t i = 0; i < field.size(); i += 7) {
      const glm::ivec3 at(int(i) % flame.volume.size.x, int(i) / flame.volume.size.x % flame.volume.size.y,
                          int(i) / (flame.volume.size.x * flame.volume.size.y));
      ASSERT_NEAR(grid.voxel(flame.volume.indexMin + at), field[i], 1e-3 * field[i] + 1e-6); // stored as half
    }
  }
  EXPECT_GT(*std::max_element(flame.volume.temperature.begin(), flame.volume.temperature.end()), 1500.0f);
  EXPECT_LT(*std::max_element(flame.volume.temperature.begin(), flame.volume.temperature.end()), 2500.0f);
  EXPECT_EQ(chooseGrids(flame.info).temperature, "temperature");
}

TEST(Generate, VolumesAreSmallAndWhole) {
  for (GeneratedVolume volume : {makePlume(), makeCloud(), makeFlame()}) {
    expectInsideItsBox(volume);
    const Written written(std::move(volume));
    EXPECT_LT(std::filesystem::file_size(written.folder / "v.vdb"), 700'000u);
    EXPECT_EQ(chooseGrids(written.info).density, "density");
    EXPECT_GT(medianOpticalDepth(written.grid("density"), 200), 0.0);
  }
}

TEST(Generate, TheCloudHasActiveTilesAndAFlatBase) {
  const Written cloud(makeCloud());
  EXPECT_GT(cloud.info.grids.at(0).activeTiles, 0u);
  EXPECT_EQ(cloud.info.grids.at(0).type, "half");
  EXPECT_GE(cloud.info.grids.at(0).indexMin.y, -2);
}

TEST(Generate, IsDeterministic) {
  EXPECT_EQ(makePlume().density, makePlume().density);
  EXPECT_EQ(makeCloud().density, makeCloud().density);
}

TEST(Generate, AFolderThatIsNotThereIsAnError) {
  EXPECT_THROW(writeVolume("/no/such/folder/v.vdb", makeFlame()), Error);
}

} // namespace
} // namespace tyndall::volume
