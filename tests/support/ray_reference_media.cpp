// SPDX-License-Identifier: Apache-2.0
#include "support/ray_reference_media.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace tyndall::test {
namespace {

glm::dvec2 sphereSpan(const OracleRay& ray, const glm::dvec3& centre, double radius, double tMax) {
  const double scale = glm::dot(ray.direction, ray.direction);
  const double middle = glm::dot(ray.direction, centre - ray.origin) / scale;
  const glm::dvec3 nearest = pointAt(ray, middle) - centre;
  const double half = std::sqrt(std::max(0.0, radius * radius - glm::dot(nearest, nearest)) / scale);
  return {std::max(0.0, middle - half), std::min(tMax, middle + half)};
}

LocalLight localLight(const scene::NamedLight& named, int channel) {
  if (const auto* point = std::get_if<scene::PointLight>(&named.light)) {
    return {true, point->position, point->intensity[channel]};
  }
  const auto* sun = std::get_if<scene::SunLight>(&named.light);
  if (sun == nullptr || sun->angularDiameter != 0.0) {
    fail("light '{}': ray references know point lights and suns of angular diameter 0; use OracleScene", named.name);
  }
  return {false, -glm::normalize(sun->direction), sun->irradiance[channel]};
}

LocalMedium localMedium(const scene::Medium& values, int channel) {
  LocalMedium medium;
  medium.values = &values;
  medium.localFromWorld = glm::inverse(values.worldFromMedium);
  medium.sigma = values.homogeneous() ? values.sigmaT : values.densityScale;
  medium.albedo = values.albedo[channel];
  if (values.shape == scene::MediumShape::Box) {
    medium.box = values.box;
  } else if (values.shape == scene::MediumShape::Sphere) {
    medium.box = {values.centre - values.radius, values.centre + values.radius};
    medium.longest = 0.25 * values.radius;
  }
  return medium;
}

/// Where the light's ray from x(t) touches a sphere. Both kinds of light give a quadratic in t: the distance of the
/// centre from that ray, times the length of a vector along it.
/// @param place the light, in the local space: a position, or a direction of any length.
void addSilhouette(const scene::Medium& sphere, const OracleRay& local, bool point, const glm::dvec3& place,
                   std::vector<double>& kinks) {
  const glm::dvec3 start = local.origin - (point ? place : sphere.centre);
  const glm::dvec3 across = point ? sphere.centre - place : place;
  const glm::dvec3 q0 = glm::cross(start, across);
  const glm::dvec3 q1 = glm::cross(local.direction, across);
  const double r2 = sphere.radius * sphere.radius;
  const double a = glm::dot(q1, q1) - (point ? r2 * glm::dot(local.direction, local.direction) : 0.0);
  const double halfB = glm::dot(q0, q1) - (point ? r2 * glm::dot(start, local.direction) : 0.0);
  const double c = glm::dot(q0, q0) - r2 * (point ? glm::dot(start, start) : glm::dot(place, place));
  const double discriminant = halfB * halfB - a * c;
  if (discriminant > 0.0 && a != 0.0) {
    kinks.push_back((-halfB - std::sqrt(discriminant)) / a);
    kinks.push_back((-halfB + std::sqrt(discriminant)) / a);
  }
}

/// Corners of the convex polygon of all p with side.x p.x + side.y p.y <= side.z for every side.
std::vector<glm::dvec2> polygonCorners(const std::vector<glm::dvec3>& sides) {
  std::vector<glm::dvec2> corners;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const glm::dvec3 meeting = glm::cross(sides[i], sides[j]); // homogeneous coordinates (-x, -y, 1)
      const glm::dvec2 p = -glm::dvec2(meeting) / meeting.z;
      const auto within = [&p](const glm::dvec3& side) {
        const double grant = 1e-9 * (std::abs(side.x * p.x) + std::abs(side.y * p.y) + std::abs(side.z));
        return side.x * p.x + side.y * p.y - side.z <= grant;
      };
      if (meeting.z != 0.0 && std::all_of(sides.begin(), sides.end(), within)) {
        corners.push_back(p);
      }
    }
  }
  return corners;
}

} // namespace

