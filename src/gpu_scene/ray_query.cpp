// SPDX-License-Identifier: Apache-2.0
#include "gpu_scene/ray_query.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tyndall::gpu_scene {
namespace {

using interop::BvhPrimitive;

/// How far a sphere's box is too large: in the sphere's radii, and in the scene's size, since far rays are rounded by
/// as much. What it lets through in vain, the kernel's own test turns away.
constexpr double kBoxSlack = 1e-3;
constexpr double kBoxSlackOfScene = 3.8e-6; // 2^-18

std::uint32_t kindOf(const BvhPrimitive& primitive) { return primitive.id & interop::kPrimitiveKindMask; }

std::span<const BvhPrimitive> primitivesOf(const PackedSurfaces& surfaces, const PrimitiveRange& range) {
  return std::span(surfaces.bvh.primitives).subspan(range.first, range.count);
}

/// Whether every triangle ends a shadow ray.
bool opaque(std::span<const BvhPrimitive> primitives) {
  return std::all_of(primitives.begin(), primitives.end(), [](const BvhPrimitive& primitive) {
    return kindOf(primitive) != interop::kPrimitiveTriangle || (primitive.id & interop::kPrimitiveOpaque) != 0;
  });
}

/// From [-1, 1]^3 to around the sphere.
glm::mat4x3 boxAround(const BvhPrimitive& sphere, double sceneSize) {
  const double half = (1.0 + kBoxSlack) * std::abs(double(sphere.v1.x)) + kBoxSlackOfScene * sceneSize;
  glm::mat4x3 worldFromBox(static_cast<float>(half));
  worldFromBox[3] = sphere.v0;
  return worldFromBox;
}

const PrimitiveRange& rangeOf(const std::vector<PrimitiveRange>& ranges, std::uint32_t root) {
  return *std::lower_bound(ranges.begin(), ranges.end(), root,
                           [](const PrimitiveRange& range, std::uint32_t wanted) { return range.root < wanted; });
}

} // namespace

std::vector<PrimitiveRange> primitiveRanges(const PackedSurfaces& surfaces) {
  std::vector<std::uint32_t> roots{0};
  for (const interop::Instance& instance : surfaces.instances) {
    roots.push_back(instance.root);
  }
  std::sort(roots.begin(), roots.end());
  roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
  // Trees follow one another, nodes as well as primitives: a range begins with its nodes' first leaf.
  std::vector<PrimitiveRange> ranges;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const std::size_t end = i + 1 < roots.size() ? roots[i + 1] : surfaces.bvh.nodes.size();
    auto first = static_cast<std::uint32_t>(surfaces.bvh.primitives.size());
    for (std::size_t node = roots[i]; node < end; ++node) {
      for (const std::uint32_t child : surfaces.bvh.nodes[node].children) {
        if (child != interop::kBvhEmpty && (child & interop::kBvhLeaf) != 0) {
          first = std::min(first, child & interop::kBvhFirstMask);
        }
      }
    }
    ranges.push_back({roots[i], first, 0});
  }
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const std::size_t end = i + 1 < ranges.size() ? ranges[i + 1].first : surfaces.bvh.primitives.size();
    ranges[i].count = static_cast<std::uint32_t>(end - ranges[i].first);
  }
  return ranges;
}

std::vector<glm::vec3> rangeCorners(const PackedSurfaces& surfaces, const PrimitiveRange& range) {
  glm::vec3 place(surfaces.bvh.bounds.centre()); // of what is no triangle: near the one before, for small boxes
  std::vector<glm::vec3> corners;
  corners.reserve(std::size_t{3} * range.count);
  for (const BvhPrimitive& primitive : primitivesOf(surfaces, range)) {
    const bool triangle = kindOf(primitive) == interop::kPrimitiveTriangle;
    for (const glm::vec3& corner : {primitive.v0, primitive.v1, primitive.v2}) {
      place = triangle ? corner : place;
      corners.push_back(place);
    }
  }
  return corners;
}

std::optional<std::string> rayQueryObstacle(const gpu::Device& device, const PackedSurfaces& surfaces) {
  if (!device.info().rayQuery) {
    return fmt::format("{} has no ray queries (VK_KHR_ray_query)", device.info().name);
  }
  std::uint64_t last = primitiveRanges(surfaces).back().first;
  if (!surfaces.spheres.empty()) {
    last = surfaces.bvh.primitives.size();
  }
  if (last >= gpu::kRayPlaceIndices) {
    return fmt::format("ray queries number spheres and instanced meshes up to {} surfaces; the scene has {}",
                       gpu::kRayPlaceIndices, surfaces.bvh.primitives.size());
  }
  return std::nullopt;
}

RayQueryTree::RayQueryTree(const gpu::Device& device, const PackedSurfaces& surfaces) {
  const std::vector<PrimitiveRange> ranges = primitiveRanges(surfaces);
  for (const PrimitiveRange& range : ranges) {
    meshes_.push_back(gpu::AccelerationStructure::ofTriangles(device, rangeCorners(surfaces, range),
                                                              opaque(primitivesOf(surfaces, range))));
  }
  std::vector<gpu::RayPlace> places{{&meshes_.front()}};
  for (const interop::Instance& instance : surfaces.instances) {
    const PrimitiveRange& range = rangeOf(ranges, instance.root);
    places.push_back({&meshes_[std::size_t(&range - ranges.data())], instance.worldFromObject, range.first});
  }
  if (!surfaces.spheres.empty()) {
    box_ = gpu::AccelerationStructure::ofBox(device);
    const Bounds3& bounds = surfaces.bvh.bounds;
    const glm::dvec3 reach = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
    const double sceneSize = std::max({reach.x, reach.y, reach.z});
    const std::span<const BvhPrimitive> world = primitivesOf(surfaces, ranges.front());
    for (std::size_t i = 0; i < world.size(); ++i) {
      if (kindOf(world[i]) == interop::kPrimitiveSphere) {
        places.push_back({&*box_, boxAround(world[i], sceneSize), static_cast<std::uint32_t>(i)});
      }
    }
  }
  top_ = gpu::AccelerationStructure::ofPlaces(device, places);
}

std::size_t RayQueryTree::bytes() const {
  std::size_t sum = top_->bytes() + (box_ ? box_->bytes() : 0);
  for (const gpu::AccelerationStructure& mesh : meshes_) {
    sum += mesh.bytes();
  }
  return sum;
}

} // namespace tyndall::gpu_scene
