// SPDX-License-Identifier: Apache-2.0
#include "light/atmosphere.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tyndall::light {
namespace {

// [Bruneton17] "Precomputed Atmospheric Scattering: a New Implementation", for air and the ozone layer's profile.
constexpr double kAirAtMicrometre = 1.24062e-3; // scattering at sea level [1/km], times wavelength^-4
constexpr double kAirScaleHeight = 8.0;         // km
constexpr double kHazeScaleHeight = 1.2;        // km
constexpr double kHazeAlbedo = 0.95;            // between continental average and clean, [Hess98] OPAC
constexpr double kAngstromExponent = 1.3;       // haze ~ wavelength^-1.3, [Angstrom29]
constexpr double kOzoneCentre = 25.0;           // km
constexpr double kOzoneHalfWidth = 15.0;        // km
// Cross-sections at 233 K [m2], means over 20 nm, [Serdyuchenko14]; 300 Dobson units spread over the layer.
constexpr std::array<double, kSkyWavelengths> kOzoneCrossSection{2.1e-27,  1.95e-26, 8.4e-26,  2.45e-25,
                                                                 4.47e-25, 4.66e-25, 2.45e-25, 1.08e-25};
constexpr double kOzonePeak = 300.0 * 2.687e20 / kOzoneHalfWidth; // molecules / (m2 km)
constexpr double kSunAngularRadius = 0.2665 * std::numbers::pi / 180.0;

// Gauss-Legendre on [0, 1] and the integrals of its Lagrange polynomials from 0 to each node.
struct Gauss4 {
  std::array<double, 4> node{0.069431844202974, 0.330009478207572, 0.669990521792428, 0.930568155797026};
  std::array<double, 4> weight{0.173927422568727, 0.326072577431273, 0.326072577431273, 0.173927422568727};
  std::array<std::array<double, 4>, 4> upTo{};

  Gauss4() {
    // Integrates each cubic exactly with the rule itself, scaled to [0, node].
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        for (std::size_t q = 0; q < 4; ++q) {
          upTo[i][j] += node[i] * weight[q] * lagrange(j, node[i] * node[q]);
        }
      }
    }
  }

  double lagrange(std::size_t j, double x) const {
    double value = 1.0;
    for (std::size_t k = 0; k < 4; ++k) {
      value *= k == j ? 1.0 : (x - node[k]) / (node[j] - node[k]);
    }
    return value;
  }
};

double radiusAlong(double radius, double mu, double distance) {
  return std::sqrt(radius * radius + distance * (distance + 2.0 * radius * mu));
}

} // namespace

Atmosphere::Atmosphere(double turbidity) {
  const double airDepth = kAirAtMicrometre / std::pow(0.55, 4.0) * kAirScaleHeight;
  const double hazeAt550 = (turbidity - 1.0) * airDepth / kHazeScaleHeight;
  for (std::size_t i = 0; i < kSkyWavelengths; ++i) {
    const double micrometres = skyNanometres(i) * 1e-3;
    airScattering_[i] = kAirAtMicrometre / std::pow(micrometres, 4.0);
    hazeExtinction_[i] = hazeAt550 * std::pow(micrometres / 0.55, -kAngstromExponent);
    hazeScattering_[i] = kHazeAlbedo * hazeExtinction_[i];
    ozoneAbsorption_[i] = kOzonePeak * kOzoneCrossSection[i];
  }
  fillTable();
}

glm::dvec3 Atmosphere::densityAt(double radius) {
  const double height = std::max(radius - kGroundRadius, 0.0);
  const double fromCentre = (height - kOzoneCentre) / kOzoneHalfWidth;
  // [Bruneton17] has a tent; a raised cosine of the same column and width has no kinks for the quadratures to miss.
  const double ozone = std::abs(fromCentre) < 1.0 ? 0.5 + 0.5 * std::cos(std::numbers::pi * fromCentre) : 0.0;
  return {std::exp(-height / kAirScaleHeight), std::exp(-height / kHazeScaleHeight), ozone};
}

SkySpectrum Atmosphere::extinction(const glm::dvec3& density) const {
  SkySpectrum result;
  for (std::size_t i = 0; i < kSkyWavelengths; ++i) {
    result[i] = density.x * airScattering_[i] + density.y * hazeExtinction_[i] + density.z * ozoneAbsorption_[i];
  }
  return result;
}

SkySpectrum Atmosphere::transmittance(const glm::dvec3& column) const {
  SkySpectrum result = extinction(column);
  for (double& value : result.at) {
    value = std::exp(-value);
  }
  return result;
}

double Atmosphere::distanceToTop(double radius, double mu) {
  const double discriminant = radius * radius * (mu * mu - 1.0) + kTopRadius * kTopRadius;
  return std::max(0.0, -radius * mu + std::sqrt(std::max(discriminant, 0.0)));
}

bool Atmosphere::hitsGround(double radius, double mu, double& distance) {
  const double discriminant = radius * radius * (mu * mu - 1.0) + kGroundRadius * kGroundRadius;
  if (mu >= 0.0 || discriminant < 0.0) {
    return false;
  }
  distance = std::max(0.0, -radius * mu - std::sqrt(discriminant));
  return true;
}

