// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "volume/vdb_grid.h"

#include <openvdb/tools/LevelSetUtil.h>

#include <tbb/parallel_for.h>

#include <atomic>

namespace tyndall::volume {
namespace {

/// Leaf voxel i of ours (x fastest) is theirs (z fastest) with x and z swapped.
constexpr openvdb::Index leafOffset(int i) {
  return openvdb::Index(((i & 7) << 6) | (i & 0x38) | (i >> 6));
}

template <class TreeT> void extractLeaves(const TreeT& tree, Sanitiser& counts, SparseVoxels& result) {
  using Leaf = typename TreeT::LeafNodeType;
  static_assert(Leaf::DIM == kBrickEdge);
  std::vector<const Leaf*> leaves;
  tree.getNodes(leaves);
  result.leafOrigins.resize(leaves.size());
  result.leafValues.resize(leaves.size() * kBrickVoxels);
  std::atomic<std::uint64_t> negative{0};
  std::atomic<std::uint64_t> nonFinite{0};
  tbb::parallel_for(std::size_t(0), leaves.size(), [&](std::size_t l) {
    const Leaf& leaf = *leaves[l];
    Sanitiser sanitise{.signedValues = counts.signedValues};
    result.leafOrigins[l] = toGlm(leaf.origin());
    for (int i = 0; i < kBrickVoxels; ++i) {
      const openvdb::Index offset = leafOffset(i);
      result.leafValues[l * kBrickVoxels + std::size_t(i)] =
          sanitise(double(leaf.getValue(offset)), leaf.isValueOn(offset) ? 1 : 0);
    }
    negative += sanitise.negative;
    nonFinite += sanitise.nonFinite;
  });
  counts.negative += negative;
  counts.nonFinite += nonFinite;
}

template <class TreeT> void extractTiles(const TreeT& tree, Sanitiser& counts, SparseVoxels& result) {
  auto tile = tree.cbeginValueAll();
  tile.setMaxDepth(TreeT::ValueAllCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    const openvdb::CoordBBox box = tile.getBoundingBox();
    const std::uint64_t voxels = tile.isValueOn() ? box.volume() : 0;
    const float value = counts(double(*tile), voxels);
    if (value != result.background) {
      result.tiles.push_back({toGlm(box.min()), toGlm(box.max()), value});
    }
  }
}

template <class GridT> SparseVoxels extract(const GridT& grid, bool signedValues) {
  SparseVoxels result;
  Sanitiser counts{.signedValues = signedValues};
  result.background = counts(double(grid.background()), 0);
  const auto& tree = grid.constTree();
  openvdb::CoordBBox active;
  if (tree.evalActiveVoxelBoundingBox(active)) {
    result.indexMin = toGlm(active.min());
    result.indexMax = toGlm(active.max());
    result.activeVoxels = tree.activeVoxelCount();
    extractLeaves(tree, counts, result);
    extractTiles(tree, counts, result);
  }
  result.negativeVoxels = counts.negative;
  result.nonFiniteVoxels = counts.nonFinite;
  return result;
}

template <class GridT> openvdb::GridBase::Ptr fogOf(const GridT& grid) {
  typename GridT::Ptr fog = grid.deepCopy();
  openvdb::tools::sdfToFogVolume(*fog);
  return fog;
}

} // namespace

SparseVoxels extractVoxels(const openvdb::GridBase& grid, bool signedValues) {
  SparseVoxels result;
  const bool scalar = withScalarGrid(grid, [&](const auto& typed) { result = extract(typed, signedValues); });
  TYNDALL_CHECK(scalar);
  return result;
}

openvdb::GridBase::Ptr fogOfLevelSet(const openvdb::GridBase& grid) {
  if (grid.isType<openvdb::FloatGrid>()) {
    return fogOf(static_cast<const openvdb::FloatGrid&>(grid));
  }
  if (grid.isType<openvdb::DoubleGrid>()) {
    return fogOf(static_cast<const openvdb::DoubleGrid&>(grid));
  }
  return nullptr;
}

} // namespace tyndall::volume
