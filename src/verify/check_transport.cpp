// SPDX-License-Identifier: Apache-2.0
// Light that scatters any number of times, where the answer is known: white furnaces and half-spaces.
#include "verify/families.h"
#include "verify/references.h"

#include <fmt/format.h>

namespace tyndall::verify {
namespace {

using render::Method;

PathScene furnace() {
  PathScene test;
  test.perspective({0.0, 0.0, 4.0}, {0.0, 0.0, 0.0}, 30.0);
  test.constant(1.0);
  return test;
}

void checkWhite(Trial& trial, const PathScene& test, double radiance) {
  trial.mean("path", trial.render(test, by(Method::Path, {.samples = 64})), radiance);
}

void checkHalfSpaces(Trial& trial, bool asGrid) {
  for (const std::size_t row : {0u, 1u}) {
    const HalfSpace& reference = kHalfSpaces[row];
    const Moments moments = trial.render(halfSpace(reference, asGrid), by(Method::Path, {.samples = 96}));
    for (int channel = 0; channel < 3; ++channel) {
      const std::string name =
          fmt::format("out {}, in {}, albedo {}", reference.out, reference.in, reference.albedo[channel]);
      trial.mean(name, moments, reference.radiance[channel], channel);
    }
  }
}

} // namespace

void checkFurnace(Trial& trial) {
  PathScene test = furnace();
  test.sphere({0.2, 0.1, 0.0}, 0.9, 2.0).phase = henyeyGreenstein(0.8);
  test.box({-0.9, -0.9, -0.4}, {0.1, 0.3, 0.9}, 0.7).phase = {PhaseId::Rayleigh, {}};
  checkWhite(trial, test, 1.0);
}

void checkGridFurnace(Trial& trial) {
  PathScene test = furnace();
  addWhiteMedia(test);
  checkWhite(trial, test, 1.0);
}

void checkRoomFurnace(Trial& trial) { checkWhite(trial, whiteRoom(), 2.0); }

void checkHalfSpace(Trial& trial) { checkHalfSpaces(trial, false); }

void checkGridHalfSpace(Trial& trial) { checkHalfSpaces(trial, true); }

} // namespace tyndall::verify
