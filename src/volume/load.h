// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "volume/brick_grid.h"

#include <filesystem>
#include <map>
#include <optional>

namespace tyndall::volume {

/// One grid of a file, whether it can be rendered or not.
struct GridInfo {
  std::string name;
  std::string type;           ///< "float", "half" (stored as half), "double", "int32", "vec3s", "points", ...
  std::string gridClass;      ///< "fog volume", "level set", "unknown", ...
  std::string transform;      ///< "uniform scale 0.1", "affine", "frustum", ...
  glm::dmat4 worldFromIndex{1.0};
  glm::dvec3 voxelSize{1.0};
  glm::ivec3 indexMin{0};     ///< active bounds, inclusive
  glm::ivec3 indexMax{-1};
  std::uint64_t activeVoxels = 0;
  std::uint64_t activeTiles = 0;
  std::uint64_t leafBricks = 0;
  double minValue = 0.0;      ///< over active finite values (scalar grids)
  double maxValue = 0.0;
  double background = 0.0;
  bool scalar = false;        ///< can be rendered as density or emission
  std::string whyNot;         ///< when !scalar: what it is, in words
  std::vector<std::string> warnings;

  bool empty() const { return activeVoxels == 0 && activeTiles == 0; }
};

struct FileInfo {
  std::string path;
  std::string version;                              ///< file format, e.g. "v224"
  std::map<std::string, std::string> metadata;
  std::vector<GridInfo> grids;
};

/// What a .vdb holds. Never throws on files that hold nothing to render.
/// @throws Error if the file is missing, truncated or not a VDB, with what to do.
FileInfo inspectFile(const std::filesystem::path& path);

/// The grids that a picture of a bare file would use.
struct GridChoice {
  std::string density;                 ///< empty: nothing to render as density
  std::string temperature;             ///< empty: no emission
  std::string reason;                  ///< a sentence for the user
};
/// density/soot/smoke names first, then fog class, then the only or largest scalar grid; level sets count as fog.
/// temperature/heat/flame/... names as emission. @throws Error naming the grids when none is scalar.
GridChoice chooseGrids(const FileInfo& info);

struct LoadOptions {
  std::string grid;                             ///< by name; empty = chooseGrids' density
  std::optional<Storage> storage;               ///< nullopt = narrowest within the tolerance
  double tolerance = 1.0 / 400.0;               ///< worst voxel error, relative to the maximum
  double opticalDepthTolerance = 0.01;          ///< worst relative error of sums along the index axes
  std::optional<Bounds3> clip;                  ///< in the grid's world space; clipped before bricks are made
  bool keepBackground = false;                  ///< use the file's background value inside the bounds
  bool signedValues = false;                    ///< keep negative values (temperature in Celsius, test fields)
};

/// Reads one grid. Level sets become fog; frustum transforms are resampled; tiles become constant bricks;
/// NaN and Inf become 0, negative values 0, both counted in the report. An empty grid gives an empty BrickGrid
/// with a note. @throws Error naming the grids that are there, and the nearest, if `grid` is not.
BrickGrid loadGrid(const std::filesystem::path& path, const LoadOptions& options);

/// A brick grid from dense decoded values (x fastest), for tests and generators; same tables as loadGrid makes.
BrickGrid gridFromDense(const std::vector<float>& values, const glm::ivec3& size, const glm::ivec3& indexMin,
                        const glm::dmat4& worldFromIndex, Storage storage = Storage::Float);

} // namespace tyndall::volume
