// SPDX-License-Identifier: Apache-2.0
#include "geometry/bvh_split.h"

#include "interop/surfaces.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>

namespace tyndall::geometry {
namespace {

constexpr std::size_t kBins = 16;
constexpr std::uint32_t kUsualLeaf = 4; // measured: `tyndall_microbench rays`
constexpr double kNodeCost = 2.0;       // of a step into a node, in tests of a primitive; measured as well, and flat
constexpr std::uint32_t kSerialCount = 4096; // references below which a task costs more than it gains

/// Twice the centre: exact more often than half of it, and as good for sorting.
glm::vec3 twiceCentre(const BvhReference& reference) { return reference.box.min + reference.box.max; }

struct Split {
  int axis = -1; ///< -1: none
  float low = 0; ///< of twice the centres
  float scale = 0;
  std::size_t bin = 0; ///< the first bin of the second child
  double cost = std::numeric_limits<double>::infinity();
};

std::size_t binOf(const BvhReference& reference, const Split& split) {
  const float position = (twiceCentre(reference)[split.axis] - split.low) * split.scale;
  return std::min(static_cast<std::size_t>(std::max(position, 0.0f)), kBins - 1);
}

struct Bin {
  Box box;
  std::uint32_t count = 0;
};

/// The cheapest of an axis' splits that leave no more than `largestChild` references on either side.
void tryAxis(std::span<const BvhReference> references, Split axis, std::uint32_t largestChild, Split& best) {
  std::array<Bin, kBins> bins{};
  for (const BvhReference& reference : references) {
    Bin& bin = bins[binOf(reference, axis)];
    bin.box.extend(reference.box);
    ++bin.count;
  }
  std::array<Bin, kBins> above{}; // of bins i and more
  for (std::size_t i = kBins; i-- > 0;) {
    above[i] = bins[i];
    if (i + 1 < kBins) {
      above[i].box.extend(above[i + 1].box);
      above[i].count += above[i + 1].count;
    }
  }
  Bin below;
  for (std::size_t i = 1; i < kBins; ++i) {
    below.box.extend(bins[i - 1].box);
    below.count += bins[i - 1].count;
    if (below.count == 0 || above[i].count == 0 || std::max(below.count, above[i].count) > largestChild) {
      continue;
    }
    axis.cost = below.box.area() * below.count + above[i].box.area() * above[i].count;
    axis.bin = i;
    if (axis.cost < best.cost) {
      best = axis;
    }
  }
}

class Builder {
public:
  Builder(std::span<BvhReference> references, std::vector<BinaryNode>& nodes)
      : references_(references), nodes_(nodes) {}

  /// Builds the subtree of `count` references into the 2 count - 1 nodes from `node` on.
  void build(std::uint32_t node, std::uint32_t first, std::uint32_t count, std::uint32_t levels) {
    const std::span<BvhReference> mine = references_.subspan(first, count);
    Box box;
    Box centres; // of twice the centres
    for (const BvhReference& reference : mine) {
      box.extend(reference.box);
      centres.extend({twiceCentre(reference), twiceCentre(reference)});
    }
    nodes_[node] = {box, first, count, 0};
    const std::uint32_t left = chooseSplit(mine, box, centres, levels);
    if (left == 0) {
      return;
    }
    const std::uint32_t second = node + 2 * left;
    nodes_[node].second = second;
    const auto one = [&] { build(node + 1, first, left, levels - 1); };
    const auto other = [&] { build(second, first + left, count - left, levels - 1); };
    if (count > kSerialCount) {
      tbb::parallel_invoke(one, other);
    } else {
      one();
      other();
    }
  }

private:
  /// Moves the first child's references to the front. @return how many they are; 0: a leaf.
  static std::uint32_t chooseSplit(std::span<BvhReference> mine, const Box& box, const Box& centres,
                                   std::uint32_t levels) {
    const auto count = static_cast<std::uint32_t>(mine.size());
    if (count == 1 || levels == 0) {
      return 0;
    }
    // 64 bits: what a deep tree may hold exceeds 32.
    const std::uint64_t capacity = std::uint64_t(interop::kBvhLargestLeaf) << (levels - 1);
    const auto largestChild = static_cast<std::uint32_t>(std::min<std::uint64_t>(capacity, count));
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      const float extent = centres.max[axis] - centres.min[axis];
      const float scale = float(kBins) / extent;
      if (extent > 0.0f && scale < std::numeric_limits<float>::infinity()) {
        tryAxis(mine, {.axis = axis, .low = centres.min[axis], .scale = scale}, largestChild, best);
      }
    }
    const bool splitPays = best.axis >= 0 && kNodeCost * box.area() + best.cost < box.area() * count;
    if (count <= kUsualLeaf && !splitPays) {
      return 0;
    }
    if (best.axis >= 0) {
      const auto middle = std::partition(mine.begin(), mine.end(),
                                         [&](const BvhReference& each) { return binOf(each, best) < best.bin; });
      return static_cast<std::uint32_t>(middle - mine.begin());
    }
    return count <= interop::kBvhLargestLeaf ? 0 : splitInTheMiddle(mine, centres);
  }

  /// Where bins cannot tell references apart, or would make the tree too deep.
  static std::uint32_t splitInTheMiddle(std::span<BvhReference> mine, const Box& centres) {
    const glm::vec3 extent = centres.max - centres.min;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
    const auto middle = mine.begin() + static_cast<std::ptrdiff_t>(mine.size() / 2);
    std::nth_element(mine.begin(), middle, mine.end(), [axis](const BvhReference& a, const BvhReference& b) {
      const float left = twiceCentre(a)[axis];
      const float right = twiceCentre(b)[axis];
      return left < right || (left == right && a.input < b.input);
    });
    return static_cast<std::uint32_t>(mine.size() / 2);
  }

  std::span<BvhReference> references_;
  std::vector<BinaryNode>& nodes_;
};

} // namespace

double Box::area() const {
  if (min.x > max.x) {
    return 0.0;
  }
  const glm::dvec3 size = glm::dvec3(max) - glm::dvec3(min);
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

std::vector<BinaryNode> splitReferences(std::span<BvhReference> references, std::uint32_t levels) {
  std::vector<BinaryNode> nodes;
  if (!references.empty()) {
    nodes.resize(2 * references.size() - 1);
    Builder(references, nodes).build(0, 0, static_cast<std::uint32_t>(references.size()), levels);
  }
  return nodes;
}

} // namespace tyndall::geometry
