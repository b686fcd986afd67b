// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "volume/load.h"
#include "volume/vdb_file.h"
#include "volume/vdb_grid.h"

#include <algorithm>
#include <cmath>

namespace tyndall::volume {
namespace {

/// Range and oddities of active values.
struct ValueScan {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();
  std::uint64_t negative = 0;
  std::uint64_t nonFinite = 0;

  void add(double value, std::uint64_t voxels) {
    if (!std::isfinite(value)) {
      nonFinite += voxels;
      return;
    }
    min = std::min(min, value);
    max = std::max(max, value);
    negative += value < 0.0 ? voxels : 0;
  }
};

std::string typeName(const GridEntry& entry, const std::string& valueType) {
  if (valueType == "ptdataidx32") {
    return "points";
  }
  if (valueType == "ptidx32" || valueType == "ptidx64") {
    return "point index";
  }
  return entry.savedAsHalf && valueType == "float" ? "half" : valueType;
}

std::string describeNonScalar(const std::string& type) {
  if (type == "points") {
    return "points, not a voxel density; rasterise them to a density grid first";
  }
  if (type.starts_with("vec")) {
    return "vectors (" + type + "), such as a velocity";
  }
  return "values of type " + type;
}

std::string className(const openvdb::GridBase& grid) {
  const std::string name = openvdb::GridBase::gridClassToString(grid.getGridClass());
  return name.empty() ? "unknown" : name;
}

void describeTransform(const openvdb::GridBase& grid, GridInfo& info) {
  if (!grid.transform().isLinear()) {
    const ResamplePlan plan = planResampling(grid);
    info.transform = "frustum";
    info.worldFromIndex = plan.worldFromIndex;
    info.indexMin = plan.indexMin;
    info.indexMax = plan.indexMax;
    info.warnings.push_back("the frustum transform is resampled to cubic voxels on loading");
  } else {
    info.worldFromIndex = worldFromIndexOf(grid);
  }
  bool diagonal = true;
  for (int axis = 0; axis < 3; ++axis) {
    info.voxelSize[axis] = glm::length(glm::dvec3(info.worldFromIndex[axis]));
    for (int other = 0; other < 3; ++other) {
      diagonal = diagonal && (axis == other || info.worldFromIndex[axis][other] == 0.0);
    }
  }
  if (!info.transform.empty()) {
    return;
  }
  const glm::dvec3 size = info.voxelSize;
  if (!diagonal) {
    info.transform = "affine";
  } else if (size.x == size.y && size.y == size.z) {
    info.transform = fmt::format("uniform scale {:g}", size.x);
  } else {
    info.transform = fmt::format("scale {:g} x {:g} x {:g}", size.x, size.y, size.z);
  }
}

void describeValues(const openvdb::GridBase& grid, GridInfo& info) {
  ValueScan scan;
  info.scalar = withScalarGrid(grid, [&](const auto& typed) {
    info.background = double(typed.background());
    const auto& tree = typed.constTree();
    for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
      for (auto value = leaf->cbeginValueOn(); value; ++value) {
        scan.add(double(*value), 1);
      }
    }
    auto tile = tree.cbeginValueOn();
    tile.setMaxDepth(std::decay_t<decltype(tree)>::ValueOnCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
      scan.add(double(*tile), tile.getVoxelCount());
    }
  });
  if (!info.scalar) {
    info.whyNot = describeNonScalar(info.type);
    return;
  }
  if (scan.min <= scan.max) {
    info.minValue = scan.min;
    info.maxValue = scan.max;
  }
  const bool levelSet = info.gridClass == "level set";
  if (levelSet) {
    info.warnings.push_back("a level set: it becomes a fog volume on loading");
  } else if (scan.negative > 0 && info.background > 0.0) {
    info.warnings.push_back("looks like a signed distance field that is not marked as a level set; mark it as one");
  }
  if (scan.nonFinite > 0) {
    info.warnings.push_back(fmt::format("{} active voxels are NaN or infinite and become 0", scan.nonFinite));
  }
  if (scan.negative > 0 && !levelSet) {
    info.warnings.push_back(fmt::format("{} active voxels are negative and become 0 in a density", scan.negative));
  }
  if (info.background != 0.0 && !levelSet) {
    info.warnings.push_back(fmt::format("the background is {:g}: taken as 0 outside the active box", info.background));
  }
}

GridInfo describeGrid(VdbFile& file, const GridEntry& entry) {
  GridInfo info;
  info.name = entry.name;
  if (!VdbFile::isKnownType(entry)) {
    info.type = entry.type;
    info.gridClass = info.transform = "unknown";
    info.whyNot = "an unknown grid type " + entry.type;
    return info;
  }
  const openvdb::GridBase::Ptr grid = file.readGrid(entry, std::nullopt);
  info.type = typeName(entry, grid->valueType());
  info.gridClass = className(*grid);
  info.activeVoxels = grid->activeVoxelCount();
  info.activeTiles = grid->baseTree().activeTileCount();
  info.leafBricks = grid->baseTree().leafCount();
  if (!info.empty()) {
    const openvdb::CoordBBox box = grid->evalActiveVoxelBoundingBox();
    info.indexMin = toGlm(box.min());
    info.indexMax = toGlm(box.max());
  } else {
    info.warnings.push_back("the grid is empty");
  }
  try {
    describeTransform(*grid, info);
    describeValues(*grid, info);
  } catch (const Error& problem) {
    info.transform = "singular";
    info.whyNot = problem.what();
    info.scalar = false;
  }
  return info;
}

} // namespace

FileInfo inspectFile(const std::filesystem::path& path) {
  VdbFile file(path);
  FileInfo info;
  info.path = file.path();
  info.version = file.formatVersion();
  info.metadata = file.metadata();
  for (const GridEntry& entry : file.entries()) {
    info.grids.push_back(guardedRead(file.path(), [&] { return describeGrid(file, entry); }));
  }
  return info;
}

} // namespace tyndall::volume
