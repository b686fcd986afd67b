// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "light/light_tree.h"
#include "shaders/light_tree_probe_io.h"
#include "support/probe.h"

#include <string>
#include <vector>

/// Emitters, receivers and who can shine on whom, for tests of the light tree on the device.
namespace tyndall::test {

struct EmitterScene {
  std::string name;
  std::vector<interop::Emitter> emitters;
  std::vector<interop::LightTreeNode> nodes;
};

/// An emitter with a white radiance (intensity); the members as in interop/emitters.h.
interop::Emitter makeEmitter(std::uint32_t kind, const glm::vec3& position, float radiance = 1.0f,
                             const glm::vec3& edge1 = glm::vec3(0.0f), const glm::vec3& edge2 = glm::vec3(0.0f));

/// Adds the tree.
EmitterScene makeEmitterScene(std::string name, std::vector<interop::Emitter> emitters);

/// Points, spots, triangles of both kinds and spheres scattered over 20 units, of widely differing power.
std::vector<interop::Emitter> mixedEmitters(std::size_t count, unsigned seed);
/// Points of equal power, uniform in the cube [-size, size]^3.
std::vector<interop::Emitter> equalPoints(std::size_t count, float size, unsigned seed);
/// The scenes that every property is tested on: many and few, in a plane, in one place, extreme in power and distance.
std::vector<EmitterScene> emitterScenes();

/// Random receivers of all kinds, and some at, beside, inside and in the plane of emitters.
std::vector<interop::TreeReceiver> receiversIn(const EmitterScene& scene, std::size_t count, unsigned seed);

/// Whether any light of an emitter can reach the receiver from a side that counts, if nothing is in the way.
bool contributes(const interop::Emitter& emitter, const interop::TreeReceiver& receiver);

/// Emitters on the device.
class EmittersOnDevice {
public:
  explicit EmittersOnDevice(const EmitterScene& scene);
  interop::Ptr<interop::Emitters> ptr() const { return header_.ptr(); }

private:
  gpu::Buffer<interop::Emitter> emitters_;
  gpu::Buffer<interop::LightTreeNode> nodes_;
  gpu::Buffer<interop::Emitters> header_;
};

} // namespace tyndall::test
