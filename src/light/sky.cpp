// SPDX-License-Identifier: Apache-2.0
#include "light/sky.h"

#include "base/error.h"
#include "light/atmosphere.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tyndall::light {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kViewerRadius = Atmosphere::kGroundRadius + 0.2; // km
constexpr double kHazeG = 0.76;
constexpr int kAzimuths = 48; // intervals of relative azimuth in [0, pi]
constexpr int kSegments = 16; // of 4 Gauss points along a view ray

double rayleighPhase(double cosine) { return 3.0 / (16.0 * kPi) * (1.0 + cosine * cosine); }

double hazePhase(double cosine) {
  const double denominator = 1.0 + kHazeG * kHazeG - 2.0 * kHazeG * cosine;
  return (1.0 - kHazeG * kHazeG) / (4.0 * kPi * denominator * std::sqrt(denominator));
}

/// What one view ray gathers before the phase functions, which alone vary fast with the azimuth.
struct Gathered {
  glm::dvec3 rayleigh{0.0};
  glm::dvec3 haze{0.0};
};

/// A row of the map: the gathered light over the relative azimuth, and what stands behind it.
struct Row {
  double mu = 0.0;
  std::vector<Gathered> azimuths;   ///< kAzimuths + 3: one beyond each end, by symmetry
  bool ground = false;
  glm::dvec3 transmittance{0.0};    ///< to the ground
  double groundDistance = 0.0;
};

class Sky {
public:
  Sky(const Atmosphere& atmosphere, const glm::dvec3& toSun) : atmosphere_(atmosphere), toSun_(toSun) {}

  Row makeRow(double mu) const {
    Row row;
    row.mu = mu;
    row.ground = Atmosphere::hitsGround(kViewerRadius, mu, row.groundDistance);
    const double length = row.ground ? row.groundDistance : Atmosphere::distanceToTop(kViewerRadius, mu);
    glm::dvec3 total;
    const std::vector<Atmosphere::Node> nodes = atmosphere_.march(kViewerRadius, mu, length, kSegments, total);
    row.transmittance = glm::exp(-total);
    row.azimuths.resize(kAzimuths + 3);
    for (int i = 0; i <= kAzimuths; ++i) {
      row.azimuths[static_cast<std::size_t>(i) + 1] = gather(nodes, mu, kPi * i / kAzimuths);
    }
    row.azimuths.front() = row.azimuths[2];
    row.azimuths.back() = row.azimuths[kAzimuths];
    return row;
  }

  /// Radiance scattered towards the viewer. @param azimuth relative to the sun's, in [0, pi].
  glm::dvec3 scattered(const Row& row, double azimuth) const {
    const double place = azimuth / kPi * kAzimuths;
    const auto low = std::min(static_cast<std::size_t>(place), static_cast<std::size_t>(kAzimuths - 1));
    const double t = place - static_cast<double>(low);
    const Gathered* g = &row.azimuths[low];
    // Catmull-Rom: fourth order over the smooth, even function of the azimuth.
    const double w0 = 0.5 * t * (-1.0 + t * (2.0 - t));
    const double w1 = 0.5 * (2.0 + t * t * (-5.0 + 3.0 * t));
    const double w2 = 0.5 * t * (1.0 + t * (4.0 - 3.0 * t));
    const double w3 = 0.5 * t * t * (-1.0 + t);
    const double cosine = cosineToSun(row.mu, azimuth);
    const glm::dvec3 rayleigh = w0 * g[0].rayleigh + w1 * g[1].rayleigh + w2 * g[2].rayleigh + w3 * g[3].rayleigh;
    const glm::dvec3 haze = w0 * g[0].haze + w1 * g[1].haze + w2 * g[2].haze + w3 * g[3].haze;
    return glm::max(rayleighPhase(cosine) * rayleigh + hazePhase(cosine) * haze, glm::dvec3(0.0));
  }

