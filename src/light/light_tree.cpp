// SPDX-License-Identifier: Apache-2.0
#include "light/light_tree.h"

#include "base/error.h"
#include "math/colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace tyndall::light {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kBins = 12; // per axis

/// Bounds of some emitters, with angles where LightBounds has cosines. Without power it is empty.
struct Part {
  Bounds3 box;
  glm::dvec3 axis{0.0, 0.0, 1.0};
  double normals = 0.0;
  double emission = 0.0;
  double power = 0.0;
  std::uint32_t count = 0;
  std::uint32_t emitter = 0; ///< where it is one
};

Part partOf(const LightBounds& bounds, std::uint32_t emitter) {
  return {bounds.box,
          bounds.axis,
          std::acos(std::clamp(bounds.cosNormals, -1.0, 1.0)),
          std::acos(std::clamp(bounds.cosEmission, -1.0, 1.0)),
          bounds.power,
          1,
          emitter};
}

/// The smallest cone about two cones. @see [Conty18]
void uniteCones(Part& a, const Part& b) {
  const Part& wide = a.normals >= b.normals ? a : b;
  const Part& narrow = a.normals >= b.normals ? b : a;
  const glm::dvec3 axis = wide.axis;
  const double cosine = std::clamp(glm::dot(wide.axis, narrow.axis), -1.0, 1.0);
  const double wideNormals = wide.normals;
  const double between = wideNormals >= kPi ? 0.0 : std::acos(cosine);
  if (between + narrow.normals <= wideNormals) {
    a.axis = axis;
    a.normals = wideNormals;
    return;
  }
  const double normals = 0.5 * (wideNormals + between + narrow.normals);
  const glm::dvec3 across = narrow.axis - cosine * axis;
  const double length = glm::length(across);
  if (normals >= kPi || length < 1e-9) { // opposite axes have no plane to turn in
    a.axis = axis;
    a.normals = length < 1e-9 && cosine > 0.0 ? std::min(kPi, normals) : kPi;
    return;
  }
  const double turn = normals - wideNormals;
  a.axis = glm::normalize(std::cos(turn) * axis + std::sin(turn) / length * across);
  a.normals = normals;
}

void unite(Part& a, const Part& b) {
  if (a.count == 0 || b.count == 0) {
    a = a.count == 0 ? b : a;
    return;
  }
  uniteCones(a, b);
  a.box.extend(b.box);
  a.emission = std::max(a.emission, b.emission);
  a.power += b.power;
  a.count += b.count;
}

/// Power times area times solid angle: what a split should make small. The surface area orientation heuristic of
/// [Conty18].
double measure(const Part& part) {
  if (part.count == 0) {
    return 0.0;
  }
  const glm::dvec3 size = part.box.size();
  // The square of the diagonal tells lights along a line apart, whose boxes have no area.
  const double area = 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x) + 1e-3 * glm::dot(size, size);
  if (part.normals >= kPi) {
    return part.power * area * 4.0 * kPi;
  }
  const double o = part.normals;
  const double reach = std::min(o + part.emission, kPi);
  const double rim = 2.0 * (reach - o) * std::sin(o) - std::cos(o - 2.0 * reach) + std::cos(o);
  return part.power * area * kPi * (2.0 - 2.0 * std::cos(o) + 0.5 * rim);
}

/// A plane between bins of emitters' centres.
struct Split {
  int axis = -1; ///< none
  int firstRight = 0;
  double cost = std::numeric_limits<double>::infinity();
};

/// Bins along one axis of a box of centres.
struct Binning {
  int axis;
  int count;
  double start;
  double perUnit;

  Binning(const Bounds3& centres, int alongAxis, std::size_t emitters)
      : axis(alongAxis), count(static_cast<int>(std::min<std::size_t>(kBins, emitters))), start(centres.min[axis]),
        perUnit(count / centres.size()[axis]) {}
  int operator()(const Part& part) const {
    return std::min(count - 1, static_cast<int>((part.box.centre()[axis] - start) * perUnit));
  }
};

