// SPDX-License-Identifier: Apache-2.0
// Different ways to the same picture: estimators that share no distances, lights or shadows; guided paths and others;
// two ways to cast rays.
#include "guide/store.h"
#include "verify/families.h"

#include <fmt/format.h>

#include <memory>

namespace tyndall::verify {
namespace {

using render::Method;
using scene::Integrator;

/// Seeds of the second of two pictures.
constexpr std::uint32_t kOtherSeeds = 100'001;
constexpr double kStoreBytes = 16e6;

/// A puff without symmetry under a sun and a lamp, four tiles.
TestScene puff() {
  TestScene test({32, 32});
  test.perspective({1.0, 0.5, 4.0}, {0.0, 0.0, 0.0}, 26.0);
  test.grid(puffGrid(), 4.0, 0.9).phase = henyeyGreenstein(0.6);
  test.sun({0.4, -1.0, -0.3}, 1.0, 10.0);
  test.point({1.5, 1.0, 0.5}, 2.0);
  return test;
}

void checkAgainstTracking(Trial& trial, const TestScene& test, const MomentOptions& options, std::uint32_t samples) {
  const Moments tracking = trial.render(test, by(Method::Tracking, {.samples = samples}));
  trial.agree(nameOf(options), trial.render(test, options), tracking);
}

/// Fog over a floor and a wall; a box and a ball stand between a lamp and parts of them.
PathScene room() {
  PathScene test({32, 32});
  test.depth(3);
  test.perspective({0.4, 0.9, 4.0}, {0.0, 0.1, 0.0}, 36.0);
  test.material("white", MaterialId::Diffuse, 0.7);
  test.lamp("lamp", 3.0);
  test.quad("lamp", {-3.0, 1.6, -1.5}, {6.0, 0.0, 0.0}, {0.0, 0.0, 4.0});
  test.quad("white", {-4.0, -1.0, 3.0}, {8.0, 0.0, 0.0}, {0.0, 0.0, -6.0});
  test.quad("white", {-4.0, -1.0, -1.5}, {8.0, 0.0, 0.0}, {0.0, 5.0, 0.0});
  test.crate("white", {-0.8, 0.2, -0.6}, {0.0, 0.4, 0.3});
  test.ball("white", {0.7, -0.5, 0.3}, 0.5);
  test.box({-2.0, -1.0, -1.5}, {2.0, 1.4, 1.5}, 0.3, 0.9).phase = henyeyGreenstein(0.3);
  return test;
}

/// Paths that the store guides, which learns from replicate to replicate. Given what it holds each one is unbiased, so
/// that they are uncorrelated. What is checked must not switch itself off.
MomentOptions guidedBy(const gpu::Device& device, Integrator integrator, const glm::uvec2& size,
                       MomentOptions options) {
  scene::GuideSettings settings = scene::guideSettings(integrator);
  settings.watch = false;
  const guide::StoreSize storeSize = guide::storeSize(settings, size, kStoreBytes);
  options.estimator.guide =
      render::GuidePlan{.settings = settings, .store = std::make_shared<guide::Store>(device, storeSize)};
  return options;
}

void checkGuidedPaths(Trial& trial, Integrator integrator) {
  const PathScene test = room();
  const Moments reference = trial.render(test, by(Method::Path, {.samples = 8}));
  for (const bool lightSamples : {true, false}) {
    MomentOptions options = by(Method::Path, {.samples = 8, .firstSeed = kOtherSeeds});
    if (!lightSamples) {
      options.estimator.techniques = interop::kTechniqueDirection;
    }
    options = guidedBy(trial.device(), integrator, test.scene.film.size, options);
    trial.agree(fmt::format("light samples {}", lightSamples ? "on" : "off"), trial.render(test, options), reference);
  }
}

} // namespace

/// Without an environment, whose directions all pixels of the march share: noise that hides its other errors.
void checkMarchAgrees(Trial& trial) {
  checkAgainstTracking(trial, puff(), by(Method::March, {.firstSeed = kOtherSeeds}), 64);
}

void checkPathAgrees(Trial& trial) {
  TestScene test = puff();
  test.constant(1.0);
  checkAgainstTracking(trial, test, by(Method::Path, {.samples = 32, .firstSeed = kOtherSeeds}), 32);
}

void checkGuided(Trial& trial) { checkGuidedPaths(trial, Integrator::Mcpg); }

void checkGuidedAsPublished(Trial& trial) { checkGuidedPaths(trial, Integrator::McpgPaper); }

void checkRayQueries(Trial& trial) {
  if (!trial.device().info().rayQuery) {
    trial.skip("the device has no ray queries; our own tree casts all rays");
    return;
  }
  const PathScene test = room();
  MomentOptions options = by(Method::Path, {.samples = 8});
  options.estimator.rays = render::RayCaster::Tree;
  const Moments tree = trial.render(test, options);
  options.estimator.rays = render::RayCaster::Query;
  options.firstSeed = kOtherSeeds;
  trial.agree("queries", trial.render(test, options), tree);
}

} // namespace tyndall::verify
