// SPDX-License-Identifier: Apache-2.0
// Light that scatters once, against closed forms and quadrature.
#include "verify/families.h"
#include "verify/oracle_radiance.h"
#include "verify/oracle_sphere.h"
#include "verify/references.h"

#include <fmt/format.h>

#include <iterator>

namespace tyndall::verify {

using render::Method;

void checkAirlight(Trial& trial) {
  const auto checkRow = [&](std::size_t row, const MomentOptions& options) {
    const Moments moments = trial.render(airlight(kAirlightRows[row]), options);
    trial.mean(fmt::format("{}, row {}", nameOf(options), row + 1), moments, kAirlightRows[row].radiance);
  };
  for (std::size_t row = 0; row < std::size(kAirlightRows); ++row) {
    checkRow(row, by(Method::March));
    checkRow(row, by(Method::Tracking, {.samples = 64}));
  }
  for (const std::size_t row : {1u, 4u, 8u}) { // paths take the longest to compile
    checkRow(row, by(Method::Path, {.samples = 64}));
  }
}

void checkLitBox(Trial& trial) {
  const auto checkDensity = [&](double sigmaT, const MomentOptions& options) {
    TestScene test = litBox();
    test.box(glm::dvec3(-1.0), glm::dvec3(1.0), sigmaT, 0.8);
    const Moments moments = trial.render(test, options);
    trial.compare(fmt::format("{}, sigma_t {}", nameOf(options), sigmaT), moments,
                  litBoxReference(test.scene.film.size, sigmaT, 0.8, 3.0));
  };
  for (const double sigmaT : {0.01, 1.0, 6.0}) {
    checkDensity(sigmaT, by(Method::March));
    checkDensity(sigmaT, by(Method::Tracking, {.samples = 64}));
  }
  checkDensity(1.0, by(Method::Path, {.samples = 128}));
}

/// Voxels whose field falls to 0 over the last one. Its kinks lie on the edges of pixels, so that a rule of few nodes
/// integrates the footprints.
void checkLitGrid(Trial& trial) {
  TestScene test = litBox();
  test.scene.film.size = {8, 8};
  test.grid(constantGrid(7, glm::dvec3(-0.75), glm::dvec3(0.75), 1.0), 1.4, 0.8);
  const OracleScene oracle(test.scene, test.volumes, {.relative = 1e-6});
  const auto reference = oracle.picture([&](const OracleRay& ray) { return oracle.radiance(ray); }, 5);
  for (const MomentOptions& options : everyMethod({.samples = 256})) {
    trial.compare(nameOf(options), trial.render(test, options), reference, 0, 1e-4);
  }
}

void checkEnvironment(Trial& trial) {
  TestScene test({4, 4});
  test.orthographic({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}, 1.2);
  test.sphere(glm::dvec3(0.0), 1.0, 1.1, 0.7).phase = henyeyGreenstein(0.6);
  test.constant(2.0);
  const OracleScene oracle(test.scene, test.volumes, {.relative = 1e-5, .polarNodes = 20, .azimuths = 12});
  const auto reference = oracle.picture([&](const OracleRay& ray) { return oracle.total(ray); }, 4);
  for (const Method method : {Method::March, Method::Tracking, Method::Path}) {
    const MomentOptions options = by(method, {.samples = 256}); // the march's directions are noisy too
    trial.compare(nameOf(options), trial.render(test, options), reference, 0, 1e-4);
  }
}

void checkSphereLight(Trial& trial) {
  const BallInFog ball;
  const PathScene test = ball.withLamp();
  const double reference = ball.lampRadiance();
  const auto with = [&](const char* name, std::uint32_t techniques, std::uint32_t samples) {
    MomentOptions options = by(Method::Path, {.samples = samples});
    options.estimator.techniques = techniques;
    trial.mean(name, trial.render(test, options), reference);
  };
  with("light samples", interop::kTechniqueLight, 256);
  with("directions", interop::kTechniqueDirection, 1024);
  with("both", interop::kTechniqueLight | interop::kTechniqueDirection, 256);
}

} // namespace tyndall::verify