class Builder {
public:
  Builder(std::span<interop::Emitter> emitters, std::span<const LightBounds> bounds) : emitters_(emitters) {
    parts_.reserve(bounds.size());
    for (const LightBounds& each : bounds) {
      parts_.push_back(partOf(each, static_cast<std::uint32_t>(parts_.size())));
    }
    tree_.nodes.reserve(2 * bounds.size());
  }

  LightTree build() {
    addNode(parts_, 0, 0);
    return std::move(tree_);
  }

private:
  Part addNode(std::span<Part> parts, std::uint32_t depth, std::uint32_t trail);

  std::vector<Part> parts_; ///< in the order of the leaves once built
  std::span<interop::Emitter> emitters_;
  LightTree tree_;
};

/// Boxes are rounded outwards and cones widened by more than the roundings of what led to them.
interop::LightTreeNode pack(const Part& part) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  interop::LightTreeNode node{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto low = static_cast<float>(part.box.min[axis]);
    const auto high = static_cast<float>(part.box.max[axis]);
    node.boundsMin[axis] = static_cast<double>(low) > part.box.min[axis] ? std::nextafter(low, -kInfinity) : low;
    node.boundsMax[axis] = static_cast<double>(high) < part.box.max[axis] ? std::nextafter(high, kInfinity) : high;
  }
  node.axis = glm::vec3(part.axis);
  node.cosNormals = static_cast<float>(std::max(-1.0, std::cos(part.normals) - 1e-6));
  node.cosEmission = static_cast<float>(std::max(-1.0, std::cos(part.emission) - 1e-6));
  node.power = static_cast<float>(std::clamp(part.power, 1e-37, 1e37));
  return node;
}

Split bestOf(std::span<const Part> bins, int axis, std::size_t largest) {
  std::array<double, kBins> rightCost{};
  std::array<std::size_t, kBins> rightCount{};
  Part right;
  for (std::size_t i = bins.size() - 1; i > 0; --i) {
    unite(right, bins[i]);
    rightCost[i] = bins[i].count == 0 ? rightCost[i + 1] : measure(right); // the last one has the farthest centre
    rightCount[i] = right.count;
  }
  Split best;
  Part left;
  for (std::size_t i = 1; i < bins.size(); ++i) {
    unite(left, bins[i - 1]);
    if (bins[i - 1].count == 0 || left.count > largest || rightCount[i] > largest) {
      continue;
    }
    const double cost = measure(left) + rightCost[i];
    if (best.axis < 0 || cost < best.cost) {
      best = {axis, static_cast<int>(i), cost};
    }
  }
  return best;
}

Split bestSplit(std::span<const Part> parts, const Bounds3& centres, std::size_t largest) {
  Split best;
  const glm::dvec3 size = centres.size();
  const double longest = std::max({size.x, size.y, size.z});
  for (int axis = 0; axis < 3; ++axis) {
    if (!(size[axis] > 1e-6 * longest)) { // also: all in one place
      continue;
    }
    const Binning binOf(centres, axis, parts.size());
    std::array<Part, kBins> bins;
    for (const Part& part : parts) {
      unite(bins[static_cast<std::size_t>(binOf(part))], part);
    }
    Split candidate = bestOf(std::span(bins).first(static_cast<std::size_t>(binOf.count)), axis, largest);
    candidate.cost *= longest / size[axis]; // long boxes are better cut across [Conty18]
    best = candidate.cost < best.cost ? candidate : best;
  }
  return best;
}

/// Orders the parts so that the first child's come first; returns how many they are.
std::size_t divide(std::span<Part> parts, std::uint32_t depth) {
  if (parts.size() == 2) {
    return 1;
  }
  Bounds3 centres;
  for (const Part& part : parts) {
    centres.extend(part.box.centre());
  }
  // What a child may hold so that halving it again and again stays within the depth.
  const std::size_t largest = std::size_t(1) << (interop::kLightTreeDepth - 1 - depth);
  const Split split = bestSplit(parts, centres, largest);
  if (split.axis >= 0) {
    const Binning binOf(centres, split.axis, parts.size());
    const auto isFirst = [&](const Part& part) { return binOf(part) < split.firstRight; };
    return static_cast<std::size_t>(std::partition(parts.begin(), parts.end(), isFirst) - parts.begin());
  }
  const glm::dvec3 size = centres.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const std::size_t half = parts.size() / 2;
  const auto place = [axis](const Part& part) { return std::pair(part.box.centre()[axis], part.emitter); };
  std::nth_element(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(half), parts.end(),
                   [&](const Part& a, const Part& b) { return place(a) < place(b); });
  return half;
}