/// With a sun, x(t) + s w is in the box; with a point light c, (1 - u) x(t) + u c is. Either is a convex polygon, in
/// (t, s) or in (v, u) with v = (1 - u) t, and at its corners the light's ray meets an edge of the box.
glm::dvec2 LocalMedium::shadow(const OracleRay& local, const LocalLight& light, double end,
                               std::vector<double>& kinks) const {
  const glm::dvec3 place(localFromWorld * glm::dvec4(light.place, light.point ? 1.0 : 0.0));
  const glm::dvec3 second = light.point ? place - local.origin : place;
  std::vector<glm::dvec3> sides{{-1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {1.0, light.point ? end : 0.0, end}};
  for (int axis = 0; axis < 3; ++axis) {
    sides.push_back({local.direction[axis], second[axis], box.max[axis] - local.origin[axis]});
    sides.push_back({-local.direction[axis], -second[axis], local.origin[axis] - box.min[axis]});
  }
  glm::dvec2 span(kInfinity, -kInfinity);
  for (const glm::dvec2& corner : polygonCorners(sides)) {
    if (light.point && corner.y > 1.0 - 1e-12) { // the light itself is in the box, and every t has a part
      span = {0.0, end};
      continue;
    }
    const double t = light.point ? corner.x / (1.0 - corner.y) : corner.x;
    span = {std::min(span.x, t), std::max(span.y, t)};
    kinks.push_back(t);
  }
  if (!grid && values->shape == scene::MediumShape::Sphere) {
    addSilhouette(*values, local, light.point, place, kinks);
  }
  return span;
}

glm::dvec2 LocalMedium::span(const OracleRay& local, double tMax) const {
  if (grid || values->shape == scene::MediumShape::Box) {
    return spanInBox(local, box, tMax);
  }
  return box.empty() ? glm::dvec2(0.0, tMax) : sphereSpan(local, values->centre, values->radius, tMax);
}

double LocalMedium::depth(const OracleRay& local, double tMax) const {
  if (grid) {
    return sigma * grid->depth(local, tMax, kOpaque / sigma);
  }
  const glm::dvec2 inside = span(local, tMax);
  return inside.x < inside.y ? sigma * (inside.y - inside.x) : 0.0;
}

Stage makeStage(const scene::Scene& scene, const gpu_scene::VolumeSet& volumes, const RayReferenceSettings& settings) {
  Stage stage;
  stage.settings = settings;
  stage.rule = &gaussRule(settings.nodes);
  std::vector<std::shared_ptr<const DecodedGrid>> decoded(volumes.grids.size());
  for (std::size_t m = 0; m < scene.media.size(); ++m) {
    LocalMedium medium = localMedium(scene.media[m], settings.channel);
    if (!scene.media[m].homogeneous()) {
      const auto use = volumes.uses[m].density;
      if (!use || volumes.grids[*use].empty()) {
        continue;
      }
      decoded[*use] = decoded[*use] ? decoded[*use] : std::make_shared<const DecodedGrid>(volumes.grids[*use]);
      medium.grid = decoded[*use];
      medium.box = medium.grid->bounds();
      medium.longest = settings.voxels;
      medium.localFromWorld = glm::inverse(scene.media[m].worldFromMedium * volumes.grids[*use].worldFromIndex);
    }
    if (medium.sigma > 0.0) {
      stage.media.push_back(medium);
    }
  }
  for (const scene::NamedLight& named : scene.lights) {
    stage.lights.push_back(localLight(named, settings.channel));
  }
  for (const double node : stage.rule->nodes) {
    for (unsigned i = 0; i < 2; ++i) {
      stage.legendre[i].push_back(std::legendre(unsigned(settings.nodes) - 1 - i, 2.0 * node - 1.0));
    }
  }
  return stage;
}

} // namespace tyndall::test
