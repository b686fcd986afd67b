// SPDX-License-Identifier: Apache-2.0
#include "volume/load.h"

#include "base/error.h"
#include "volume/vdb_file.h"
#include "volume/vdb_grid.h"

#include <algorithm>

namespace tyndall::volume {
namespace {

const GridEntry& findEntry(const VdbFile& file, const std::string& name) {
  std::vector<std::string> names;
  for (const GridEntry& entry : file.entries()) {
    if (entry.name == name) {
      return entry;
    }
    names.push_back("'" + entry.name + "'");
  }
  if (names.empty()) {
    fail("{}: holds no grids, so no '{}'; export the volume again", file.path(), name);
  }
  const std::string nearest = nearestName("'" + name + "'", names);
  fail("{}: has no grid '{}'{}; it has {}", file.path(), name,
       nearest.empty() ? "" : "; did you mean " + nearest + "?", joinNames(names));
}

/// The entry to read, and in the report why if nobody named it.
const GridEntry& selectEntry(const VdbFile& file, const LoadOptions& options, LoadReport& report) {
  if (!options.grid.empty()) {
    return findEntry(file, options.grid);
  }
  const GridChoice choice = chooseGrids(inspectFile(file.path()));
  if (choice.density.empty()) {
    fail("{}: {}; name the grid to use as density, or use it as emission only (\"grid\": \"none\")", file.path(),
         choice.reason);
  }
  report.notes.push_back(choice.reason);
  return findEntry(file, choice.density);
}

void requireScalar(const VdbFile& file, const GridEntry& entry, const openvdb::GridBase& grid) {
  if (withScalarGrid(grid, [](const auto&) {})) {
    return;
  }
  std::vector<std::string> scalars;
  for (const GridInfo& info : inspectFile(file.path()).grids) {
    if (info.scalar) {
      scalars.push_back("'" + info.name + "'");
    }
  }
  const std::string fix = scalars.empty() ? "; the file has no scalar grid: export a density"
                                          : "; the scalar grids are " + joinNames(scalars);
  fail("{}: grid '{}' holds values of type {}, not a scalar field{}", file.path(), entry.name, grid.valueType(), fix);
}

/// What the file's grid comes to before bricks are made of it.
struct Source {
  SparseVoxels voxels;
  glm::dmat4 worldFromIndex{1.0};
};

Source makeSource(const VdbFile& file, const openvdb::GridBase::Ptr& read, bool signedValues, LoadReport& report) {
  openvdb::GridBase::Ptr grid = read;
  if (grid->getGridClass() == openvdb::GRID_LEVEL_SET) {
    if (openvdb::GridBase::Ptr fog = fogOfLevelSet(*grid)) {
      grid = fog;
      report.notes.push_back("a level set: made into a fog volume, 0 at the surface and 1 inside");
    }
  }
  Source source;
  if (grid->transform().isLinear()) {
    try {
      source.worldFromIndex = worldFromIndexOf(*grid);
    } catch (const Error& problem) {
      fail("{}: {}", file.path(), problem.what());
    }
    source.voxels = extractVoxels(*grid, signedValues);
    return source;
  }
  const ResamplePlan plan = planResampling(*grid);
  source.worldFromIndex = plan.worldFromIndex;
  source.voxels = resampled(*grid, plan, signedValues);
  report.notes.push_back(fmt::format("the frustum transform was resampled to {} x {} x {} cubic voxels of {:g}",
                                     plan.indexMax.x + 1, plan.indexMax.y + 1, plan.indexMax.z + 1,
                                     plan.worldFromIndex[0][0]));
  return source;
}

/// Cuts the active box to the clip box; a kept background fills the clip box instead.
void applyClip(const Bounds3& clip, bool keepBackground, Source& source, LoadReport& report) {
  const IndexBox box = indexBoxOfClip(clip, source.worldFromIndex);
  SparseVoxels& voxels = source.voxels;
  const bool wasEmpty = glm::any(glm::lessThan(voxels.indexMax, voxels.indexMin));
  if (keepBackground && voxels.background != 0.0f && !box.empty()) {
    voxels.indexMin = box.min;
    voxels.indexMax = box.max;
    return;
  }
  const glm::ivec3 low = glm::max(voxels.indexMin, box.min);
  const glm::ivec3 high = glm::min(voxels.indexMax, box.max);
  if (wasEmpty || box.empty() || glm::any(glm::lessThan(high, low))) {
    voxels = SparseVoxels{};
    report.notes.push_back("nothing of the grid is inside the clip box");
    return;
  }
  voxels.indexMin = low;
  voxels.indexMax = high;
}

void noteBackground(const SparseVoxels& voxels, const LoadOptions& options, LoadReport& report) {
  if (voxels.background == 0.0f) {
    return;
  }
  if (!options.keepBackground) {
    report.notes.push_back(fmt::format(
        "the background is {:g}, not 0: taken as 0 outside the active box (dilated by one voxel)", voxels.background));
  } else {
    report.notes.push_back(fmt::format("the background of {:g} is kept {}", voxels.background,
                                       options.clip ? "inside the clip box"
                                                    : "inside the active box; give a clip box to extend it"));
  }
}

BrickGrid buildFrom(Source source, const LoadOptions& options, LoadReport report) {
  noteBackground(source.voxels, options, report);
  if (options.clip) {
    applyClip(*options.clip, options.keepBackground, source, report);
  }
  BrickGrid grid = buildBricks(source.voxels, source.worldFromIndex, options, std::move(report));
  if (grid.empty()) {
    grid.report.notes.push_back("the grid is empty: nothing of it will be seen");
  }
  return grid;
}

} // namespace

BrickGrid loadGrid(const std::filesystem::path& path, const LoadOptions& options) {
  VdbFile file(path);
  LoadReport report;
  const GridEntry& entry = selectEntry(file, options, report);
  openvdb::GridBase::Ptr read = file.readGrid(entry, options.clip);
  return guardedRead(file.path(), [&] {
    requireScalar(file, entry, *read);
    Source source = makeSource(file, read, options.signedValues, report);
    read.reset(); // the tree is not needed any more: half the peak memory
    try {
      BrickGrid grid = buildFrom(std::move(source), options, std::move(report));
      grid.name = entry.name;
      return grid;
    } catch (const Error& problem) {
      fail("{}: grid '{}': {}", file.path(), entry.name, problem.what());
    }
  });
}

} // namespace tyndall::volume