Part Builder::addNode(std::span<Part> parts, std::uint32_t depth, std::uint32_t trail) {
  const std::size_t index = tree_.nodes.size();
  tree_.nodes.emplace_back();
  tree_.depth = std::max(tree_.depth, depth);
  if (parts.size() == 1) {
    emitters_[parts[0].emitter].trail = trail;
    tree_.nodes[index] = pack(parts[0]);
    tree_.nodes[index].child = interop::kLightTreeLeaf | parts[0].emitter;
    return parts[0];
  }
  const std::size_t first = divide(parts, depth);
  Part part = addNode(parts.first(first), depth + 1, trail);
  const std::size_t second = tree_.nodes.size();
  unite(part, addNode(parts.subspan(first), depth + 1, trail | 1u << depth));
  tree_.nodes[index] = pack(part);
  tree_.nodes[index].child = static_cast<std::uint32_t>(second);
  return part;
}

bool sound(const LightBounds& bounds) {
  const bool finite = std::isfinite(bounds.power + glm::dot(bounds.box.min, bounds.box.max) + bounds.cosEmission);
  return finite && bounds.power > 0.0 && !bounds.box.empty() && std::abs(glm::length(bounds.axis) - 1.0) < 1e-3 &&
         std::abs(bounds.cosNormals) <= 1.0 && std::abs(bounds.cosEmission) <= 1.0;
}

} // namespace

LightTree buildLightTree(std::span<interop::Emitter> emitters, std::span<const LightBounds> bounds) {
  TYNDALL_CHECK(emitters.size() == bounds.size() && emitters.size() < interop::kLightTreeLeaf);
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (!sound(bounds[i])) {
      fail("light {} of {} W has no sound power, box or axis; leave out what gives no light", i, bounds[i].power);
    }
  }
  return emitters.empty() ? LightTree{} : Builder(emitters, bounds).build();
}

LightBounds lightBounds(const interop::Emitter& emitter) {
  const glm::dvec3 position(emitter.position);
  const glm::dvec3 edge1(emitter.edge1);
  const glm::dvec3 edge2(emitter.edge2);
  LightBounds bounds;
  bounds.box.extend(position);
  double strength = 1.0; // greatest intensity per unit of `radiance`
  if (emitter.kind == interop::kEmitterSpot) {
    bounds.axis = glm::normalize(edge1);
    bounds.cosNormals = 1.0;
    bounds.cosEmission = 1.0 - edge2.x;
    strength = edge2.x > 0.0 ? 1.0 : 0.0;
  } else if (emitter.kind == interop::kEmitterTriangle) {
    bounds.box.extend(position + edge1);
    bounds.box.extend(position + edge2);
    const glm::dvec3 normal = glm::cross(edge1, edge2);
    const double doubleArea = glm::length(normal);
    strength = 0.5 * doubleArea;
    bounds.axis = doubleArea > 0.0 ? normal / doubleArea : bounds.axis;
    bounds.cosNormals = (emitter.flags & interop::kEmitterTwoSided) != 0 ? -1.0 : 1.0;
  } else if (emitter.kind == interop::kEmitterSphere) {
    bounds.box = {position - edge1.x, position + edge1.x};
    strength = edge1.x > 0.0 ? kPi * edge1.x * edge1.x : 0.0;
  } else if (emitter.kind == interop::kEmitterVolume) {
    bounds.box.extend(position + edge1);
    strength = edge1.x > 0.0 && edge1.y > 0.0 && edge1.z > 0.0 ? edge1.x * edge1.y * edge1.z : 0.0;
  }
  bounds.power = 4.0 * kPi * strength * luminance(glm::dvec3(emitter.radiance));
  if (!(bounds.power > 0.0) || !std::isfinite(bounds.power)) {
    fail("an emitter of kind {} has the power {} W; leave lights out that have no size or give no light", emitter.kind,
         bounds.power);
  }
  return bounds;
}

} // namespace tyndall::light
