// SPDX-License-Identifier: Apache-2.0
#include "light/sky.h"

#include "base/error.h"
#include "light/atmosphere.h"
#include "light/sky_multiple.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tyndall::light {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kViewerRadius = Atmosphere::kGroundRadius + 0.2; // km
constexpr double kHazeG = 0.76;
constexpr int kAzimuths = 48; // intervals of relative azimuth in [0, pi]
constexpr int kSegments = 8;  // of 4 Gauss points along a view ray

double rayleighPhase(double cosine) { return 3.0 / (16.0 * kPi) * (1.0 + cosine * cosine); }

double hazePhase(double cosine) {
  const double denominator = 1.0 + kHazeG * kHazeG - 2.0 * kHazeG * cosine;
  return (1.0 - kHazeG * kHazeG) / (4.0 * kPi * denominator * std::sqrt(denominator));
}

/// What one view ray gathers, in RGB, before the phase functions, which alone vary fast with the azimuth.
struct Gathered {
  glm::dvec3 air{0.0};
  glm::dvec3 haze{0.0};
  glm::dvec3 rest{0.0}; ///< later orders, and sunlight reflected by the ground
};

/// A row of the map: the gathered light over the relative azimuth, and what stands behind it.
struct Row {
  double mu = 0.0;
  std::vector<Gathered> azimuths;   ///< kAzimuths + 3: one beyond each end, by symmetry
  bool ground = false;
  SkySpectrum transmittance;        ///< to the ground
  double groundDistance = 0.0;
};

/// A column of the map: where it lies between the azimuths of a row.
struct Column {
  double cosAzimuth = 1.0; ///< relative to the sun's
  std::size_t low = 0;
  std::array<double, 4> weights{};
};

Column makeColumn(unsigned x, unsigned columns, double sunAzimuth) {
  const double azimuth = 2.0 * kPi * ((x + 0.5) / columns - 0.5);
  const double relative = std::abs(std::remainder(azimuth - sunAzimuth, 2.0 * kPi));
  const double place = relative / kPi * kAzimuths;
  Column column;
  column.cosAzimuth = std::cos(relative);
  column.low = std::min(static_cast<std::size_t>(place), static_cast<std::size_t>(kAzimuths - 1));
  const double t = place - static_cast<double>(column.low);
  // Catmull-Rom: fourth order over the smooth, even function of the azimuth.
  column.weights = {0.5 * t * (-1.0 + t * (2.0 - t)), 0.5 * (2.0 + t * t * (-5.0 + 3.0 * t)),
                    0.5 * t * (1.0 + t * (4.0 - 3.0 * t)), 0.5 * t * t * (-1.0 + t)};
  return column;
}

class Sky {
public:
  Sky(const Atmosphere& atmosphere, const glm::dvec3& toSun, const glm::dvec3& groundAlbedo)
      : atmosphere_(atmosphere), toSun_(toSun), groundAlbedo_(spectralAlbedo(groundAlbedo)),
        multiple_(atmosphere, groundAlbedo_) {}

  Row makeRow(double mu) const {
    Row row;
    row.mu = mu;
    row.ground = Atmosphere::hitsGround(kViewerRadius, mu, row.groundDistance);
    const double length = row.ground ? row.groundDistance : Atmosphere::distanceToTop(kViewerRadius, mu);
    glm::dvec3 total;
    const std::vector<Atmosphere::Node> nodes = Atmosphere::march(kViewerRadius, mu, length, kSegments, total);
    row.transmittance = row.ground ? atmosphere_.transmittance(total) : SkySpectrum{};
    std::vector<SkySpectrum> arriving; // per node, as the later orders need it: scattering x transmittance x step
    for (const Atmosphere::Node& node : nodes) {
      const SkySpectrum scattering =
          node.density.x * atmosphere_.airScattering() + node.density.y * atmosphere_.hazeScattering();
      arriving.push_back(node.weight * scattering * atmosphere_.transmittance(node.column));
    }
    row.azimuths.resize(kAzimuths + 3);
    for (int i = 0; i <= kAzimuths; ++i) {
      row.azimuths[static_cast<std::size_t>(i) + 1] = gather(row, nodes, arriving, std::cos(kPi * i / kAzimuths));
    }
    row.azimuths.front() = row.azimuths[2];
    row.azimuths.back() = row.azimuths[kAzimuths];
    return row;
  }

  /// Radiance towards the viewer, but for the sky's light reflected by the ground.
  glm::dvec3 radiance(const Row& row, const Column& column) const {
    const double cosine = cosineToSun(row.mu, column.cosAzimuth);
    const double air = rayleighPhase(cosine);
    const double haze = hazePhase(cosine);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < 4; ++i) {
      const Gathered& gathered = row.azimuths[column.low + i];
      sum += column.weights[i] * (air * gathered.air + haze * gathered.haze + gathered.rest);
    }
    return glm::max(sum, glm::dvec3(0.0));
  }

  /// Radiance of the ground behind a row for an irradiance of the sky.
  glm::dvec3 groundUnderSky(const Row& row, const glm::dvec3& irradiance) const {
    return rgbFromSky(1.0 / kPi * groundAlbedo_ * row.transmittance * skyFromRgb(irradiance));
  }

