// SPDX-License-Identifier: Apache-2.0
#include "shaders/light_tree_scenes.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace tyndall::test {
namespace {

using interop::Emitter;
using interop::TreeReceiver;

class Random {
public:
  explicit Random(unsigned seed) : engine_(seed) {}
  float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }
  glm::vec3 inCube(float size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
  glm::vec3 direction() {
    std::normal_distribution<float> normal;
    return glm::normalize(glm::vec3(normal(engine_), normal(engine_), normal(engine_)));
  }
  std::uint32_t below(std::size_t count) {
    return static_cast<std::uint32_t>(std::uniform_int_distribution<std::size_t>(0, count - 1)(engine_));
  }

private:
  std::mt19937 engine_;
};

/// The receiver's normal lets light in from somewhere on the emitter.
bool facesTheReceiver(const Emitter& emitter, const TreeReceiver& receiver) {
  const glm::dvec3 normal(receiver.normal);
  if (normal == glm::dvec3(0.0) || receiver.twoSided != 0) {
    return true;
  }
  const glm::dvec3 offset = glm::dvec3(emitter.position) - glm::dvec3(receiver.point);
  double highest = glm::dot(normal, offset);
  if (emitter.kind == interop::kEmitterTriangle) {
    highest = std::max({highest, highest + glm::dot(normal, glm::dvec3(emitter.edge1)),
                        highest + glm::dot(normal, glm::dvec3(emitter.edge2))});
  } else if (emitter.kind == interop::kEmitterSphere) {
    highest += static_cast<double>(emitter.edge1.x);
  }
  return highest > 0.0;
}

EmitterScene extremes() {
  Random random(7);
  std::vector<Emitter> emitters;
  for (int i = 0; i < 200; ++i) {
    const float scale = std::pow(10.0f, random.uniform(-6.0f, 6.0f));
    const glm::vec3 position = scale * random.direction();
    if (i % 2 == 0) {
      emitters.push_back(makeEmitter(interop::kEmitterPoint, position, std::pow(10.0f, random.uniform(-13.0f, 11.0f))));
    } else {
      const float size = std::pow(10.0f, random.uniform(-4.0f, 2.0f));
      const float radiance = std::pow(10.0f, random.uniform(-13.0f, 11.0f)) / (size * size);
      emitters.push_back(makeEmitter(interop::kEmitterTriangle, position, radiance, size * random.direction(),
                                     size * random.direction()));
    }
  }
  return makeEmitterScene("extreme", std::move(emitters));
}

} // namespace

Emitter makeEmitter(std::uint32_t kind, const glm::vec3& position, float radiance, const glm::vec3& edge1,
                    const glm::vec3& edge2) {
  Emitter emitter{};
  emitter.kind = kind;
  emitter.position = position;
  emitter.edge1 = edge1;
  emitter.edge2 = edge2;
  emitter.radiance = glm::vec3(radiance);
  return emitter;
}

EmitterScene makeEmitterScene(std::string name, std::vector<Emitter> emitters) {
  std::vector<light::LightBounds> bounds;
  for (const Emitter& emitter : emitters) {
    bounds.push_back(light::lightBounds(emitter));
  }
  light::LightTree tree = light::buildLightTree(emitters, bounds);
  return {std::move(name), std::move(emitters), std::move(tree.nodes)};
}

std::vector<Emitter> mixedEmitters(std::size_t count, unsigned seed) {
  Random random(seed);
  std::vector<Emitter> emitters;
  for (std::size_t i = 0; i < count; ++i) {
    const auto kind = static_cast<std::uint32_t>(i % 4);
    glm::vec3 edge1 = random.inCube(1.0f);
    glm::vec3 edge2 = random.inCube(1.0f);
    if (kind == interop::kEmitterSpot) {
      edge1 = random.direction();
      edge2 = glm::vec3(random.uniform(1e-3f, 1.5f), 0.0f, 0.0f);
      edge2.y = edge2.x * random.uniform(0.0f, 1.0f);
    } else if (kind == interop::kEmitterSphere) {
      edge1 = glm::vec3(random.uniform(0.01f, 1.0f), 0.0f, 0.0f);
    }
    emitters.push_back(
        makeEmitter(kind, random.inCube(10.0f), std::pow(10.0f, random.uniform(-2.0f, 2.0f)), edge1, edge2));
    emitters.back().flags = random.below(2) == 0 ? 0u : interop::kEmitterTwoSided;
  }
  return emitters;
}