  /// Irradiance of the sun on level ground at the end of a ray that meets it.
  glm::dvec3 groundSun(const Row& row, double azimuth) const {
    const double muSun = sunMuAlong(cosineToSun(row.mu, azimuth), row.groundDistance, Atmosphere::kGroundRadius);
    return std::max(muSun, 0.0) * atmosphere_.sunTransmittance(Atmosphere::kGroundRadius, muSun);
  }

private:
  double cosineToSun(double mu, double azimuth) const {
    const double horizontal = std::sqrt(std::max(0.0, (1.0 - mu * mu) * (1.0 - toSun_.y * toSun_.y)));
    return std::clamp(mu * toSun_.y + horizontal * std::cos(azimuth), -1.0, 1.0);
  }

  /// Cosine of the sun's zenith angle at a point of the ray, where the vertical is another one.
  double sunMuAlong(double cosine, double distance, double radius) const {
    return (kViewerRadius * toSun_.y + distance * cosine) / radius;
  }

  Gathered gather(const std::vector<Atmosphere::Node>& nodes, double mu, double azimuth) const {
    const double cosine = cosineToSun(mu, azimuth);
    Gathered sum;
    for (const Atmosphere::Node& node : nodes) {
      const double squared = kViewerRadius * kViewerRadius + node.distance * (node.distance + 2.0 * kViewerRadius * mu);
      const double radius = std::clamp(std::sqrt(squared), Atmosphere::kGroundRadius, Atmosphere::kTopRadius);
      const glm::dvec3 sun = atmosphere_.sunTransmittance(radius, sunMuAlong(cosine, node.distance, radius));
      const glm::dvec3 weight = node.weight * sun * glm::exp(-node.opticalDepth);
      sum.rayleigh += node.medium.rayleigh * weight;
      sum.haze += node.medium.haze * weight;
    }
    return sum;
  }

  const Atmosphere& atmosphere_;
  glm::dvec3 toSun_;
};

/// Angle between the azimuth of column `x` and the sun's, in [0, pi].
double relativeAzimuth(unsigned x, unsigned columns, double sunAzimuth) {
  const double azimuth = 2.0 * kPi * ((x + 0.5) / columns - 0.5);
  return std::abs(std::remainder(azimuth - sunAzimuth, 2.0 * kPi));
}

} // namespace

SkyMap makeSky(const glm::dvec3& sunDirection, double turbidity, const glm::dvec3& groundAlbedo,
               const glm::uvec2& size) {
  TYNDALL_CHECK(size.x >= 1 && size.y >= 2 && turbidity >= 1.0 && glm::length(sunDirection) > 0.0);
  const Atmosphere atmosphere(turbidity);
  const glm::dvec3 toSun = -glm::normalize(sunDirection);
  const double sunAzimuth = std::atan2(toSun.x, -toSun.z);
  const Sky sky(atmosphere, toSun);
  SkyMap map;
  map.size = size;
  map.sunTransmittance = atmosphere.sunTransmittance(kViewerRadius, toSun.y);
  map.radiance.resize(std::size_t(size.x) * size.y);

  std::vector<Row> rows(size.y);
  std::vector<glm::dvec3> irradiance(size.y, glm::dvec3(0.0));
  tbb::parallel_for(0u, size.y, [&](unsigned y) {
    const double step = kPi / size.y;
    rows[y] = sky.makeRow(std::cos((y + 0.5) * step));
    const double solidAngle = 2.0 * kPi / size.x * (std::cos(y * step) - std::cos((y + 1) * step));
    for (unsigned x = 0; x < size.x; ++x) {
      const glm::dvec3 radiance = sky.scattered(rows[y], relativeAzimuth(x, size.x, sunAzimuth));
      map.radiance[std::size_t(y) * size.x + x] = glm::vec3(radiance);
      irradiance[y] += radiance * (solidAngle * std::max(rows[y].mu, 0.0));
    }
  });
  glm::dvec3 skyIrradiance(0.0);
  for (const glm::dvec3& ofRow : irradiance) {
    skyIrradiance += ofRow;
  }
  tbb::parallel_for(0u, size.y, [&](unsigned y) {
    for (unsigned x = 0; rows[y].ground && x < size.x; ++x) {
      const glm::dvec3 sun = sky.groundSun(rows[y], relativeAzimuth(x, size.x, sunAzimuth));
      const glm::dvec3 ground = groundAlbedo / kPi * (sun + skyIrradiance) * rows[y].transmittance;
      map.radiance[std::size_t(y) * size.x + x] += glm::vec3(ground);
    }
  });
  return map;
}

} // namespace tyndall::light