private:
  static SkySpectrum spectralAlbedo(const glm::dvec3& rgb) {
    SkySpectrum albedo = skyFromRgb(rgb);
    // A saturated colour has no smooth spectrum that is physical everywhere.
    for (double& value : albedo.at) {
      value = std::clamp(value, 0.0, 1.0);
    }
    return albedo;
  }

  double cosineToSun(double mu, double cosAzimuth) const {
    const double horizontal = std::sqrt(std::max(0.0, (1.0 - mu * mu) * (1.0 - toSun_.y * toSun_.y)));
    return std::clamp(mu * toSun_.y + horizontal * cosAzimuth, -1.0, 1.0);
  }

  /// Cosine of the sun's zenith angle at a point of the ray, where the vertical is another one.
  double sunMuAlong(double cosine, double distance, double radius) const {
    return (kViewerRadius * toSun_.y + distance * cosine) / radius;
  }

  Gathered gather(const Row& row, const std::vector<Atmosphere::Node>& nodes,
                  const std::vector<SkySpectrum>& arriving, double cosAzimuth) const {
    const double cosine = cosineToSun(row.mu, cosAzimuth);
    SkySpectrum air;
    SkySpectrum haze;
    SkySpectrum rest;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const Atmosphere::Node& node = nodes[n];
      const double squared = kViewerRadius * kViewerRadius + node.distance * (node.distance + 2.0 * kViewerRadius * row.mu);
      const double radius = std::clamp(std::sqrt(squared), Atmosphere::kGroundRadius, Atmosphere::kTopRadius);
      const double muSun = sunMuAlong(cosine, node.distance, radius);
      rest += arriving[n] * multiple_.at(radius, muSun);
      const Atmosphere::SunPath sun = atmosphere_.sunPath(radius, muSun);
      if (sun.visible > 0.0) {
        const SkySpectrum single = node.weight * sun.visible * atmosphere_.transmittance(sun.column + node.column);
        air += node.density.x * single;
        haze += node.density.y * single;
      }
    }
    if (row.ground) {
      rest += row.transmittance * groundUnderSun(sunMuAlong(cosine, row.groundDistance, Atmosphere::kGroundRadius));
    }
    return {rgbFromSky(air * atmosphere_.airScattering()), rgbFromSky(haze * atmosphere_.hazeScattering()), rgbFromSky(rest)};
  }

  SkySpectrum groundUnderSun(double muSun) const {
    return std::max(muSun, 0.0) / kPi * groundAlbedo_ * atmosphere_.sunTransmittance(Atmosphere::kGroundRadius, muSun);
  }

  const Atmosphere& atmosphere_;
  glm::dvec3 toSun_;
  SkySpectrum groundAlbedo_;
  MultipleScattering multiple_;
};

} // namespace

SkyMap makeSky(const glm::dvec3& sunDirection, double turbidity, const glm::dvec3& groundAlbedo,
               const glm::uvec2& size) {
  TYNDALL_CHECK(size.x >= 1 && size.y >= 2 && turbidity >= 1.0 && glm::length(sunDirection) > 0.0);
  const Atmosphere atmosphere(turbidity);
  const glm::dvec3 toSun = -glm::normalize(sunDirection);
  const double sunAzimuth = std::atan2(toSun.x, -toSun.z);
  const Sky sky(atmosphere, toSun, groundAlbedo);
  SkyMap map;
  map.size = size;
  map.sunTransmittance = glm::max(rgbFromSky(atmosphere.sunTransmittance(kViewerRadius, toSun.y)), glm::dvec3(0.0));
  map.radiance.resize(std::size_t(size.x) * size.y);

  std::vector<Column> columns(size.x);
  for (unsigned x = 0; x < size.x; ++x) {
    columns[x] = makeColumn(x, size.x, sunAzimuth);
  }
  std::vector<Row> rows(size.y);
  std::vector<glm::dvec3> irradiance(size.y, glm::dvec3(0.0));
  tbb::parallel_for(0u, size.y, [&](unsigned y) {
    const double step = kPi / size.y;
    rows[y] = sky.makeRow(std::cos((y + 0.5) * step));
    const double solidAngle = 2.0 * kPi / size.x * (std::cos(y * step) - std::cos((y + 1) * step));
    for (unsigned x = 0; x < size.x; ++x) {
      const glm::dvec3 radiance = sky.radiance(rows[y], columns[x]);
      map.radiance[std::size_t(y) * size.x + x] = glm::vec3(radiance);
      irradiance[y] += radiance * (solidAngle * std::max(rows[y].mu, 0.0));
    }
  });
  glm::dvec3 skyIrradiance(0.0);
  for (const glm::dvec3& ofRow : irradiance) {
    skyIrradiance += ofRow;
  }
  tbb::parallel_for(0u, size.y, [&](unsigned y) {
    const glm::vec3 ground = rows[y].ground ? glm::vec3(sky.groundUnderSky(rows[y], skyIrradiance)) : glm::vec3(0.0f);
    for (unsigned x = 0; rows[y].ground && x < size.x; ++x) {
      glm::vec3& radiance = map.radiance[std::size_t(y) * size.x + x];
      radiance = glm::max(radiance + ground, glm::vec3(0.0f));
    }
  });
  return map;
}

} // namespace tyndall::light
