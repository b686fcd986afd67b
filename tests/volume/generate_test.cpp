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

const GeneratedVolume& plume() {
  static const GeneratedVolume volume = makePlume();
  return volume;
}
const GeneratedVolume& cloud() {
  static const GeneratedVolume volume = makeCloud();
  return volume;
}
const GeneratedVolume& flame() {
  static const GeneratedVolume volume = makeFlame();
  return volume;
}

struct Written {
  test::TemporaryFolder folder;
  const GeneratedVolume& volume;
  FileInfo info;
  explicit Written(const GeneratedVolume& made) : volume(made) {
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
  const Written written(flame());
  for (const char* name : {"density", "temperature"}) {
    const BrickGrid grid = written.grid(name);
    const std::vector<float>& field = name[0] == 'd' ? written.volume.density : written.volume.temperature;
    for (std::size_t i = 0; i < field.size(); i += 7) {
      const glm::ivec3 at(int(i) % written.volume.size.x, int(i) / written.volume.size.x % written.volume.size.y,
                          int(i) / (written.volume.size.x * written.volume.size.y));
      ASSERT_NEAR(grid.voxel(written.volume.indexMin + at), field[i], 1e-3f * field[i] + 1e-6f); // stored as half
    }
  }
  EXPECT_GT(*std::max_element(written.volume.temperature.begin(), written.volume.temperature.end()), 1500.0f);
  EXPECT_LT(*std::max_element(written.volume.temperature.begin(), written.volume.temperature.end()), 2500.0f);
  EXPECT_EQ(chooseGrids(written.info).temperature, "temperature");
}

TEST(Generate, VolumesAreSmallAndWhole) {
  for (const GeneratedVolume* volume : {&plume(), &cloud(), &flame()}) {
    expectInsideItsBox(*volume);
    const Written written(*volume);
    EXPECT_LT(std::filesystem::file_size(written.folder / "v.vdb"), 700'000u);
    EXPECT_EQ(chooseGrids(written.info).density, "density");
    EXPECT_GT(medianOpticalDepth(written.grid("density"), 200), 0.0);
  }
}

TEST(Generate, TheCloudHasActiveTilesAndAFlatBase) {
  const Written written(cloud());
  EXPECT_GT(written.info.grids.at(0).activeTiles, 0u);
  EXPECT_EQ(written.info.grids.at(0).type, "half");
  EXPECT_GE(written.info.grids.at(0).indexMin.y, -2);
}

TEST(Generate, IsDeterministic) {
  EXPECT_EQ(makePlume().density, plume().density);
  EXPECT_EQ(makePlume().velocity, plume().velocity);
}

TEST(Generate, AFolderThatIsNotThereIsAnError) {
  EXPECT_THROW(writeVolume("/no/such/folder/v.vdb", flame()), Error);
}

} // namespace
} // namespace tyndall::volume