std::vector<Emitter> equalPoints(std::size_t count, float size, unsigned seed) {
  Random random(seed);
  std::vector<Emitter> emitters;
  for (std::size_t i = 0; i < count; ++i) {
    emitters.push_back(makeEmitter(interop::kEmitterPoint, random.inCube(size)));
  }
  return emitters;
}

std::vector<EmitterScene> emitterScenes() {
  std::vector<EmitterScene> scenes;
  for (const std::size_t count : {1u, 2u, 3u, 40u, 300u}) {
    scenes.push_back(makeEmitterScene("mixed " + std::to_string(count), mixedEmitters(count, 3)));
  }
  std::vector<Emitter> ceiling; // one-sided, all in the plane y = 0, facing down
  for (int i = 0; i < 64; ++i) {
    const glm::vec3 corner(static_cast<float>(i % 8), 0.0f, static_cast<float>(i / 8));
    ceiling.push_back(
        makeEmitter(interop::kEmitterTriangle, corner, 1.0f, glm::vec3(0.9f, 0.0f, 0.0f), glm::vec3(0.0f, 0.0f, 0.9f)));
  }
  scenes.push_back(makeEmitterScene("ceiling", ceiling));
  scenes.push_back(
      makeEmitterScene("one place", std::vector<Emitter>(50, makeEmitter(interop::kEmitterPoint, glm::vec3(1.0f)))));
  scenes.push_back(extremes());
  return scenes;
}

std::vector<TreeReceiver> receiversIn(const EmitterScene& scene, std::size_t count, unsigned seed) {
  Random random(seed);
  std::vector<TreeReceiver> receivers;
  for (std::size_t i = 0; i < count; ++i) {
    TreeReceiver receiver{};
    const Emitter& emitter = scene.emitters[random.below(scene.emitters.size())];
    const glm::vec3 inPlane = random.uniform(-3.0f, 3.0f) * emitter.edge1 + random.uniform(-3.0f, 3.0f) * emitter.edge2;
    const glm::vec3 places[] = {random.inCube(12.0f), emitter.position, emitter.position + inPlane,
                                emitter.position + random.inCube(1e-4f), random.inCube(1000.0f)};
    receiver.point = places[i % 5];
    receiver.normal = i % 3 == 0 ? glm::vec3(0.0f) : random.direction();
    receiver.twoSided = i % 3 == 2 ? 1u : 0u;
    receivers.push_back(receiver);
  }
  return receivers;
}

bool contributes(const Emitter& emitter, const TreeReceiver& receiver) {
  const glm::dvec3 fromLight = glm::dvec3(receiver.point) - glm::dvec3(emitter.position);
  const bool twoSided = (emitter.flags & interop::kEmitterTwoSided) != 0;
  if (glm::length(fromLight) < 1e-15 || !facesTheReceiver(emitter, receiver)) {
    return false;
  }
  switch (emitter.kind) {
  case interop::kEmitterSpot:
    return 1.0 - glm::dot(glm::normalize(glm::dvec3(emitter.edge1)), glm::normalize(fromLight)) <
           double(emitter.edge2.x);
  case interop::kEmitterTriangle: {
    const double height = glm::dot(glm::cross(glm::dvec3(emitter.edge1), glm::dvec3(emitter.edge2)), fromLight);
    return twoSided ? height != 0.0 : height > 0.0;
  }
  case interop::kEmitterSphere:
    return twoSided || glm::length(fromLight) > static_cast<double>(emitter.edge1.x);
  default:
    return true;
  }
}

EmittersOnDevice::EmittersOnDevice(const EmitterScene& scene)
    : emitters_(ProbeRunner::upload(scene.emitters)), nodes_(ProbeRunner::upload(scene.nodes)),
      header_(ProbeRunner::upload(std::vector<interop::Emitters>{
          {emitters_.ptr(), nodes_.ptr(), static_cast<std::uint32_t>(scene.emitters.size()), 0u}})) {}

} // namespace tyndall::test
