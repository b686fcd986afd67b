// SPDX-License-Identifier: Apache-2.0
#include "sky_monte_carlo.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tyndall::light {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kHazeG = 0.76;

double airPhase(double cosine) { return 3.0 / (16.0 * kPi) * (1.0 + cosine * cosine); }
double hazePhase(double cosine) {
  return (1.0 - kHazeG * kHazeG) / (4.0 * kPi * std::pow(1.0 + kHazeG * kHazeG - 2.0 * kHazeG * cosine, 1.5));
}

template <typename Sample> MonteCarloMean meanOf(int samples, Sample&& sample) {
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < samples; ++i) {
    const double value = sample();
    sum += value;
    squares += value * value;
  }
  const double mean = sum / samples;
  return {mean, std::sqrt(std::max(0.0, squares / samples - mean * mean) / samples)};
}

} // namespace

glm::dvec3 SkyMonteCarlo::around(const glm::dvec3& axis, double cosine) {
  const glm::dvec3 other = std::abs(axis.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 u = glm::normalize(glm::cross(axis, other));
  const glm::dvec3 v = glm::cross(axis, u);
  const double angle = 2.0 * kPi * uniform();
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  return glm::normalize(cosine * axis + sine * (std::cos(angle) * u + std::sin(angle) * v));
}

glm::dvec3 SkyMonteCarlo::uniformDirection() { return around({0.0, 1.0, 0.0}, 2.0 * uniform() - 1.0); }

SkyMonteCarlo::Event SkyMonteCarlo::nextEvent(const glm::dvec3& from, const glm::dvec3& w) {
  const double radius = glm::length(from);
  const double mu = glm::dot(from, w) / radius;
  double groundDistance = 0.0;
  const bool ground = Atmosphere::hitsGround(radius, mu, groundDistance);
  const double length = ground ? groundDistance : Atmosphere::distanceToTop(radius, mu);
  // Air and haze are densest at the ground, ozone at its peak.
  const double majorant = atmosphere_.extinction(glm::dvec3(1.0))[wavelength_];
  for (double distance = 0.0;;) {
    distance -= std::log(1.0 - uniform()) / majorant;
    if (distance >= length) {
      return {.escaped = !ground, .ground = ground, .position = from + length * w};
    }
    const glm::dvec3 position = from + distance * w;
    const glm::dvec3 density = Atmosphere::densityAt(glm::length(position));
    const double extinction = atmosphere_.extinction(density)[wavelength_];
    if (uniform() * majorant < extinction) {
      return {false, false, position, density.x * atmosphere_.airScattering()[wavelength_],
              density.y * atmosphere_.hazeScattering()[wavelength_], extinction};
    }
  }
}

double SkyMonteCarlo::sunlight(const glm::dvec3& position) const {
  const double radius = std::max(glm::length(position), Atmosphere::kGroundRadius);
  return atmosphere_.sunTransmittance(radius, glm::dot(position, toSun_) / radius)[wavelength_];
}

glm::dvec3 SkyMonteCarlo::scatter(const Event& event, const glm::dvec3& w, double& throughput) {
  throughput *= (event.air + event.haze) / event.extinction;
  if (uniform() * (event.air + event.haze) < event.air) {
    const glm::dvec3 out = uniformDirection();
    throughput *= 4.0 * kPi * airPhase(glm::dot(w, out));
    return out;
  }
  const double part = (1.0 - kHazeG * kHazeG) / (1.0 - kHazeG + 2.0 * kHazeG * uniform());
  return around(w, (1.0 + kHazeG * kHazeG - part * part) / (2.0 * kHazeG));
}

double SkyMonteCarlo::path(glm::dvec3 position, glm::dvec3 w, int firstOrder, int lastOrder) {
  double sum = 0.0;
  double throughput = 1.0;
  for (int order = 1; order <= lastOrder && throughput > 0.0; ++order) {
    const Event event = nextEvent(position, w);
    if (event.escaped) {
      break;
    }
    double direct = 0.0;
    const glm::dvec3 normal = glm::normalize(event.position);
    const double cosine = glm::dot(w, toSun_);
    if (event.ground) {
      throughput *= groundAlbedo_;
      direct = std::max(glm::dot(normal, toSun_), 0.0) / kPi;
      const double up = std::sqrt(uniform());
      w = around(normal, up);
      position = normal * (Atmosphere::kGroundRadius + 1e-6);
    } else {
      direct = (event.air * airPhase(cosine) + event.haze * hazePhase(cosine)) / (event.air + event.haze);
      direct *= (event.air + event.haze) / event.extinction;
      position = event.position;
    }
    sum += order >= firstOrder ? throughput * direct * sunlight(event.position) : 0.0;
    if (!event.ground) {
      w = scatter(event, w, throughput);
    }
  }
  return sum;
}

MonteCarloMean SkyMonteCarlo::radiance(double radius, const glm::dvec3& w, int orders, int samples) {
  return meanOf(samples, [&] { return path({0.0, radius, 0.0}, w, 1, orders); });
}

MonteCarloMean SkyMonteCarlo::irradiance(int firstOrder, int samples) {
  return meanOf(samples, [&] {
    const glm::dvec3 w = around({0.0, 1.0, 0.0}, std::sqrt(uniform()));
    return kPi * path({0.0, Atmosphere::kGroundRadius + 0.2, 0.0}, w, firstOrder, 1000);
  });
}

MonteCarloMean SkyMonteCarlo::isotropicFirst(double radius, int samples) {
  return meanOf(samples, [&] {
    const Event event = nextEvent({0.0, radius, 0.0}, uniformDirection());
    const double muSun = glm::dot(glm::normalize(event.position), toSun_);
    const double albedo = event.ground ? 4.0 * std::max(muSun, 0.0) * groundAlbedo_ : (event.air + event.haze) / event.extinction;
    return event.escaped ? 0.0 : albedo / (4.0 * kPi) * sunlight(event.position);
  });
}

MonteCarloMean SkyMonteCarlo::isotropicAgain(double radius, int samples) {
  return meanOf(samples, [&] {
    const Event event = nextEvent({0.0, radius, 0.0}, uniformDirection());
    const double albedo = event.ground ? groundAlbedo_ : (event.air + event.haze) / event.extinction;
    return event.escaped ? 0.0 : albedo;
  });
}

} // namespace tyndall::light
