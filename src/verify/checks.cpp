// SPDX-License-Identifier: Apache-2.0
#include "verify/checks.h"

#include "base/error.h"
#include "verify/families.h"

#include <algorithm>

namespace tyndall::verify {
namespace {

/// Cheap ones first. Sources are docs/theory.md's equations, and A1 to A15 of its last section.
constexpr Check kChecks[] = {
    {"airlight", "fog around a point light", "(1), table A1", checkAirlight},
    {"lit-box", "sun on a homogeneous box", "closed form A2", checkLitBox},
    {"lit-grid", "sun on a box of voxels", "(1) by quadrature", checkLitGrid},
    {"environment", "sphere of fog in an environment", "(1) by quadrature, A14", checkEnvironment},
    {"sphere-light", "fog around a shining sphere", "quadrature, A3", checkSphereLight},
    {"ramp", "depth of a linear ramp, transformed", "closed form A4", checkRamp},
    {"voxels", "transmittance of a grid, transformed", "(10) voxel by voxel, A7", checkVoxels},
    {"emission", "slab that glows", "closed form A13", checkEmission},
    {"furnace", "white media in a white world", "1 everywhere, A5", checkFurnace},
    {"furnace-grid", "the same with a grid among them", "1 everywhere, A5", checkGridFurnace},
    {"furnace-room", "white media in a closed diffuse room", "Le / (1 - rho), A5", checkRoomFurnace},
    {"half-space", "all orders of scattering", "Chandrasekhar's H, A6", checkHalfSpace},
    {"half-space-grid", "the same as a grid", "Chandrasekhar's H, A6", checkGridHalfSpace},
    {"march", "march against tracking", "the same expectation", checkMarchAgrees},
    {"path", "path against tracking", "the same expectation", checkPathAgrees},
    {"mcpg", "guided against unguided paths", "the same expectation, A9", checkGuided},
    {"mcpg-paper", "the same, guided as published", "the same expectation, A9", checkGuidedAsPublished},
    {"ray-query", "rays by the device against our tree", "the same expectation", checkRayQueries},
    {"march-bits", "march: again, cropped, chunked", "the same bits, A12", checkMarchBits},
    {"tracking-bits", "tracking: likewise, suspended", "the same bits, A12", checkTrackingBits},
    {"path-bits", "paths: likewise, suspended", "the same bits, A12", checkPathBits},
};

} // namespace

std::span<const Check> allChecks() { return kChecks; }

std::vector<std::string> checkNames() {
  std::vector<std::string> names;
  for (const Check& check : kChecks) {
    names.emplace_back(check.name);
  }
  return names;
}

std::vector<const Check*> chosenChecks(const std::vector<std::string>& names) {
  const std::vector<std::string> known = checkNames();
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      const std::string nearest = nearestName(name, known);
      fail("unknown check {}{}; the checks are {}", name,
           nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest), joinNames(known));
    }
  }
  std::vector<const Check*> chosen;
  for (const Check& check : kChecks) {
    if (names.empty() || std::find(names.begin(), names.end(), check.name) != names.end()) {
      chosen.push_back(&check);
    }
  }
  return chosen;
}

double rateOfEach(std::size_t count) { return film::sidakThreshold(kFamilyRate, double(count)); }

std::vector<Result> runChecks(const std::vector<const Check*>& checks, const gpu::Device& device,
                              const Conditions& conditions, const std::function<void(const Result&)>& ended) {
  std::vector<Result> results;
  for (const Check* check : checks) {
    results.push_back(runCheck(*check, device, conditions, rateOfEach(checks.size())));
    ended(results.back());
  }
  return results;
}

} // namespace tyndall::verify
