// SPDX-License-Identifier: Apache-2.0
#include "bench/ray_caster.h"

#include "bench/ceilings.h"
#include "bench/figure.h"

// Needs <cstdint> before it.
#include "kernels/ray_cast.h"

#include <cmath>
#include <numbers>
#include <random>

namespace tyndall::bench {
namespace {

using interop::BenchHit;
using interop::BenchRay;

constexpr float kFar = 1e30f;
constexpr std::uint32_t kTile = 8; // pixels that are neighbours in the picture are neighbours in a subgroup

} // namespace

DeviceCaster::DeviceCaster(const gpu::Device& device, const geometry::Bvh& bvh)
    : device_(device), kernel_(device, k_ray_cast_spirv, {}),
      nodes_(device, std::span<const interop::BvhNode>(bvh.nodes)),
      primitives_(device, std::span<const interop::BvhPrimitive>(bvh.primitives)) {
  interop::Surfaces surfaces{};
  surfaces.nodes = nodes_.ptr();
  surfaces.primitives = primitives_.ptr();
  surfaces_ = gpu::Buffer<interop::Surfaces>(device, std::span<const interop::Surfaces>(&surfaces, 1));
}

void DeviceCaster::load(const BenchRays& rays) {
  rays_ = gpu::Buffer<BenchRay>(device_, std::span<const BenchRay>(rays));
  hits_ = gpu::Buffer<BenchHit>(device_, rays.size(), gpu::Memory::Host);
}

void DeviceCaster::run(bool anyHit) const {
  const auto count = static_cast<std::uint32_t>(rays_.size());
  kernel_.run(interop::RayCastInputs{surfaces_.ptr(), rays_.ptr(), hits_.ptr(), count, anyHit ? 1u : 0u}, count);
}

BenchRays primaryRays(const RayScene& scene, std::uint32_t size) {
  BenchRays rays;
  for (std::uint32_t tile = 0; tile < size / kTile * (size / kTile); ++tile) {
    for (std::uint32_t i = 0; i < kTile * kTile; ++i) {
      const std::uint32_t x = tile % (size / kTile) * kTile + i % kTile;
      const std::uint32_t y = tile / (size / kTile) * kTile + i / kTile;
      const glm::vec2 place = 2.0f * (glm::vec2(x, y) + 0.5f) / float(size) - 1.0f;
      rays.push_back({scene.camera, kFar, glm::normalize(glm::vec3(scene.tangent * place, -1.0f))});
    }
  }
  return rays;
}

BenchRays secondaryRays(const RayScene& scene, const geometry::Bvh& bvh, const BenchRays& primary,
                        std::span<const BenchHit> hits, bool toLight) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  std::normal_distribution<float> gaussian;
  BenchRays rays;
  for (std::size_t i = 0; i < primary.size(); ++i) {
    if (hits[i].primitive == interop::kBvhEmpty) {
      continue;
    }
    const interop::BvhPrimitive& primitive = bvh.primitives[hits[i].primitive];
    glm::vec3 normal = glm::normalize(glm::cross(primitive.v1 - primitive.v0, primitive.v2 - primitive.v0));
    normal = glm::dot(normal, primary[i].direction) > 0.0f ? -normal : normal;
    const glm::vec3 origin = primary[i].origin + hits[i].t * primary[i].direction + 1e-4f * normal;
    if (toLight) {
      const glm::vec3 share(uniform(random), 0.0f, uniform(random));
      const glm::vec3 way = scene.lightMin + share * (scene.lightMax - scene.lightMin) - origin;
      rays.push_back({origin, glm::length(way), glm::normalize(way)});
    } else {
      const glm::vec3 outward =
          normal + glm::normalize(glm::vec3(gaussian(random), gaussian(random), gaussian(random)));
      rays.push_back({origin, kFar, glm::normalize(outward)});
    }
  }
  return rays;
}

RayRates rayRates(const gpu::Device& device, const RayScene& scene, std::uint32_t size, std::uint32_t repeats,
                  Clock clock) {
  const geometry::Bvh bvh = geometry::buildBvh(scene.triangles);
  DeviceCaster caster(device, bvh);
  const BenchRays primary = primaryRays(scene, size);
  const auto rate = [&](const BenchRays& rays, bool anyHit) {
    caster.load(rays);
    caster.run(anyHit); // compiles
    std::vector<double> seconds;
    for (std::uint32_t round = 0; round < repeats; ++round) {
      const Cost cost = costOf([&] { caster.run(anyHit); });
      seconds.push_back(clock == Clock::Wall ? cost.wall : secondsOf(cost, device));
    }
    return double(rays.size()) / median(seconds);
  };
  RayRates rates;
  rates.primary = rate(primary, false);
  const std::vector<BenchHit> hits(caster.hits().begin(), caster.hits().end());
  rates.diffuse = rate(secondaryRays(scene, bvh, primary, hits, false), false);
  rates.shadow = rate(secondaryRays(scene, bvh, primary, hits, true), true);
  return rates;
}

} // namespace tyndall::bench
