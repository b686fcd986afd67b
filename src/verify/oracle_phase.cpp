// SPDX-License-Identifier: Apache-2.0
#include "verify/oracle_phase.h"

#include "light/mie.h"

#include <cmath>
#include <numbers>

namespace tyndall::verify {
namespace {

constexpr double kFourPi = 4.0 * std::numbers::pi;

/// [Henyey41] eq. (2)
double henyeyGreenstein(double g, double cosine) {
  return (1.0 - g * g) / kFourPi / std::pow(1.0 + g * g - 2.0 * g * cosine, 1.5);
}

/// [Draine03] eq. (6), normalised
double draine(double g, double alpha, double cosine) {
  return henyeyGreenstein(g, cosine) * (1.0 + alpha * cosine * cosine) / (1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0);
}

double mie(double diameter, double cosine) {
  const glm::dvec4 fit(light::mieParameters(diameter));
  return (1.0 - fit.w) * henyeyGreenstein(fit.x, cosine) + fit.w * draine(fit.y, fit.z, cosine);
}

} // namespace

double phaseOracle(const scene::Phase& phase, double cosine) {
  const auto& parameters = phase.parameters;
  switch (phase.id) {
  case PhaseId::Isotropic: return 1.0 / kFourPi;
  case PhaseId::HenyeyGreenstein: return henyeyGreenstein(parameters[0], cosine);
  case PhaseId::TwoLobe:
    return parameters[2] * henyeyGreenstein(parameters[0], cosine) + (1.0 - parameters[2]) * henyeyGreenstein(parameters[1], cosine);
  case PhaseId::Rayleigh: return 3.0 / (4.0 * kFourPi) * (1.0 + cosine * cosine);
  case PhaseId::Draine: return draine(parameters[0], parameters[1], cosine);
  case PhaseId::Mie: return mie(parameters[0], cosine);
  }
  return 0.0;
}

} // namespace tyndall::verify
