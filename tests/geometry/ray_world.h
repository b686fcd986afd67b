// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/bvh.h"
#include "gpu/kernel.h"
#include "ray_probe_io.h"
#include "support/probe.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <random>
#include <vector>

namespace tyndall::test {

using Soup = std::vector<geometry::BvhInput>;

/// Triangle i of a soup has the index i, as have spheres among themselves.
geometry::BvhInput triangle(const glm::vec3& v0, const glm::vec3& v1, const glm::vec3& v2, std::uint32_t index,
                            bool opaque = true);
geometry::BvhInput sphere(const glm::vec3& centre, float radius, std::uint32_t index, bool opaque = true);

/// `count` triangles with vertices up to `size` from centres in [-1, 1]^3.
Soup randomTriangles(std::size_t count, float size, std::uint32_t seed);
/// Convex, closed, facing outward. The icosphere's vertices lie on the unit sphere to rounding.
Soup closedBox(const glm::vec3& halfSize, int cellsPerEdge);
Soup icosphere(int subdivisions);
/// All coordinates times `scale`, plus `shift`, rounded.
Soup moved(Soup soup, float scale, const glm::vec3& shift);

/// Surfaces on the device; `place` adds instances of meshes.
struct RayWorld {
  struct Place {
    std::uint32_t mesh = 0;
    glm::dmat4 worldFromObject{1.0};
  };

  RayWorld(Soup world, const std::vector<Soup>& meshes = {}, const std::vector<Place>& places = {});

  /// @param mode, plant as in ray_probe_io.h. @param plantedBug of the kernel.
  std::vector<interop::ProbeHit> run(const std::vector<interop::ProbeRay>& rays, std::uint32_t mode,
                                     std::uint32_t plant = 0, std::uint32_t plantedBug = 0) const;

  geometry::Bvh bvh;
  std::size_t worldPrimitives = 0; ///< the first ones are the world's
  std::vector<interop::Instance> instances;
  std::vector<std::vector<std::uint32_t>> meshRanges; ///< per instance: {first, last + 1} in bvh.primitives
  bool spheres = false;

private:
  gpu::Buffer<interop::BvhNode> nodes_;
  gpu::Buffer<interop::BvhPrimitive> primitives_;
  gpu::Buffer<interop::Instance> instances_;
  gpu::Buffer<interop::Surfaces> surfaces_;
};

/// By testing everything in double, on the device's floats.
struct ExactHit {
  double t = 0.0; ///< infinity: none
  std::uint32_t primitive = 0xffffffffu;
  std::uint32_t instance = 0xffffffffu;
  glm::dvec2 barycentric{0.0};
  double cosine = 1.0;    ///< between ray and normal
  bool opaqueHit = false; ///< anything opaque within tMax
  bool doubtful = false;  ///< an edge or a grazing surface so near that floats may decide otherwise
};
ExactHit exactHit(const RayWorld& world, const interop::ProbeRay& ray);

glm::vec3 randomDirection(std::mt19937& random);

} // namespace tyndall::test
