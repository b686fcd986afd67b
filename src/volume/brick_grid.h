// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math/bounds.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace tyndall::volume {

inline constexpr int kBrickEdge = 8;                                         ///< voxels per brick edge
inline constexpr int kBrickVoxels = kBrickEdge * kBrickEdge * kBrickEdge;    ///< voxels per brick
inline constexpr int kCoarseEdge = 4;                                        ///< bricks per coarse cell edge
inline constexpr std::uint32_t kConstantBrick = 0xffffffffu;                 ///< slot of a brick without voxels

/// How a voxel is stored on the device.
enum class Storage { Unorm8, Half, Float };

/// Bytes of one voxel.
std::size_t bytesPerVoxel(Storage storage);
const char* storageName(Storage storage);

/// Where one 8^3 brick's voxels are. Voxel value = offset + scale * stored, `stored` being the integer 0..255
/// (Unorm8) or the number itself (Half, Float, with scale 1 and offset 0). A constant brick is `offset` everywhere.
struct BrickRecord {
  std::uint32_t slot = kConstantBrick; ///< index into BrickGrid::voxels in units of kBrickVoxels
  float scale = 0.0f;
  float offset = 0.0f;
};

/// Range of the decoded density over the support of the reconstruction: voxels 8b .. 8b+8 inclusive on each axis.
struct Range {
  float min = 0.0f;
  float max = 0.0f;
  float mean = 0.0f;
};

/// What loading changed or noticed; printed as warnings and written to the statistics.
struct LoadReport {
  std::uint64_t negativeVoxels = 0;   ///< clamped to 0
  std::uint64_t nonFiniteVoxels = 0;  ///< set to 0
  double quantisationError = 0.0;     ///< worst |decoded - file| over the voxels, relative to the maximum
  double opticalDepthError = 0.0;     ///< worst relative error of the sums along index axes
  std::vector<std::string> notes;     ///< sentences: grid chosen and why, conversions, background, resampling
};

/// A scalar field on a sparse set of 8^3 bricks, decoded exactly as the device will see it.
/// Voxel values live at integer index coordinates; the field is trilinear in index space
/// (OpenVDB's BoxSampler) and 0 outside [indexMin - 1, indexMax + 1] (`background` inside that, where inactive).
struct BrickGrid {
  std::string name;
  glm::dmat4 worldFromIndex{1.0};    ///< the grid's own affine transform
  glm::ivec3 indexMin{0};            ///< active (and clipped) bounds, inclusive
  glm::ivec3 indexMax{-1};           ///< indexMax < indexMin: an empty grid
  glm::ivec3 firstVoxel{0};          ///< index coordinates of voxel 0 of brick 0; a multiple of 8
  glm::ivec3 brickCount{0};          ///< bricks per axis
  glm::ivec3 coarseCount{0};         ///< ceil(brickCount / kCoarseEdge)
  Storage storage = Storage::Float;
  std::vector<BrickRecord> bricks;   ///< x fastest; brickCount.x * y * z
  std::vector<Range> ranges;         ///< one per brick
  std::vector<float> coarseMax;      ///< one per coarse cell, x fastest: max over its bricks' ranges
  std::vector<std::byte> voxels;     ///< slots of kBrickVoxels voxels, x fastest inside a brick
  std::uint64_t activeVoxels = 0;
  LoadReport report;

  bool empty() const { return bricks.empty(); }
  std::size_t slotCount() const { return voxels.size() / (kBrickVoxels * bytesPerVoxel(storage)); }
  /// Index-space box outside of which the field is 0: [indexMin - 1, indexMax + 1].
  Bounds3 indexBounds() const;
  Bounds3 worldBounds() const { return transformed(worldFromIndex, indexBounds()); }
  /// Decoded voxel at index coordinates, 0 outside the bricks.
  float voxel(const glm::ivec3& index) const;
  /// Trilinear value at a point in index space, in double: the oracle of the device's lookups.
  double value(const glm::dvec3& index) const;
  float maximum() const;
  double deviceBytes() const; ///< atlas, records and ranges, as planned before upload
};

} // namespace tyndall::volume
