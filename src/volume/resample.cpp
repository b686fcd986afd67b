// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "volume/vdb_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace tyndall::volume {
namespace {

constexpr int kMaxResampled = 512; ///< voxels along the longest axis

openvdb::BBoxd dilatedActiveBox(const openvdb::GridBase& grid) {
  const openvdb::CoordBBox active = grid.evalActiveVoxelBoundingBox();
  return {active.min().asVec3d() - 1.0, active.max().asVec3d() + 1.0};
}

/// Trilinear value at a point in index space, in double whatever the grid's own type. NaN and Inf count as 0.
template <class Accessor> double sampleTrilinear(const Accessor& accessor, const openvdb::Vec3d& index) {
  const openvdb::Coord corner = openvdb::Coord::floor(index);
  const openvdb::Vec3d f = index - corner.asVec3d();
  double sum = 0.0;
  for (int i = 0; i < 8; ++i) {
    const openvdb::Coord at = corner.offsetBy(i & 1, (i >> 1) & 1, i >> 2);
    const double weight = ((i & 1) != 0 ? f.x() : 1.0 - f.x()) * ((i & 2) != 0 ? f.y() : 1.0 - f.y()) *
                          ((i & 4) != 0 ? f.z() : 1.0 - f.z());
    const double value = double(accessor.getValue(at));
    sum += std::isfinite(value) ? weight * value : 0.0;
  }
  return sum;
}

template <class GridT>
std::array<float, kBrickVoxels> sampleBlock(const GridT& grid, const openvdb::BBoxd& domain, const ResamplePlan& plan,
                                            const glm::ivec3& origin) {
  const auto accessor = grid.getConstAccessor();
  std::array<float, kBrickVoxels> block{};
  for (int i = 0; i < kBrickVoxels; ++i) {
    const glm::dvec3 target(origin + glm::ivec3(i & 7, (i >> 3) & 7, i >> 6));
    const glm::dvec3 world(plan.worldFromIndex * glm::dvec4(target, 1.0));
    const openvdb::Vec3d index = grid.transform().worldToIndex(openvdb::Vec3d(world.x, world.y, world.z));
    if (domain.isInside(index)) { // false for NaN, and for what lies behind the frustum's apex
      block[std::size_t(i)] = float(sampleTrilinear(accessor, index));
    }
  }
  return block;
}

void extendBounds(SparseVoxels& result, const glm::ivec3& index) {
  const bool first = result.activeVoxels++ == 0;
  result.indexMin = first ? index : glm::min(result.indexMin, index);
  result.indexMax = first ? index : glm::max(result.indexMax, index);
}

template <class GridT> SparseVoxels sampleAll(const GridT& grid, const ResamplePlan& plan, bool signedValues) {
  const openvdb::BBoxd domain = dilatedActiveBox(grid);
  const glm::ivec3 blocks = plan.indexMax / kBrickEdge + 1;
  std::vector<std::vector<std::pair<glm::ivec3, std::array<float, kBrickVoxels>>>> layers(std::size_t(blocks.z));
  tbb::parallel_for(0, blocks.z, [&](int z) {
    for (int y = 0; y < blocks.y; ++y) {
      for (int x = 0; x < blocks.x; ++x) {
        const glm::ivec3 origin = kBrickEdge * glm::ivec3(x, y, z);
        const auto block = sampleBlock(grid, domain, plan, origin);
        if (std::any_of(block.begin(), block.end(), [](float v) { return v != 0.0f; })) {
          layers[std::size_t(z)].emplace_back(origin, block);
        }
      }
    }
  });
  SparseVoxels result;
  Sanitiser sanitise{.signedValues = signedValues};
  for (const auto& layer : layers) {
    for (const auto& [origin, block] : layer) {
      result.leafOrigins.push_back(origin);
      for (int i = 0; i < kBrickVoxels; ++i) {
        result.leafValues.push_back(sanitise(double(block[std::size_t(i)]), 1));
        if (result.leafValues.back() != 0.0f) {
          extendBounds(result, origin + glm::ivec3(i & 7, (i >> 3) & 7, i >> 6));
        }
      }
    }
  }
  result.negativeVoxels = sanitise.negative;
  result.nonFiniteVoxels = sanitise.nonFinite;
  return result;
}

} // namespace

ResamplePlan planResampling(const openvdb::GridBase& grid) {
  ResamplePlan plan;
  if (grid.baseTree().activeVoxelCount() == 0) {
    return plan;
  }
  const openvdb::BBoxd index = dilatedActiveBox(grid);
  Bounds3 world; // the map keeps straight lines straight: corners bound it
  for (int i = 0; i < 8; ++i) {
    const openvdb::Vec3d corner((i & 1) != 0 ? index.max().x() : index.min().x(),
                                (i & 2) != 0 ? index.max().y() : index.min().y(),
                                (i & 4) != 0 ? index.max().z() : index.min().z());
    const openvdb::Vec3d at = grid.transform().indexToWorld(corner);
    world.extend(glm::dvec3(at.x(), at.y(), at.z()));
  }
  const openvdb::Vec3d own = grid.transform().voxelSize(0.5 * (index.min() + index.max()));
  const double longest = std::max({world.size().x, world.size().y, world.size().z});
  const double voxel = std::max(std::min({own.x(), own.y(), own.z()}), longest / (kMaxResampled - 1));
  if (!(voxel > 0.0) || !std::isfinite(voxel) || !std::isfinite(longest)) {
    fail("grid '{}' has a frustum transform that cannot be inverted; export it with an affine one", grid.getName());
  }
  plan.worldFromIndex = glm::dmat4(voxel);
  plan.worldFromIndex[3] = glm::dvec4(world.min, 1.0);
  plan.indexMax = glm::ivec3(glm::ceil(world.size() / voxel));
  return plan;
}

SparseVoxels resampled(const openvdb::GridBase& grid, const ResamplePlan& plan, bool signedValues) {
  SparseVoxels result;
  const bool scalar = withScalarGrid(grid, [&](const auto& typed) {
    if (!typed.empty()) {
      result = sampleAll(typed, plan, signedValues);
    }
  });
  TYNDALL_CHECK(scalar);
  return result;
}

} // namespace tyndall::volume
