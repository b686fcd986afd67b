// SPDX-License-Identifier: Apache-2.0
#include "verify/oracle_radiance.h"

#include "light/blackbody.h"
#include "verify/oracle_phase.h"
#include "verify/quadrature.h"
#include "volume/depth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tyndall::verify {
namespace {

using scene::MediumShape;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Optical depth beyond which nothing of an unbounded medium is seen.
constexpr double kOpaque = 45.0;

glm::dvec3 at(const OracleRay& ray, double t) { return ray.origin + t * ray.direction; }

OracleRay through(const glm::dmat4& map, const OracleRay& ray) {
  return {glm::dvec3(map * glm::dvec4(ray.origin, 1.0)), glm::dmat3(map) * ray.direction};
}

glm::dvec2 boxSpan(const OracleRay& ray, const Bounds3& box, double tMax) {
  glm::dvec2 span(0.0, tMax);
  for (int axis = 0; axis < 3; ++axis) {
    const double d = ray.direction[axis];
    if (d == 0.0) {
      if (ray.origin[axis] < box.min[axis] || ray.origin[axis] > box.max[axis]) {
        return {0.0, 0.0};
      }
      continue;
    }
    const double a = (box.min[axis] - ray.origin[axis]) / d;
    const double b = (box.max[axis] - ray.origin[axis]) / d;
    span = {std::max(span.x, std::min(a, b)), std::min(span.y, std::max(a, b))};
  }
  return span.x < span.y ? span : glm::dvec2(0.0);
}

glm::dvec2 sphereSpan(const OracleRay& ray, const glm::dvec3& centre, double radius, double tMax) {
  const double a = glm::dot(ray.direction, ray.direction);
  const double b = glm::dot(ray.direction, centre - ray.origin) / a;
  const glm::dvec3 nearest = at(ray, b) - centre;
  const double rest = (radius * radius - glm::dot(nearest, nearest)) / a;
  if (rest <= 0.0) {
    return {0.0, 0.0};
  }
  const glm::dvec2 span(std::max(0.0, b - std::sqrt(rest)), std::min(tMax, b + std::sqrt(rest)));
  return span.x < span.y ? span : glm::dvec2(0.0);
}

glm::dvec2 homogeneousSpan(const scene::Medium& medium, const OracleRay& local, double tMax) {
  switch (medium.shape) {
  case MediumShape::Unbounded: return {0.0, tMax};
  case MediumShape::Box: return boxSpan(local, medium.box, tMax);
  case MediumShape::Sphere: return sphereSpan(local, medium.centre, medium.radius, tMax);
  case MediumShape::Objects: break; // the oracle knows no surfaces
  }
  return {0.0, 0.0};
}

void addPlanes(std::vector<double>& breaks, const OracleRay& index, const Bounds3& box) {
  const glm::dvec2 span = boxSpan(index, box, kInfinity);
  if (span.x >= span.y) {
    return;
  }
  breaks.insert(breaks.end(), {span.x, span.y});
  for (int axis = 0; axis < 3; ++axis) {
    if (index.direction[axis] == 0.0) {
      continue;
    }
    for (double plane = box.min[axis]; plane <= box.max[axis]; plane += 1.0) {
      const double t = (plane - index.origin[axis]) / index.direction[axis];
      if (t > span.x && t < span.y) {
        breaks.push_back(t);
      }
    }
  }
}

/// Two unit vectors across `axis`.
glm::dmat3x3 frameAround(const glm::dvec3& axis) {
  const glm::dvec3 other = std::abs(axis.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 u = glm::normalize(glm::cross(axis, other));
  return {u, glm::cross(axis, u), axis};
}

} // namespace

OracleScene::OracleScene(const scene::Scene& scene, const gpu_scene::VolumeSet& volumes, const OracleSettings& settings)
    : scene_(scene), volumes_(volumes), settings_(settings) {
  for (const scene::Medium& medium : scene.media) {
    mediumFromWorld_.push_back(glm::inverse(medium.worldFromMedium));
  }
}

OracleRay OracleScene::cameraRay(const glm::dvec2& raster) const {
  const scene::Camera& camera = scene_.camera;
  const glm::dvec3 forward = glm::normalize(camera.target - camera.position);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
  const glm::dvec3 up = glm::cross(right, forward);
  const double aspect = double(scene_.film.size.x) / scene_.film.size.y;
  const glm::dvec2 offset((2.0 * raster.x - 1.0) * aspect, 1.0 - 2.0 * raster.y);
  if (camera.kind == scene::Camera::Kind::Perspective) {
    const double extent = std::tan(0.5 * glm::radians(camera.verticalFov));
    return {camera.position, glm::normalize(forward + extent * (offset.x * right + offset.y * up))};
  }
  return {camera.position + 0.5 * camera.height * (offset.x * right + offset.y * up), forward};
}

double OracleScene::opticalDepth(const OracleRay& ray, double tMax) const {
  double depth = 0.0;
  for (std::size_t m = 0; m < scene_.media.size(); ++m) {
    const scene::Medium& medium = scene_.media[m];
    const OracleRay local = through(mediumFromWorld_[m], ray);
    if (medium.homogeneous()) {
      const glm::dvec2 span = homogeneousSpan(medium, local, tMax);
      depth += span.x < span.y ? medium.sigmaT * (span.y - span.x) : 0.0;
    } else if (volumes_.uses[m].density) {
      // exactOpticalDepth measures along the medium's own lengths.
      depth += medium.densityScale / glm::length(local.direction) *
               volume::exactOpticalDepth(volumes_.grids[*volumes_.uses[m].density], local.origin, local.direction, 0.0, tMax);
    }
  }
  return depth;
}

double OracleScene::extinction(std::size_t medium, const glm::dvec3& point) const {
  const scene::Medium& values = scene_.media[medium];
  const OracleRay local = through(mediumFromWorld_[medium], {point, glm::dvec3(0.0)});
  if (values.homogeneous()) {
    const glm::dvec3 p = local.origin;
    const bool inBox = glm::all(glm::greaterThanEqual(p, values.box.min)) && glm::all(glm::lessThanEqual(p, values.box.max));
    const bool inside = values.shape == MediumShape::Unbounded || (values.shape == MediumShape::Box && inBox) ||
                        (values.shape == MediumShape::Sphere && glm::distance(p, values.centre) <= values.radius);
    return inside ? values.sigmaT : 0.0;
  }
  if (!volumes_.uses[medium].density) {
    return 0.0;
  }
  const volume::BrickGrid& grid = volumes_.grids[*volumes_.uses[medium].density];
  return values.densityScale * grid.value(glm::dvec3(glm::inverse(grid.worldFromIndex) * glm::dvec4(local.origin, 1.0)));
}

double OracleScene::emission(std::size_t medium, const glm::dvec3& point, int channel) const {
  const scene::Medium& values = scene_.media[medium];
  if (!values.emission) {
    return 0.0;
  }
  const scene::Emission& emission = *values.emission;
  double value = 1.0;
  double kelvin = emission.temperature;
  if (values.homogeneous()) {
    if (extinction(medium, point) == 0.0 && values.sigmaT > 0.0) {
      return 0.0;
    }
  } else {
    const volume::BrickGrid& grid = volumes_.grids[*volumes_.uses[medium].emission];
    const glm::dvec4 local = mediumFromWorld_[medium] * glm::dvec4(point, 1.0);
    const glm::dvec3 index(glm::inverse(grid.worldFromIndex) * local);
    const Bounds3 bounds = grid.indexBounds();
    if (glm::any(glm::lessThan(index, bounds.min)) || glm::any(glm::greaterThan(index, bounds.max))) {
      return 0.0;
    }
    value = grid.value(index);
    kelvin = emission.temperatureScale * value + emission.temperatureOffset;
  }
  double j = emission.scale * emission.colour[channel];
  j *= emission.kind == scene::Emission::Kind::Blackbody ? light::blackbodyRadiance(kelvin)[channel] : value;
  return emission.tiedToAbsorption ? j * extinction(medium, point) * (1.0 - values.albedo[channel]) : j;
}

/// Integral over the cone of directions within `cosine` of `axis` of phase function times transmittance.
double OracleScene::overCone(std::size_t medium, const OracleRay& ray, const glm::dvec3& axis, double cosine) const {
  const bool sphere = cosine <= -1.0;
  const GaussRule& polar = gaussRule(sphere ? settings_.polarNodes : 6);
  const int azimuths = sphere ? settings_.azimuths : 12;
  const glm::dmat3x3 frame = frameAround(axis);
  double sum = 0.0;
  for (std::size_t i = 0; i < polar.nodes.size(); ++i) {
    const double c = 1.0 - polar.nodes[i] * (1.0 - cosine);
    const double s = std::sqrt(std::max(0.0, 1.0 - c * c));
    for (int j = 0; j < azimuths; ++j) {
      const double phi = 2.0 * std::numbers::pi * (j + 0.5) / azimuths;
      const glm::dvec3 w = frame * glm::dvec3(s * std::cos(phi), s * std::sin(phi), c);
      const double phase = phaseOracle(scene_.media[medium].phase, glm::dot(ray.direction, w));
      sum += polar.weights[i] / azimuths * phase * std::exp(-opticalDepth({ray.origin, w}, kInfinity));
    }
  }
  return sum * 2.0 * std::numbers::pi * (1.0 - cosine);
}

double OracleScene::lightFrom(const scene::Light& light, std::size_t medium, const OracleRay& ray, int channel) const {
  const scene::Phase& phase = scene_.media[medium].phase;
  if (const auto* point = std::get_if<scene::PointLight>(&light)) {
    const glm::dvec3 toLight = point->position - ray.origin;
    const double distance = glm::length(toLight);
    const glm::dvec3 w = toLight / distance;
    return point->intensity[channel] / (distance * distance) * phaseOracle(phase, glm::dot(ray.direction, w)) *
           std::exp(-opticalDepth({ray.origin, w}, distance));
  }
  if (const auto* sun = std::get_if<scene::SunLight>(&light)) {
    const glm::dvec3 w = -glm::normalize(sun->direction);
    if (sun->angularDiameter == 0.0) {
      return sun->irradiance[channel] * phaseOracle(phase, glm::dot(ray.direction, w)) * std::exp(-opticalDepth({ray.origin, w}, kInfinity));
    }
    const double half = glm::radians(0.5 * sun->angularDiameter);
    // A uniform disc of radiance L gives pi sin^2 L on the plane that faces it.
    const double radiance = sun->irradiance[channel] / (std::numbers::pi * std::sin(half) * std::sin(half));
    return radiance * overCone(medium, ray, w, std::cos(half));
  }
  const auto& constant = std::get<scene::ConstantEnvironment>(light);
  return constant.radiance[channel] * overCone(medium, ray, ray.direction, -1.0);
}

double OracleScene::inScattered(std::size_t medium, const glm::dvec3& point, const glm::dvec3& direction, int channel) const {
  double sum = 0.0;
  for (const scene::NamedLight& named : scene_.lights) {
    sum += lightFrom(named.light, medium, {point, direction}, channel);
  }
  return sum;
}

std::vector<double> OracleScene::breaks(const OracleRay& ray) const {
  std::vector<double> result;
  for (std::size_t m = 0; m < scene_.media.size(); ++m) {
    const scene::Medium& medium = scene_.media[m];
    const OracleRay local = through(mediumFromWorld_[m], ray);
    if (medium.homogeneous()) {
      const glm::dvec2 span = homogeneousSpan(medium, local, medium.sigmaT > 0.0 ? kOpaque / medium.sigmaT : kInfinity);
      result.insert(result.end(), {span.x, span.y});
      continue;
    }
    for (const auto& use : {volumes_.uses[m].density, volumes_.uses[m].emission}) {
      if (use) {
        const volume::BrickGrid& grid = volumes_.grids[*use];
        addPlanes(result, through(glm::inverse(grid.worldFromIndex), local), grid.indexBounds());
      }
    }
  }
  std::sort(result.begin(), result.end());
  const double first = result.empty() ? 0.0 : result.front();
  const double last = result.empty() ? 0.0 : result.back();
  for (const scene::NamedLight& named : scene_.lights) {
    if (const auto* point = std::get_if<scene::PointLight>(&named.light)) {
      result.push_back(std::clamp(glm::dot(point->position - ray.origin, ray.direction), first, last));
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

double OracleScene::radiance(const OracleRay& ray, int channel) const {
  const auto integrand = [&](double t) {
    const glm::dvec3 point = at(ray, t);
    double sum = 0.0;
    for (std::size_t m = 0; m < scene_.media.size(); ++m) {
      const double sigmaS = scene_.media[m].albedo[channel] * extinction(m, point);
      sum += emission(m, point, channel) + (sigmaS > 0.0 ? sigmaS * inScattered(m, point, ray.direction, channel) : 0.0);
    }
    return sum > 0.0 ? sum * std::exp(-opticalDepth(ray, t)) : 0.0;
  };
  return integratePieces(integrand, breaks(ray), settings_.relative);
}

double OracleScene::total(const OracleRay& ray, int channel) const {
  double behind = 0.0;
  for (const scene::NamedLight& named : scene_.lights) {
    const auto* constant = std::get_if<scene::ConstantEnvironment>(&named.light);
    behind += constant != nullptr && named.visible ? constant->radiance[channel] : 0.0;
  }
  return radiance(ray, channel) + (behind > 0.0 ? behind * std::exp(-opticalDepth(ray, kInfinity)) : 0.0);
}

std::vector<double> OracleScene::picture(const std::function<double(const OracleRay&)>& function, int nodes) const {
  const GaussRule& rule = gaussRule(nodes);
  const glm::uvec2 size = scene_.film.size;
  std::vector<double> means;
  for (std::uint32_t y = 0; y < size.y; ++y) {
    for (std::uint32_t x = 0; x < size.x; ++x) {
      double mean = 0.0;
      for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
          const glm::dvec2 raster = (glm::dvec2(x, y) + glm::dvec2(rule.nodes[i], rule.nodes[j])) / glm::dvec2(size);
          mean += rule.weights[i] * rule.weights[j] * function(cameraRay(raster));
        }
      }
      means.push_back(mean);
    }
  }
  return means;
}

std::vector<double> OracleScene::transmittancePicture(int nodes) const {
  return picture([this](const OracleRay& ray) { return std::exp(-opticalDepth(ray, kInfinity)); }, nodes);
}

} // namespace tyndall::verify
