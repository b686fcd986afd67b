// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "light/atmosphere.h"

#include <cstdint>
#include <random>

namespace tyndall::light {

/// A mean of random samples and its standard error.
struct MonteCarloMean {
  double mean = 0.0;
  double error = 0.0;
};

/// Brute force: paths of any length by delta tracking in the same atmosphere, at one wavelength, with the phase
/// functions of air and haze. Knows neither the sky's quadratures nor its tables, but for the sun's column.
class SkyMonteCarlo {
public:
  SkyMonteCarlo(const Atmosphere& atmosphere, std::size_t wavelength, double groundAlbedo, const glm::dvec3& toSun)
      : atmosphere_(atmosphere), wavelength_(wavelength), groundAlbedo_(groundAlbedo), toSun_(toSun) {}

  /// Radiance that arrives at a point of the +y axis from the way w. @param orders 1: single scattering.
  MonteCarloMean radiance(double radius, const glm::dvec3& w, int orders, int samples);
  /// Irradiance of the sky on a level plane 200 m above the ground. @param firstOrder orders below it do not count.
  MonteCarloMean irradiance(int firstOrder, int samples);
  /// Mean over the sphere of the light of the first event, with isotropic phase functions: L_2nd of [Hillaire20].
  MonteCarloMean isotropicFirst(double radius, int samples);
  /// Mean over the sphere of what comes back at the first event where all is lit by radiance 1: f_ms.
  MonteCarloMean isotropicAgain(double radius, int samples);

private:
  struct Event {
    bool escaped = false;
    bool ground = false;
    glm::dvec3 position{0.0};
    double air = 0.0;        ///< scattering coefficients
    double haze = 0.0;
    double extinction = 1.0;
  };

  double uniform() { return uniform_(engine_); }
  glm::dvec3 uniformDirection();
  glm::dvec3 around(const glm::dvec3& axis, double cosine);
  Event nextEvent(const glm::dvec3& from, const glm::dvec3& w);
  double sunlight(const glm::dvec3& position) const;
  double path(glm::dvec3 position, glm::dvec3 w, int firstOrder, int lastOrder);
  glm::dvec3 scatter(const Event& event, const glm::dvec3& w, double& throughput);

  const Atmosphere& atmosphere_;
  std::size_t wavelength_;
  double groundAlbedo_;
  glm::dvec3 toSun_;
  std::mt19937_64 engine_{20240917};
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
};

} // namespace tyndall::light
