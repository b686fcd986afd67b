// SPDX-License-Identifier: Apache-2.0
#include "microbench/ceilings.h"
#include "microbench/commands.h"
#include "microbench/measure.h"
#include "microbench/ray_scenes.h"
#include "gpu/buffer.h"
#include "gpu/kernel.h"

// Needs <cstdint> before it.
#include "kernels/ray_cast.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>
#include <random>

namespace tyndall::microbench {
namespace {

using Json = nlohmann::ordered_json;
using interop::BenchHit;
using interop::BenchRay;
using Rays = std::vector<BenchRay>;

constexpr float kFar = 1e30f;
constexpr std::uint32_t kTile = 8; // pixels that are neighbours in the picture are neighbours in a subgroup

class DeviceCaster {
public:
  DeviceCaster(const gpu::Device& device, const geometry::Bvh& bvh)
      : device_(device), kernel_(device, k_ray_cast_spirv, {}),
        nodes_(device, std::span<const interop::BvhNode>(bvh.nodes)),
        primitives_(device, std::span<const interop::BvhPrimitive>(bvh.primitives)) {
    interop::Surfaces surfaces{};
    surfaces.nodes = nodes_.ptr();
    surfaces.primitives = primitives_.ptr();
    surfaces_ = gpu::Buffer<interop::Surfaces>(device, std::span<const interop::Surfaces>(&surfaces, 1));
  }

  void load(const Rays& rays) {
    rays_ = gpu::Buffer<BenchRay>(device_, std::span<const BenchRay>(rays));
    hits_ = gpu::Buffer<BenchHit>(device_, rays.size(), gpu::Memory::Host);
  }
  void run(bool anyHit) const {
    const auto count = static_cast<std::uint32_t>(rays_.size());
    kernel_.run(interop::RayCastInputs{surfaces_.ptr(), rays_.ptr(), hits_.ptr(), count, anyHit ? 1u : 0u}, count);
  }
  std::span<const BenchHit> hits() const { return hits_.mapped(); }

private:
  const gpu::Device& device_;
  gpu::Kernel kernel_;
  gpu::Buffer<interop::BvhNode> nodes_;
  gpu::Buffer<interop::BvhPrimitive> primitives_;
  gpu::Buffer<interop::Surfaces> surfaces_;
  gpu::Buffer<BenchRay> rays_;
  gpu::Buffer<BenchHit> hits_;
};

Rays primaryRays(const RayScene& scene, std::uint32_t size) {
  Rays rays;
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

/// One ray each from where `primary` rays hit: cosine-distributed, or to a random point of the light.
Rays secondaryRays(const RayScene& scene, const geometry::Bvh& bvh, const Rays& primary, std::span<const BenchHit> hits,
                   bool toLight) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  std::normal_distribution<float> gaussian;
  Rays rays;
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

/// Rays whose distances differ by more than rounding, or that one of both misses.
std::size_t differing(std::span<const BenchHit> hits, const std::vector<float>& distances) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    count += std::abs(hits[i].t - distances[i]) > 1e-3f * std::max(distances[i], 1e-2f) ? 1 : 0;
  }
  return count;
}

struct Kind {
  const char* name;
  bool anyHit;
};

Json kindRow(const Session& session, DeviceCaster& caster, const std::optional<RayCaster>& peer, const Rays& rays,
             const Kind& kind) {
  caster.load(rays);
  caster.run(kind.anyHit); // compiles
  std::vector<float> distances(rays.size());
  std::vector<double> own;
  std::vector<double> theirs;
  const bool processClock = session.device.info().type == "cpu";
  for (std::uint32_t round = 0; round < session.options.repeats; ++round) {
    const Cost cost = costOf([&] { caster.run(kind.anyHit); });
    own.push_back(processClock ? cost.cpu : cost.wall);
    if (peer) {
      theirs.push_back(costOf([&] { (*peer)(rays, kind.anyHit, distances); }).cpu);
    }
  }
  const Figure count{double(rays.size()) * 1e-6, 0.0};
  const Figure ownRate = count / medianTime(own);
  Json row{{"rays", kind.name}, {"count", rays.size()}, {"millionPerSecond", ownRate.value}};
  const Interval ownSpan = interval(ownRate, own.size());
  fmt::print("  {:<16}{:>8} [{}, {}]", kind.name, shortText(ownRate.value), shortText(ownSpan.low),
             shortText(ownSpan.high));
  if (peer) {
    const Figure peerRate = count / medianTime(theirs);
    const Figure ratio = ownRate / peerRate;
    const Interval span = interval(ratio, own.size());
    const std::size_t others = differing(caster.hits(), distances);
    fmt::print("{:>10}{:>8} [{}, {}]{:>8}", shortText(peerRate.value), shortText(ratio.value), shortText(span.low),
               shortText(span.high), others);
    row["embreeMillionPerSecond"] = peerRate.value;
    row["ratio"] = ratio.value;
    row["differing"] = others;
  }
  fmt::print("\n");
  std::fflush(stdout);
  return row;
}

Json sceneRows(const Session& session, const RayScene& scene) {
  geometry::Bvh bvh;
  const Cost build = costOf([&] { bvh = geometry::buildBvh(scene.triangles); });
  fmt::print("{}: {} nodes, {} levels, built in {} s\n", scene.name, bvh.nodes.size(), bvh.depth,
             shortText(build.wall));
  DeviceCaster caster(session.device, bvh);
  const std::optional<RayCaster> peer = embreeCaster(scene);
  const Rays primary = primaryRays(scene, session.options.size);
  Json rows = Json::array({kindRow(session, caster, peer, primary, {"primary", false})});
  const std::vector<BenchHit> hits(caster.hits().begin(), caster.hits().end());
  rows.push_back(kindRow(session, caster, peer, secondaryRays(scene, bvh, primary, hits, false), {"diffuse", false}));
  rows.push_back(
      kindRow(session, caster, peer, secondaryRays(scene, bvh, primary, hits, true), {"shadow, any hit", true}));
  return {{"scene", scene.name}, {"buildSeconds", build.wall}, {"nodes", bvh.nodes.size()}, {"figures", rows}};
}

} // namespace

RayRates rayRates(const Session& session, const RayScene& scene) {
  const geometry::Bvh bvh = geometry::buildBvh(scene.triangles);
  DeviceCaster caster(session.device, bvh);
  const Rays primary = primaryRays(scene, session.options.size);
  const auto rate = [&](const Rays& rays, bool anyHit) {
    caster.load(rays);
    caster.run(anyHit); // compiles
    std::vector<double> seconds;
    for (std::uint32_t round = 0; round < session.options.repeats; ++round) {
      const Cost cost = costOf([&] { caster.run(anyHit); });
      seconds.push_back(session.device.info().type == "cpu" ? cost.cpu : cost.wall);
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

Json raysReport(const Session& session) {
  fmt::print("\nmillion rays per {}; 95 % intervals{}\n",
             session.device.info().type == "cpu" ? "CPU core second" : "second",
             embreeCaster(boxScene()) ? "; Embree's on one core; the ratio; rays that found other distances"
                                      : "; built without Embree, so nothing to compare with");
  Json rows = Json::array();
  constexpr int kRings = 64;      // 97k triangles
  constexpr int kManyRings = 204; // a million
  for (const RayScene& scene : {boxScene(), bumpySpheres(kRings), bumpySpheres(kManyRings)}) {
    rows.push_back(sceneRows(session, scene));
  }
  return rows;
}

} // namespace tyndall::microbench
