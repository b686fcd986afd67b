// SPDX-License-Identifier: Apache-2.0
// Transmittance and emission along single rays, against closed forms.
#include "verify/families.h"
#include "verify/oracle_radiance.h"

#include <fmt/format.h>

#include <cmath>

namespace tyndall::verify {
namespace {

constexpr int kRampVoxels = 20;
constexpr glm::ivec3 kRampFirst{-3, 11, 5}; // an index-space offset that is no multiple of a brick
constexpr int kRampAxis = 1;
constexpr double kRampScale = 0.5;

double rampDensity(double index) { return 0.02 + 0.01 * (index - kRampFirst[kRampAxis]); }

volume::BrickGrid ramp(const glm::dmat4& worldFromIndex) {
  return gridOf(glm::ivec3(kRampVoxels), kRampFirst, worldFromIndex,
                [](const glm::ivec3& index) { return rampDensity(index[kRampAxis]); });
}

/// All rays go along an index axis through one point inside: the field is a polygon between the voxels that falls to 0
/// over one voxel at both ends, and its integral the sum of the voxels.
void checkRampAlong(Trial& trial, const NamedMap& map, int axis) {
  const glm::dvec3 inside = glm::dvec3(kRampFirst) + glm::dvec3(7.3, 12.6, 9.1);
  const glm::dvec3 centre(map.worldFromIndex * glm::dvec4(inside, 1.0));
  const glm::dvec3 step(map.worldFromIndex[axis]);
  TestScene test({8, 8});
  test.grid(ramp(map.worldFromIndex), kRampScale, 0.0);
  test.orthographic(centre - 60.0 * glm::normalize(step), centre, 1e-5);
  test.scene.camera.up = glm::dvec3(map.worldFromIndex[(axis + 1) % 3]);
  double sum = 0.0;
  for (int i = 0; i < kRampVoxels; ++i) {
    sum += rampDensity(axis == kRampAxis ? kRampFirst[axis] + i : inside[kRampAxis]);
  }
  const double reference = std::exp(-kRampScale * glm::length(step) * sum);
  for (const MomentOptions& options : everyMethod({.samples = 256})) {
    const std::string name = fmt::format("{}, {}, along axis {}", nameOf(options), map.name, axis);
    trial.mean(name, trial.render(test, options), reference, kTransmittance);
  }
}

} // namespace

void checkRamp(Trial& trial) {
  const std::vector<NamedMap> maps = affineMaps();
  for (const NamedMap& map : {maps.front(), maps.back()}) {
    for (const int axis : {0, kRampAxis}) {
      checkRampAlong(trial, map, axis);
    }
  }
}

void checkVoxels(Trial& trial) {
  TestScene test({12, 12});
  test.grid(puffGrid({-3, 11, 5}), 3.0).worldFromMedium = affineMaps().back().worldFromIndex;
  const glm::dvec3 middle(test.scene.media[0].worldFromMedium * glm::dvec4(0.0, 0.0, 0.0, 1.0));
  test.perspective(middle + glm::dvec3(1.5, 0.9, 4.0), middle, 28.0);
  const OracleScene oracle(test.scene, test.volumes);
  const auto reference = oracle.transmittancePicture(8);
  for (const MomentOptions& options : everyMethod({.samples = 128})) {
    trial.compare(nameOf(options), trial.render(test, options), reference, kTransmittance, 1e-4);
  }
}

/// j (1 - exp(-sigma_a l)) / sigma_a along a slab of length l.
void checkEmission(Trial& trial) {
  scene::Emission emission;
  emission.scale = 3.0;
  emission.colour = {1.0, 0.5, 0.25};
  for (const double sigmaT : {0.5, 20.0}) {
    TestScene test({8, 8});
    test.orthographic({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}, 0.5);
    test.box(glm::dvec3(-1.0), glm::dvec3(1.0), sigmaT, 0.0).emission = emission;
    const double length = -std::expm1(-2.0 * sigmaT) / sigmaT;
    for (const MomentOptions& options : everyMethod({.samples = 256})) {
      const Moments moments = trial.render(test, options);
      for (int channel = 0; channel < 3; ++channel) {
        const std::string name = fmt::format("{}, sigma_t {}, {}", nameOf(options), sigmaT, "RGB"[channel]);
        trial.mean(name, moments, emission.scale * emission.colour[channel] * length, channel);
      }
    }
  }
}

} // namespace tyndall::verify
