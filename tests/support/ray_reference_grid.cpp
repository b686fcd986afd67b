// SPDX-License-Identifier: Apache-2.0
#include "support/ray_reference_grid.h"

#include "base/error.h"

#include <tbb/parallel_for.h>

#include <numbers>

namespace tyndall::test {
namespace {

constexpr int kBrick = volume::kBrickEdge;
constexpr int kEdge = DecodedGrid::kEdge;

} // namespace

OracleRay through(const glm::dmat4& map, const OracleRay& ray) {
  return {glm::dvec3(map * glm::dvec4(ray.origin, 1.0)), glm::dmat3(map) * ray.direction};
}

double cellDepth(const float* corners, const OracleRay& inCell, double t0, double t1) {
  // The density is a cubic in t, which two Gauss points integrate exactly.
  const double half = 0.5 * (t1 - t0);
  const double offset = half / std::numbers::sqrt3;
  const double middle = 0.5 * (t0 + t1);
  return half * (DecodedGrid::densityIn(corners, pointAt(inCell, middle - offset)) +
                 DecodedGrid::densityIn(corners, pointAt(inCell, middle + offset)));
}

DecodedGrid::DecodedGrid(const volume::BrickGrid& grid) : bounds_(grid.indexBounds()) {
  if (grid.empty()) {
    return;
  }
  firstBrick_ = glm::ivec3(glm::floor(bounds_.min / double(kBrick)));
  brickCount_ = glm::ivec3(glm::ceil(bounds_.max / double(kBrick))) - firstBrick_;
  std::vector<float> support(std::size_t(kEdge * kEdge * kEdge));
  for (int b = 0; b < brickCount_.x * brickCount_.y * brickCount_.z; ++b) {
    const glm::ivec3 brick(b % brickCount_.x, b / brickCount_.x % brickCount_.y, b / brickCount_.x / brickCount_.y);
    for (int i = 0; i < kEdge * kEdge * kEdge; ++i) {
      support[std::size_t(i)] =
          grid.voxel(kBrick * (firstBrick_ + brick) + glm::ivec3(i % kEdge, i / kEdge % kEdge, i / kEdge / kEdge));
    }
    const bool zero = std::all_of(support.begin(), support.end(), [](float v) { return v == 0.0f; });
    supports_.push_back(zero ? -1 : int(values_.size() / support.size()));
    values_.insert(values_.end(), support.begin(), zero ? support.begin() : support.end());
  }
}

const float* DecodedGrid::support(const glm::ivec3& brick) const {
  const glm::ivec3 b = brick - firstBrick_;
  const int at = supports_[std::size_t(b.x + brickCount_.x * (b.y + brickCount_.y * b.z))];
  return at < 0 ? nullptr : values_.data() + std::size_t(at) * kEdge * kEdge * kEdge;
}

const float* DecodedGrid::corners(const glm::ivec3& cell) const {
  const float* values = support(cell >> 3);
  const glm::ivec3 inside = cell & 7;
  return values == nullptr ? nullptr : values + inside.x + kEdge * (inside.y + kEdge * inside.z);
}

double DecodedGrid::depth(const OracleRay& index, double tMax, double enough) const {
  double sum = 0.0;
  const auto visitBrick = [&](const glm::ivec3& brick, double t0, double t1) {
    const float* values = support(brick);
    if (values == nullptr) {
      return true;
    }
    const glm::ivec3 low = kBrick * brick;
    const auto visitCell = [&](const glm::ivec3& cell, double a, double b) {
      const glm::ivec3 inside = cell - low;
      const OracleRay inCell{index.origin - glm::dvec3(cell), index.direction};
      sum += cellDepth(values + inside.x + kEdge * (inside.y + kEdge * inside.z), inCell, a, b);
      return true;
    };
    walkCells(index, low, low + kBrick, 1, {t0, t1}, visitCell);
    return sum < enough;
  };
  if (!bounds_.empty()) {
    walkCells(index, firstBrick_, firstBrick_ + brickCount_, kBrick, spanInBox(index, bounds_, tMax), visitBrick);
  }
  return sum;
}

std::vector<double> opticalDepths(const volume::BrickGrid& grid, const glm::dmat4& rayFromIndex,
                                  std::span<const OracleRay> rays, std::span<const double> tMax) {
  if (!tMax.empty() && tMax.size() != rays.size()) {
    fail("opticalDepths: {} values of tMax for {} rays; give one per ray or none", tMax.size(), rays.size());
  }
  const DecodedGrid decoded(grid);
  const glm::dmat4 indexFromRay = glm::inverse(rayFromIndex);
  std::vector<double> depths(rays.size());
  tbb::parallel_for(std::size_t(0), rays.size(), [&](std::size_t i) {
    depths[i] =
        decoded.depth(through(indexFromRay, rays[i]), tMax.empty() ? std::numeric_limits<double>::infinity() : tMax[i]);
  });
  return depths;
}

} // namespace tyndall::test
