// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "volume/generate.h"

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>

namespace tyndall::volume {
namespace {

/// A sparse half-stored grid of the voxels that are not zero. `at(i)` gives the value of voxel i of the volume.
template <class GridT, class ValueAt>
openvdb::GridBase::Ptr makeGrid(const char* name, const GeneratedVolume& volume, const ValueAt& at) {
  using Value = typename GridT::ValueType;
  const Value zero = openvdb::zeroVal<Value>();
  const typename GridT::Ptr grid = GridT::create(zero);
  auto accessor = grid->getAccessor();
  std::size_t i = 0;
  for (int z = 0; z < volume.size.z; ++z) {
    for (int y = 0; y < volume.size.y; ++y) {
      for (int x = 0; x < volume.size.x; ++x, ++i) {
        const Value value = at(i);
        if (value != zero) {
          accessor.setValue(openvdb::Coord(x, y, z).offsetBy(volume.indexMin.x, volume.indexMin.y, volume.indexMin.z),
                            value);
        }
      }
    }
  }
  openvdb::tools::prune(grid->tree());
  grid->setName(name);
  grid->setSaveFloatAsHalf(true);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(volume.voxelSize));
  return grid;
}

} // namespace

void writeVolume(const std::filesystem::path& path, const GeneratedVolume& volume) {
  openvdb::initialize();
  openvdb::GridPtrVec grids;
  if (!volume.density.empty()) {
    grids.push_back(makeGrid<openvdb::FloatGrid>("density", volume, [&](std::size_t i) { return volume.density[i]; }));
    grids.back()->setGridClass(openvdb::GRID_FOG_VOLUME);
  }
  if (!volume.temperature.empty()) {
    grids.push_back(
        makeGrid<openvdb::FloatGrid>("temperature", volume, [&](std::size_t i) { return volume.temperature[i]; }));
  }
  if (!volume.velocity.empty()) {
    grids.push_back(makeGrid<openvdb::Vec3SGrid>("velocity", volume, [&](std::size_t i) {
      return openvdb::Vec3s(volume.velocity[i].x, volume.velocity[i].y, volume.velocity[i].z);
    }));
    static_cast<openvdb::Vec3SGrid&>(*grids.back()).setVectorType(openvdb::VEC_CONTRAVARIANT_RELATIVE);
  }
  writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
    try {
      openvdb::io::File file(temporary.string());
      file.setCompression(openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK);
      file.write(grids);
    } catch (const openvdb::Exception& problem) {
      fail("{}: cannot be written: {}", path.string(), problem.what());
    }
  });
}

} // namespace tyndall::volume