std::vector<Atmosphere::Node> Atmosphere::march(double radius, double mu, double length, int segments, glm::dvec3& total) {
  static const Gauss4 gauss;
  std::vector<Node> nodes(static_cast<std::size_t>(segments) * 4);
  total = glm::dvec3(0.0);
  // distance = length * s^2 or s^3. Every node's column is spectrally accurate.
  const bool rising = mu >= 0.0;
  for (int segment = 0; segment < segments; ++segment) {
    Node* node = &nodes[static_cast<std::size_t>(segment) * 4];
    for (std::size_t i = 0; i < 4; ++i) {
      const double s = (segment + gauss.node[i]) / segments;
      node[i].distance = length * s * s * (rising ? s : 1.0);
      node[i].weight = gauss.weight[i] * length * (rising ? 3.0 * s * s : 2.0 * s) / segments;
      node[i].density = densityAt(radiusAlong(radius, mu, node[i].distance));
    }
    glm::dvec3 column(0.0);
    for (std::size_t i = 0; i < 4; ++i) {
      node[i].column = total;
      for (std::size_t j = 0; j < 4; ++j) {
        node[i].column += node[j].density * (node[j].weight / gauss.weight[j] * gauss.upTo[i][j]);
      }
      column += node[i].density * node[i].weight;
    }
    total += column;
  }
  return nodes;
}

/// [Bruneton17]: the distance to the top, relative to the shortest and longest there are, varies smoothly.
glm::dvec2 Atmosphere::tableCoordinates(double radius, double mu) {
  const double rim = std::sqrt(kTopRadius * kTopRadius - kGroundRadius * kGroundRadius);
  const double rho = std::sqrt(std::max(0.0, radius * radius - kGroundRadius * kGroundRadius));
  const double shortest = kTopRadius - radius;
  const double longest = rho + rim;
  const double u = (distanceToTop(radius, mu) - shortest) / (longest - shortest);
  return glm::clamp(glm::dvec2(u, rho / rim), 0.0, 1.0);
}

void Atmosphere::fillTable() {
  tableSize_ = {160, 320};
  table_.resize(std::size_t(tableSize_.x) * tableSize_.y);
  const double rim = std::sqrt(kTopRadius * kTopRadius - kGroundRadius * kGroundRadius);
  tbb::parallel_for(0u, tableSize_.y, [&](unsigned row) {
    const double rho = rim * row / (tableSize_.y - 1);
    const double radius = std::sqrt(rho * rho + kGroundRadius * kGroundRadius);
    const double shortest = kTopRadius - radius;
    for (unsigned column = 0; column < tableSize_.x; ++column) {
      const double distance = shortest + (rho + rim - shortest) * column / (tableSize_.x - 1);
      const double mu = distance > 0.0 ? (kTopRadius * kTopRadius - radius * radius - distance * distance) / (2.0 * radius * distance) : 1.0;
      glm::dvec3 total;
      march(radius, std::clamp(mu, -1.0, 1.0), distance, 8, total);
      table_[std::size_t(row) * tableSize_.x + column] = total;
    }
  });
}

glm::dvec3 Atmosphere::columnToTop(double radius, double mu) const {
  const glm::dvec2 place = tableCoordinates(radius, mu) * glm::dvec2(tableSize_ - 1u);
  const glm::uvec2 low = glm::min(glm::uvec2(place), tableSize_ - 2u);
  const glm::dvec2 weight = place - glm::dvec2(low);
  const glm::dvec3* row = &table_[std::size_t(low.y) * tableSize_.x + low.x];
  return glm::mix(glm::mix(row[0], row[1], weight.x),
                  glm::mix(row[tableSize_.x], row[tableSize_.x + 1], weight.x), weight.y);
}

Atmosphere::SunPath Atmosphere::sunPath(double radius, double muSun) const {
  const double sine = std::clamp(kGroundRadius / radius, 0.0, 1.0);
  const double horizonMu = -std::sqrt(1.0 - sine * sine);
  // Cosines differ by no more than the angles do: above this the whole disc is up.
  if (muSun > horizonMu + kSunAngularRadius) {
    return {1.0, columnToTop(radius, muSun)};
  }
  // How far the disc's centre stands above the horizon, in radii of the disc.
  const double elevation = std::asin(std::clamp(muSun, -1.0, 1.0)) - std::asin(horizonMu);
  const double x = elevation / kSunAngularRadius;
  if (x <= -1.0) {
    return {};
  }
  // Area of a disc above a chord at -x.
  const double inside = std::min(x, 1.0);
  const double visible = 0.5 + (inside * std::sqrt(1.0 - inside * inside) + std::asin(inside)) / std::numbers::pi;
  return {visible, columnToTop(radius, std::max(muSun, horizonMu))};
}

SkySpectrum Atmosphere::sunTransmittance(double radius, double muSun) const {
  const SunPath path = sunPath(radius, muSun);
  return path.visible > 0.0 ? path.visible * transmittance(path.column) : SkySpectrum{};
}

} // namespace tyndall::light
