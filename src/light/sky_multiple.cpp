// SPDX-License-Identifier: Apache-2.0
#include "light/sky_multiple.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tyndall::light {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr unsigned kSuns = 41;   // odd: one with the sun on the horizon
constexpr unsigned kHeights = 16;
constexpr int kAzimuths = 3;     // midpoints of [0, pi]
constexpr int kSegments = 4;

// Gauss-Legendre on [-1, 1], positive half of six points.
constexpr std::array<double, 3> kGaussNode{0.238619186083197, 0.661209386466265, 0.932469514203152};
constexpr std::array<double, 3> kGaussWeight{0.467913934572691, 0.360761573048139, 0.171324492379170};

// Denser near the ground and where the sun sets.
double heightOf(double place) { return place * place * place * (Atmosphere::kTopRadius - Atmosphere::kGroundRadius); }
double placeOfHeight(double height) {
  return std::cbrt(std::clamp(height / (Atmosphere::kTopRadius - Atmosphere::kGroundRadius), 0.0, 1.0));
}
double muOf(double place) { return std::copysign((2.0 * place - 1.0) * (2.0 * place - 1.0), place - 0.5); }
double placeOfMu(double mu) { return std::clamp(0.5 + 0.5 * std::copysign(std::sqrt(std::abs(mu)), mu), 0.0, 1.0); }

} // namespace

/// A direction of the sphere's quadrature and what lies that way.
struct MultipleScattering::Ray {
  double mu = 0.0;
  double weight = 0.0; ///< part of the sphere
  std::vector<Atmosphere::Node> nodes;
  std::vector<SkySpectrum> arriving; ///< per node: scattering coefficient x transmittance x step
  bool ground = false;
  double groundDistance = 0.0;
  SkySpectrum groundTransmittance;
};

MultipleScattering::MultipleScattering(const Atmosphere& atmosphere, const SkySpectrum& groundAlbedo)
    : atmosphere_(atmosphere), groundAlbedo_(groundAlbedo), table_(std::size_t(kSuns) * kHeights) {
  tbb::parallel_for(0u, kHeights, [this](unsigned row) { fillHeight(row); });
}

void MultipleScattering::fillHeight(unsigned row) {
  const double radius = Atmosphere::kGroundRadius + heightOf(double(row) / (kHeights - 1));
  const std::vector<Ray> rays = raysFrom(radius);
  SkySpectrum again; // f_ms of [Hillaire20] eq. (8)
  for (const Ray& ray : rays) {
    again += ray.weight * returned(ray);
  }
  for (unsigned column = 0; column < kSuns; ++column) {
    const double muSun = muOf(double(column) / (kSuns - 1));
    SkySpectrum once; // L_2nd of eq. (6)
    for (const Ray& ray : rays) {
      once += ray.weight * firstEvent(ray, radius, muSun);
    }
    SkySpectrum& all = table_[std::size_t(row) * kSuns + column]; // eq. (10)
    for (std::size_t i = 0; i < kSkyWavelengths; ++i) {
      all[i] = once[i] / (1.0 - again[i]);
    }
  }
}

std::vector<MultipleScattering::Ray> MultipleScattering::raysFrom(double radius) const {
  // The integrand breaks at the horizon: a rule on each side of it.
  const double sine = Atmosphere::kGroundRadius / radius;
  const double horizonMu = -std::sqrt(std::max(0.0, 1.0 - sine * sine));
  std::vector<Ray> rays;
  for (const bool above : {true, false}) {
    const double middle = 0.5 * (horizonMu + (above ? 1.0 : -1.0));
    const double half = std::abs(middle - horizonMu);
    for (std::size_t i = 0; i < 6; ++i) {
      const double sign = i < 3 ? 1.0 : -1.0;
      Ray ray;
      ray.mu = middle + sign * half * kGaussNode[i % 3];
      ray.weight = 0.5 * half * kGaussWeight[i % 3];
      ray.ground = Atmosphere::hitsGround(radius, ray.mu, ray.groundDistance);
      const double length = ray.ground ? ray.groundDistance : Atmosphere::distanceToTop(radius, ray.mu);
      glm::dvec3 total;
      ray.nodes = Atmosphere::march(radius, ray.mu, length, kSegments, total);
      ray.groundTransmittance = ray.ground ? atmosphere_.transmittance(total) : SkySpectrum{};
      for (const Atmosphere::Node& node : ray.nodes) {
        const SkySpectrum scattering =
            node.density.x * atmosphere_.airScattering() + node.density.y * atmosphere_.hazeScattering();
        ray.arriving.push_back(node.weight * scattering * atmosphere_.transmittance(node.column));
      }
      rays.push_back(std::move(ray));
    }
  }
  return rays;
}

/// Radiance along a ray if all that it meets is lit by radiance 1 from everywhere.
SkySpectrum MultipleScattering::returned(const Ray& ray) const {
  SkySpectrum sum = groundAlbedo_ * ray.groundTransmittance;
  for (const SkySpectrum& arriving : ray.arriving) {
    sum += arriving;
  }
  return sum;
}

/// Radiance along a ray of sunlight scattered isotropically or reflected once, mean over the azimuth.
SkySpectrum MultipleScattering::firstEvent(const Ray& ray, double radius, double muSun) const {
  SkySpectrum sum;
  for (int i = 0; i < kAzimuths; ++i) {
    const double horizontal = std::sqrt((1.0 - ray.mu * ray.mu) * (1.0 - muSun * muSun));
    const double cosine = ray.mu * muSun + horizontal * std::cos(kPi * (i + 0.5) / kAzimuths);
    for (std::size_t n = 0; n < ray.nodes.size(); ++n) {
      const double distance = ray.nodes[n].distance;
      const double squared = radius * radius + distance * (distance + 2.0 * radius * ray.mu);
      const double there = std::clamp(std::sqrt(squared), Atmosphere::kGroundRadius, Atmosphere::kTopRadius);
      const Atmosphere::SunPath sun = atmosphere_.sunPath(there, (radius * muSun + distance * cosine) / there);
      if (sun.visible > 0.0) {
        sum += sun.visible / (4.0 * kPi) * ray.arriving[n] * atmosphere_.transmittance(sun.column);
      }
    }
    const double groundMu = (radius * muSun + ray.groundDistance * cosine) / Atmosphere::kGroundRadius;
    if (ray.ground && groundMu > 0.0) {
      const SkySpectrum irradiance = groundMu * atmosphere_.sunTransmittance(Atmosphere::kGroundRadius, groundMu);
      sum += 1.0 / kPi * groundAlbedo_ * ray.groundTransmittance * irradiance;
    }
  }
  return 1.0 / kAzimuths * sum;
}

SkySpectrum MultipleScattering::at(double radius, double muSun) const {
  const glm::dvec2 place = glm::dvec2(placeOfMu(muSun), placeOfHeight(radius - Atmosphere::kGroundRadius)) *
                           glm::dvec2(kSuns - 1, kHeights - 1);
  const glm::uvec2 low = glm::min(glm::uvec2(place), glm::uvec2(kSuns - 2, kHeights - 2));
  const glm::dvec2 weight = place - glm::dvec2(low);
  const SkySpectrum* row = &table_[std::size_t(low.y) * kSuns + low.x];
  return (1.0 - weight.y) * ((1.0 - weight.x) * row[0] + weight.x * row[1]) +
         weight.y * ((1.0 - weight.x) * row[kSuns] + weight.x * row[kSuns + 1]);
}

} // namespace tyndall::light
