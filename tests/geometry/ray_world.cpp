// SPDX-License-Identifier: Apache-2.0
#include "geometry/ray_world.h"

// Needs <cstdint> before it.
#include "kernels/ray_probe.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall::test {
namespace {

using interop::BvhPrimitive;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Barycentrics or cosines nearer to 0 than this are a matter of rounding.
constexpr double kDoubt = 1e-4;

struct DoubleRay {
  glm::dvec3 origin;
  glm::dvec3 direction;
};

void exactTriangle(const BvhPrimitive& primitive, const DoubleRay& ray, double tMax, ExactHit& hit,
                   std::uint32_t index) {
  const glm::dvec3 v0(primitive.v0);
  const glm::dvec3 edge1 = glm::dvec3(primitive.v1) - v0;
  const glm::dvec3 edge2 = glm::dvec3(primitive.v2) - v0;
  const glm::dvec3 normal = glm::cross(edge1, edge2);
  const double steepness = glm::dot(ray.direction, normal);
  const double cosine = std::abs(steepness) / (glm::length(normal) * glm::length(ray.direction));
  const double t = glm::dot(v0 - ray.origin, normal) / steepness;
  const glm::dvec3 point = ray.origin + t * ray.direction - v0;
  const double b1 = glm::dot(glm::cross(point, edge2), normal) / glm::dot(normal, normal);
  const double b2 = glm::dot(glm::cross(edge1, point), normal) / glm::dot(normal, normal);
  const double inside = std::min(std::min(b1, b2), 1.0 - b1 - b2);
  if (!(inside > -kDoubt) || !(t > -kDoubt && t < tMax + kDoubt)) {
    return;
  }
  if (inside < kDoubt || cosine < kDoubt || std::abs(t) < kDoubt || std::abs(t - tMax) < kDoubt) {
    hit.doubtful = true;
    return;
  }
  hit.doubtful = hit.doubtful || std::abs(t - hit.t) < kDoubt; // of two that are equally near
  hit.opaqueHit = hit.opaqueHit || (primitive.id & interop::kPrimitiveOpaque) != 0;
  if (t < hit.t) {
    hit.t = t;
    hit.primitive = index;
    hit.barycentric = {b1, b2};
    hit.cosine = cosine;
  }
}

void exactSphere(const BvhPrimitive& primitive, const DoubleRay& ray, double tMax, ExactHit& hit, std::uint32_t index) {
  const glm::dvec3 toOrigin = ray.origin - glm::dvec3(primitive.v0);
  const double radius(primitive.v1.x);
  const double a = glm::dot(ray.direction, ray.direction);
  const double b = glm::dot(toOrigin, ray.direction);
  const double root = b * b - a * (glm::dot(toOrigin, toOrigin) - radius * radius);
  if (root < 0.0) {
    return;
  }
  const double cosine = std::sqrt(root / a) / radius;
  hit.doubtful = hit.doubtful || cosine < 1e-2; // the float's error grows with 1 / cosine
  for (const double t : {(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a}) {
    hit.doubtful = hit.doubtful || std::abs(t) < kDoubt || std::abs(t - tMax) < kDoubt;
    if (t > 0.0 && t < tMax) {
      hit.opaqueHit = hit.opaqueHit || (primitive.id & interop::kPrimitiveOpaque) != 0;
      if (t < hit.t) {
        hit.t = t;
        hit.primitive = index;
        hit.barycentric = {0.0, 0.0};
        hit.cosine = cosine;
      }
      return;
    }
  }
}

} // namespace

RayWorld::RayWorld(Soup world, const std::vector<Soup>& meshes, const std::vector<Place>& places) {
  std::vector<geometry::Bvh> parts;
  for (const Soup& mesh : meshes) {
    parts.push_back(geometry::buildBvh(mesh));
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    geometry::BvhInput input{};
    input.primitive.id = interop::kPrimitiveInstance | static_cast<std::uint32_t>(i);
    input.bounds = transformed(places[i].worldFromObject, parts.at(places[i].mesh).bounds);
    world.push_back(input);
  }
  bvh = geometry::buildBvh(world);
  worldPrimitives = bvh.primitives.size();
  std::vector<std::uint32_t> roots;
  std::vector<std::vector<std::uint32_t>> ranges;
  for (const geometry::Bvh& part : parts) {
    const auto first = static_cast<std::uint32_t>(bvh.primitives.size());
    roots.push_back(geometry::appendBvh(bvh, part));
    ranges.push_back({first, static_cast<std::uint32_t>(bvh.primitives.size())});
  }
  for (const Place& place : places) {
    instances.push_back({glm::mat4x3(glm::mat4(glm::inverse(place.worldFromObject))),
                         glm::mat4x3(glm::mat4(place.worldFromObject)), roots[place.mesh], interop::kNoMotion});
    meshRanges.push_back(ranges[place.mesh]);
  }
  for (const BvhPrimitive& primitive : bvh.primitives) {
    spheres = spheres || (primitive.id & interop::kPrimitiveKindMask) == interop::kPrimitiveSphere;
  }
  nodes_ = ProbeRunner::upload(bvh.nodes);
  primitives_ = ProbeRunner::upload(bvh.primitives);
  instances_ = ProbeRunner::upload(instances);
  interop::Surfaces surfaces{};
  surfaces.nodes = nodes_.ptr();
  surfaces.primitives = primitives_.ptr();
  surfaces.instances = instances_.ptr();
  surfaces_ = ProbeRunner::upload(std::vector{surfaces});
}

std::vector<interop::ProbeHit> RayWorld::run(const std::vector<interop::ProbeRay>& rays, std::uint32_t mode,
                                             std::uint32_t plant, std::uint32_t plantedBug) const {
  const ProbeRunner probe(k_ray_probe_spirv,
                          {{0, gpu::specBits(spheres)}, {1, gpu::specBits(!instances.empty())}, {2, plantedBug}});
  const auto input = ProbeRunner::upload(rays);
  const auto output = ProbeRunner::results<interop::ProbeHit>(rays.size());
  const auto count = static_cast<std::uint32_t>(rays.size());
  probe.run(interop::RayProbeInputs{surfaces_.ptr(), input.ptr(), output.ptr(), count, mode, plant}, count);
  return ProbeRunner::download(output);
}

ExactHit exactHit(const RayWorld& world, const interop::ProbeRay& ray) {
  ExactHit hit;
  hit.t = kInfinity;
  const double tMax(ray.tMax);
  const auto testOne = [&](std::uint32_t i, const DoubleRay& local) {
    const std::uint32_t kind = world.bvh.primitives[i].id & interop::kPrimitiveKindMask;
    if (kind == interop::kPrimitiveTriangle) {
      exactTriangle(world.bvh.primitives[i], local, tMax, hit, i);
    } else if (kind == interop::kPrimitiveSphere) {
      exactSphere(world.bvh.primitives[i], local, tMax, hit, i);
    }
  };
  const DoubleRay own{glm::dvec3(ray.origin), glm::dvec3(ray.direction)};
  for (std::uint32_t i = 0; i < world.worldPrimitives; ++i) {
    testOne(i, own);
  }
  for (std::uint32_t i = 0; i < world.instances.size(); ++i) {
    const glm::dmat4x3 objectFromWorld(world.instances[i].objectFromWorld);
    const DoubleRay local{objectFromWorld * glm::dvec4(own.origin, 1.0), glm::dmat3(objectFromWorld) * own.direction};
    const double before = hit.t;
    for (std::uint32_t k = world.meshRanges[i][0]; k < world.meshRanges[i][1]; ++k) {
      testOne(k, local);
    }
    hit.instance = hit.t < before ? i : hit.instance;
  }
  return hit;
}

glm::vec3 randomDirection(std::mt19937& random) {
  std::normal_distribution<float> normal;
  const glm::vec3 direction(normal(random), normal(random), normal(random));
  return glm::normalize(direction);
}

} // namespace tyndall::test
