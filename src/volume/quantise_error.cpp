// SPDX-License-Identifier: Apache-2.0
#include "volume/decode.h"
#include "volume/quantise.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tyndall::volume {
namespace {

constexpr int kColumnLines = kBrickEdge * kBrickEdge;

/// Max over i in [0, count) of measure(i), in parallel; 0 if count is 0. A maximum does not depend on the order.
template <class Measure> double parallelMax(std::size_t count, const Measure& measure) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, count, 16), 0.0,
      [&](const tbb::blocked_range<std::size_t>& range, double worst) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          worst = std::max(worst, measure(i));
        }
        return worst;
      },
      [](double a, double b) { return std::max(a, b); });
}

/// Every slot's voxels, decoded.
std::vector<float> decodedSlots(const BrickGrid& grid) {
  std::vector<float> values(grid.slotCount() * kBrickVoxels);
  tbb::parallel_for(std::size_t(0), grid.bricks.size(), [&](std::size_t b) {
    const BrickRecord& record = grid.bricks[b];
    for (std::size_t i = 0; record.slot != kConstantBrick && i < kBrickVoxels; ++i) {
      values[std::size_t(record.slot) * kBrickVoxels + i] = decodedVoxel(grid, record, i);
    }
  });
  return values;
}

/// Along the 64 lines of a column of bricks: sums of |exact| and of decoded - exact.
struct ColumnSums {
  std::array<double, kColumnLines> magnitude{};
  std::array<double, kColumnLines> error{};
};

/// Columns of bricks parallel to `axis`. `other` may be null: no errors are summed then.
class Columns {
public:
  Columns(const BrickGrid& exact, const float* values, const float* other, int axis)
      : exact_(exact), values_(values), other_(other), axis_(axis), u_((axis + 1) % 3), v_((axis + 2) % 3) {}

  std::size_t count() const { return std::size_t(exact_.brickCount[u_]) * std::size_t(exact_.brickCount[v_]); }

  ColumnSums sums(std::size_t column) const {
    ColumnSums sums;
    glm::ivec3 brick(0);
    brick[u_] = int(column % std::size_t(exact_.brickCount[u_]));
    brick[v_] = int(column / std::size_t(exact_.brickCount[u_]));
    for (brick[axis_] = 0; brick[axis_] < exact_.brickCount[axis_]; ++brick[axis_]) {
      const std::size_t row = std::size_t(brick.y) + std::size_t(exact_.brickCount.y) * std::size_t(brick.z);
      add(exact_.bricks[std::size_t(brick.x) + std::size_t(exact_.brickCount.x) * row], sums);
    }
    return sums;
  }

private:
  void add(const BrickRecord& record, ColumnSums& sums) const {
    if (record.slot == kConstantBrick) { // stored the same in every storage: no error
      for (std::size_t line = 0; line < kColumnLines && record.offset != 0.0f; ++line) {
        sums.magnitude[line] += kBrickEdge * std::abs(double(record.offset));
      }
      return;
    }
    const float* exact = values_ + std::size_t(record.slot) * kBrickVoxels;
    const float* other = other_ == nullptr ? exact : other_ + std::size_t(record.slot) * kBrickVoxels;
    for (int i = 0; i < kBrickVoxels; ++i) {
      const std::array at{i & 7, (i >> 3) & 7, i >> 6};
      const std::size_t line = std::size_t(at[std::size_t(u_)] + kBrickEdge * at[std::size_t(v_)]);
      sums.magnitude[line] += std::abs(double(exact[i]));
      sums.error[line] += double(other[i]) - double(exact[i]);
    }
  }

  const BrickGrid& exact_;
  const float* values_;
  const float* other_;
  int axis_;
  int u_;
  int v_;
};

} // namespace

double largestMagnitude(const BrickGrid& grid) {
  return parallelMax(grid.bricks.size(), [&](std::size_t b) {
    const BrickRecord& record = grid.bricks[b];
    double largest = 0.0;
    for (int i = 0; i < (record.slot == kConstantBrick ? 1 : kBrickVoxels); ++i) {
      largest = std::max(largest, std::abs(double(decodedVoxel(grid, record, std::size_t(i)))));
    }
    return largest;
  });
}

ErrorReference::ErrorReference(const BrickGrid& exact)
    : exact_(exact), values_(decodedSlots(exact)), largest_(largestMagnitude(exact)) {
  for (int axis = 0; axis < 3; ++axis) {
    const Columns columns(exact_, values_.data(), nullptr, axis);
    thickest_[axis] = parallelMax(columns.count(), [&](std::size_t c) {
      const ColumnSums sums = columns.sums(c);
      return *std::max_element(sums.magnitude.begin(), sums.magnitude.end());
    });
  }
}

QuantisationError ErrorReference::errorOf(const BrickGrid& other) const {
  QuantisationError error;
  if (largest_ == 0.0) {
    return error;
  }
  const std::vector<float> decoded = decodedSlots(other);
  error.voxel = parallelMax(decoded.size(), [&](std::size_t i) {
    return std::abs(double(decoded[i]) - double(values_[i]));
  }) / largest_;
  for (int axis = 0; axis < 3 && error.voxel > 0.0; ++axis) {
    const Columns columns(exact_, values_.data(), decoded.data(), axis);
    const double threshold = kLineThreshold * thickest_[axis];
    error.opticalDepth = std::max(error.opticalDepth, parallelMax(columns.count(), [&](std::size_t c) {
      const ColumnSums sums = columns.sums(c);
      double worst = 0.0;
      for (std::size_t line = 0; line < kColumnLines; ++line) {
        if (sums.magnitude[line] > 0.0 && sums.magnitude[line] >= threshold) {
          worst = std::max(worst, std::abs(sums.error[line]) / sums.magnitude[line]);
        }
      }
      return worst;
    }));
  }
  return error;
}

} // namespace tyndall::volume
