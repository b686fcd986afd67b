// SPDX-License-Identifier: Apache-2.0
#include "volume/brick_grid.h"

#include "volume/decode.h"

#include <algorithm>
#include <cmath>

namespace tyndall::volume {

std::size_t bytesPerVoxel(Storage storage) {
  switch (storage) {
  case Storage::Unorm8: return 1;
  case Storage::Half: return 2;
  case Storage::Float: return 4;
  }
  return 4;
}

const char* storageName(Storage storage) {
  switch (storage) {
  case Storage::Unorm8: return "unorm8";
  case Storage::Half: return "half";
  case Storage::Float: return "float";
  }
  return "float";
}

Bounds3 BrickGrid::indexBounds() const {
  Bounds3 bounds;
  if (!empty()) {
    bounds.min = glm::dvec3(indexMin) - 1.0;
    bounds.max = glm::dvec3(indexMax) + 1.0;
  }
  return bounds;
}

float BrickGrid::voxel(const glm::ivec3& index) const {
  const glm::ivec3 local = index - firstVoxel;
  const glm::ivec3 brick = local >> 3;
  if (glm::any(glm::lessThan(local, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(brick, brickCount))) {
    return 0.0f;
  }
  const std::size_t b = brick.x + std::size_t(brickCount.x) * (brick.y + std::size_t(brickCount.y) * brick.z);
  const glm::ivec3 inside = local & 7;
  return decodedVoxel(*this, bricks[b], std::size_t(inside.x + kBrickEdge * (inside.y + kBrickEdge * inside.z)));
}

double BrickGrid::value(const glm::dvec3& index) const {
  const Bounds3 bounds = indexBounds();
  const bool inside = glm::all(glm::greaterThanEqual(index, bounds.min)) &&
                      glm::all(glm::lessThanEqual(index, bounds.max)); // false for NaN
  if (!inside) {
    return 0.0;
  }
  const glm::dvec3 corner = glm::floor(index);
  const glm::dvec3 fraction = index - corner;
  const glm::ivec3 first(corner);
  double sum = 0.0;
  for (int i = 0; i < 8; ++i) {
    const glm::ivec3 offset(i & 1, (i >> 1) & 1, i >> 2);
    const glm::dvec3 weights = glm::mix(1.0 - fraction, fraction, glm::dvec3(offset));
    const double weight = weights.x * weights.y * weights.z;
    if (weight > 0.0) {
      sum += weight * double(voxel(first + offset));
    }
  }
  return sum;
}

float BrickGrid::maximum() const {
  float result = 0.0f;
  bool first = true;
  for (const BrickRecord& record : bricks) {
    const int count = record.slot == kConstantBrick ? 1 : kBrickVoxels;
    for (int i = 0; i < count; ++i) {
      const float value = decodedVoxel(*this, record, std::size_t(i));
      result = first ? value : std::max(result, value);
      first = false;
    }
  }
  return result;
}

double BrickGrid::deviceBytes() const {
  return double(voxels.size()) + double(bricks.size()) * sizeof(BrickRecord) +
         double(ranges.size()) * sizeof(Range) + double(coarseMax.size()) * sizeof(float);
}

} // namespace tyndall::volume
