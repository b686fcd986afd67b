// SPDX-License-Identifier: Apache-2.0
#include "volume/grid_write.h"

#include "base/error.h"
#include "base/file.h"

#include <glm/gtc/type_ptr.hpp>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>

#include <fstream>
#include <memory>

namespace tyndall::volume {
namespace {

/// Calls action(index) for each voxel from min to max, x fastest.
template <class Action>
void forEachVoxel(const glm::ivec3& min, const glm::ivec3& max, const Action& action) {
  for (int z = min.z; z <= max.z; ++z) {
    for (int y = min.y; y <= max.y; ++y) {
      for (int x = min.x; x <= max.x; ++x) {
        action(glm::ivec3(x, y, z));
      }
    }
  }
}

openvdb::FloatGrid::Ptr makeGrid(const BrickGrid& grid, const glm::dmat4& worldFromIndex) {
  const openvdb::FloatGrid::Ptr made = openvdb::FloatGrid::create(0.0f);
  auto accessor = made->getAccessor();
  forEachVoxel(glm::ivec3(0), grid.brickCount - 1, [&](const glm::ivec3& brick) {
    const BrickRecord& record =
        grid.bricks[brick.x + std::size_t(grid.brickCount.x) * (brick.y + std::size_t(grid.brickCount.y) * brick.z)];
    if (record.slot == kConstantBrick && record.offset == 0.0f) {
      return;
    }
    const glm::ivec3 first = grid.firstVoxel + kBrickEdge * brick;
    forEachVoxel(glm::max(first, grid.indexMin), glm::min(first + (kBrickEdge - 1), grid.indexMax),
                 [&](const glm::ivec3& index) {
                   const float value = grid.voxel(index);
                   if (value != 0.0f) {
                     accessor.setValue(openvdb::Coord(index.x, index.y, index.z), value);
                   }
                 });
  });
  openvdb::tools::prune(made->tree());
  made->setName("density");
  made->setGridClass(openvdb::GRID_FOG_VOLUME);
  // Both hold the images of the axes one after the other: OpenVDB's points are rows.
  const auto map = std::make_shared<openvdb::math::AffineMap>(openvdb::Mat4d(glm::value_ptr(worldFromIndex)));
  made->setTransform(std::make_shared<openvdb::math::Transform>(openvdb::math::simplify(map)));
  return made;
}

} // namespace

void writeGrid(const std::filesystem::path& path, const BrickGrid& grid, const glm::dmat4& worldFromIndex) {
  openvdb::initialize();
  const openvdb::FloatGrid::Ptr made = makeGrid(grid, worldFromIndex);
  writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
    try {
      openvdb::io::File(temporary.string()).write({made});
    } catch (const openvdb::Exception& problem) {
      fail("{}: cannot be written: {}", path.string(), problem.what());
    }
  });
}

void writeDense(const std::filesystem::path& path, const BrickGrid& grid) {
  writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    forEachVoxel(grid.indexMin, grid.indexMax, [&](const glm::ivec3& index) {
      const float value = grid.voxel(index);
      stream.write(reinterpret_cast<const char*>(&value), sizeof value);
    });
    if (!stream.flush()) {
      fail("{}: cannot be written; is the disk full?", path.string());
    }
  });
}

} // namespace tyndall::volume
