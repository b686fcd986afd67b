// SPDX-License-Identifier: Apache-2.0
#include "light/atmosphere.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tyndall::light {
namespace {

// [Bruneton17] "Precomputed Atmospheric Scattering: a New Implementation", and [Hillaire20] for ozone.
const glm::dvec3 kAirScattering{5.802e-3, 13.558e-3, 33.1e-3}; // at sea level [1/km]
const glm::dvec3 kOzoneAbsorption{0.650e-3, 1.881e-3, 0.085e-3}; // at the layer's peak [1/km]
constexpr double kAirScaleHeight = 8.0;   // km
constexpr double kHazeScaleHeight = 1.2;  // km
constexpr double kHazeAlbedo = 0.9;
constexpr double kAngstromExponent = 1.3; // haze ~ wavelength^-1.3, [Angstrom29]
constexpr double kOzoneCentre = 25.0;     // km
constexpr double kOzoneHalfWidth = 15.0;  // km
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
  const double airDepth = kAirScattering.g * kAirScaleHeight;
  const double hazeExtinction = (turbidity - 1.0) * airDepth / kHazeScaleHeight;
  const glm::dvec3 spectrum(std::pow(680.0 / 550.0, -kAngstromExponent), 1.0, std::pow(440.0 / 550.0, -kAngstromExponent));
  hazeScattering_ = kHazeAlbedo * hazeExtinction * spectrum;
  fillTable();
}

Atmosphere::Coefficients Atmosphere::at(double radius) const {
  const double height = std::max(radius - kGroundRadius, 0.0);
  const double ozone = std::max(0.0, 1.0 - std::abs(height - kOzoneCentre) / kOzoneHalfWidth);
  Coefficients result;
  result.rayleigh = kAirScattering * std::exp(-height / kAirScaleHeight);
  result.haze = hazeScattering_ * std::exp(-height / kHazeScaleHeight);
  result.extinction = result.rayleigh + result.haze / kHazeAlbedo + kOzoneAbsorption * ozone;
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

std::vector<Atmosphere::Node>
Atmosphere::march(double radius, double mu, double length, int segments, glm::dvec3& total) const {
  static const Gauss4 gauss;
  std::vector<Node> nodes(static_cast<std::size_t>(segments) * 4);
  total = glm::dvec3(0.0);
  // distance = length * s^power: long rays begin with fine steps. Every node's depth is spectrally accurate.
  const double power = std::clamp(1.0 + std::log10(1.0 + length), 1.0, 3.5);
  for (int segment = 0; segment < segments; ++segment) {
    Node* node = &nodes[static_cast<std::size_t>(segment) * 4];
    for (std::size_t i = 0; i < 4; ++i) {
      const double s = (segment + gauss.node[i]) / segments;
      node[i].distance = length * std::pow(s, power);
      node[i].weight = gauss.weight[i] * length * power * std::pow(s, power - 1.0) / segments;
      node[i].medium = at(radiusAlong(radius, mu, node[i].distance));
    }
    glm::dvec3 depth(0.0);
    for (std::size_t i = 0; i < 4; ++i) {
      node[i].opticalDepth = total;
      for (std::size_t j = 0; j < 4; ++j) {
        node[i].opticalDepth += node[j].medium.extinction * (node[j].weight / gauss.weight[j] * gauss.upTo[i][j]);
      }
      depth += node[i].medium.extinction * node[i].weight;
    }
    total += depth;
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
  tableSize_ = {128, 320};
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

glm::dvec3 Atmosphere::opticalDepthToTop(double radius, double mu) const {
  const glm::dvec2 place = tableCoordinates(radius, mu) * glm::dvec2(tableSize_ - 1u);
  const glm::uvec2 low = glm::min(glm::uvec2(place), tableSize_ - 2u);
  const glm::dvec2 weight = place - glm::dvec2(low);
  const glm::dvec3* row = &table_[std::size_t(low.y) * tableSize_.x + low.x];
  return glm::mix(glm::mix(row[0], row[1], weight.x),
                  glm::mix(row[tableSize_.x], row[tableSize_.x + 1], weight.x), weight.y);
}

glm::dvec3 Atmosphere::sunTransmittance(double radius, double muSun) const {
  // The horizon's dip, and how far the disc's centre stands above it, in radii of the disc.
  const double sine = std::clamp(kGroundRadius / radius, 0.0, 1.0);
  const double horizonMu = -std::sqrt(1.0 - sine * sine);
  const double elevation = std::asin(std::clamp(muSun, -1.0, 1.0)) - std::asin(horizonMu);
  const double x = std::clamp(elevation / kSunAngularRadius, -1.0, 1.0);
  if (x <= -1.0) {
    return glm::dvec3(0.0);
  }
  // Area of a disc above a chord at -x.
  const double visible = 0.5 + (x * std::sqrt(1.0 - x * x) + std::asin(x)) / std::numbers::pi;
  return visible * glm::exp(-opticalDepthToTop(radius, std::max(muSun, horizonMu)));
}

} // namespace tyndall::light
