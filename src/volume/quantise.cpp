// SPDX-License-Identifier: Apache-2.0
#include "volume/quantise.h"

#include "base/error.h"
#include "volume/decode.h"
#include "volume/tables.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace tyndall::volume {
namespace {

constexpr double kLargestHalf = 65504.0;

/// Offset and scale of a brick, so that its smallest value (0 above all) is met exactly by the code 0.
BrickRecord unormRecord(const BrickGrid& exact, const BrickRecord& source) {
  float low = decodedVoxel(exact, source, 0);
  float high = low;
  for (std::size_t i = 1; i < kBrickVoxels; ++i) {
    const float value = decodedVoxel(exact, source, i);
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return {source.slot, float((double(high) - double(low)) / 255.0), low};
}

void encodeUnorm(const BrickGrid& exact, const BrickRecord& source, BrickGrid& target, BrickRecord& record) {
  record = unormRecord(exact, source);
  for (std::size_t i = 0; i < kBrickVoxels; ++i) {
    double code = 0.0;
    if (record.scale > 0.0f) { // 0 when the span underflows: the whole brick is then `offset`
      const double value = double(decodedVoxel(exact, source, i));
      code = std::clamp(std::round((value - double(record.offset)) / double(record.scale)), 0.0, 255.0);
    }
    target.voxels[std::size_t(source.slot) * kBrickVoxels + i] = std::byte(int(code));
  }
}

void encodeHalf(const BrickGrid& exact, const BrickRecord& source, BrickGrid& target) {
  for (std::size_t i = 0; i < kBrickVoxels; ++i) {
    const std::uint16_t bits = glm::packHalf1x16(decodedVoxel(exact, source, i));
    std::memcpy(target.voxels.data() + 2 * (std::size_t(source.slot) * kBrickVoxels + i), &bits, sizeof bits);
  }
}

} // namespace

BrickGrid encoded(const BrickGrid& exact, Storage storage) {
  TYNDALL_CHECK(exact.storage == Storage::Float);
  if (storage == Storage::Float) {
    return exact;
  }
  const double reach = largestMagnitude(exact);
  if (storage == Storage::Half && reach > kLargestHalf) {
    fail("grid '{}' reaches {:g}, half holds at most {:g}; use \"storage\": \"float\" or \"auto\"", exact.name,
         reach, kLargestHalf);
  }
  BrickGrid target;
  target.name = exact.name;
  target.worldFromIndex = exact.worldFromIndex;
  target.indexMin = exact.indexMin;
  target.indexMax = exact.indexMax;
  target.firstVoxel = exact.firstVoxel;
  target.brickCount = exact.brickCount;
  target.storage = storage;
  target.bricks = exact.bricks;
  target.voxels.resize(exact.slotCount() * kBrickVoxels * bytesPerVoxel(storage));
  target.activeVoxels = exact.activeVoxels;
  target.report = exact.report;
  tbb::parallel_for(std::size_t(0), exact.bricks.size(), [&](std::size_t b) {
    const BrickRecord& source = exact.bricks[b];
    if (source.slot == kConstantBrick) {
      return;
    }
    if (storage == Storage::Unorm8) {
      encodeUnorm(exact, source, target, target.bricks[b]);
    } else {
      encodeHalf(exact, source, target);
    }
  });
  return target;
}

BrickGrid quantised(BrickGrid exact, const LoadOptions& options) {
  BrickGrid chosen;
  bool found = false;
  const ErrorReference reference(exact);
  for (const Storage storage : {Storage::Unorm8, Storage::Half}) {
    const bool wanted = options.storage ? *options.storage == storage
                                        : storage != Storage::Half || reference.largest() <= kLargestHalf;
    if (!wanted || found) {
      continue;
    }
    BrickGrid candidate = encoded(exact, storage);
    const QuantisationError error = reference.errorOf(candidate);
    const bool within = error.voxel <= options.tolerance && error.opticalDepth <= options.opticalDepthTolerance;
    if (options.storage || within) {
      candidate.report.quantisationError = error.voxel;
      candidate.report.opticalDepthError = error.opticalDepth;
      chosen = std::move(candidate);
      found = true;
    }
  }
  if (!found) {
    chosen = std::move(exact);
  }
  buildTables(chosen);
  return chosen;
}

} // namespace tyndall::volume
