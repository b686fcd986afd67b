// SPDX-License-Identifier: Apache-2.0
#include "gpu_scene/emitters.h"

#include "light/light_tree.h"
#include "math/colour.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace tyndall::gpu_scene {
namespace {

float oneMinusCos(double degrees) {
  const double sine = std::sin(0.5 * glm::radians(degrees));
  return static_cast<float>(2.0 * sine * sine);
}

/// A sphere counts as small up to this share of the scene's radius: seen from within it, distances aimed at its centre
/// would miss its near side.
constexpr double kSmallRadius = 0.01;

class EmitterPacker {
public:
  EmitterPacker(const Bounds3& bounds, PackedEmitters& out)
      : centre_(bounds.centre()), smallRadius_(kSmallRadius * 0.5 * glm::length(bounds.size())), out_(out) {}

  void addSurfaces(const PackedSurfaces& surfaces) {
    for (std::size_t i = 0; i < surfaces.emitters.size(); ++i) {
      add(surfaces.emitters[i], double(surfaces.emitterScales[i]));
    }
  }

  void addLight(const scene::Light& light) {
    interop::Emitter emitter{};
    if (const auto* point = std::get_if<scene::PointLight>(&light)) {
      emitter.kind = interop::kEmitterPoint;
      emitter.position = point->position - centre_;
      emitter.radiance = point->intensity;
    } else if (const auto* spot = std::get_if<scene::SpotLight>(&light)) {
      emitter.kind = interop::kEmitterSpot;
      emitter.position = spot->position - centre_;
      emitter.radiance = spot->intensity;
      emitter.edge1 = spot->direction;
      emitter.edge2 = {oneMinusCos(spot->outerAngle), oneMinusCos(spot->innerAngle), 0.0f};
    } else {
      return;
    }
    if (luminance(glm::dvec3(emitter.radiance)) > 0.0) {
      add(emitter, 1.0);
    }
  }

  void addMedium(PackedMedia& media, std::uint32_t index) {
    interop::Medium& medium = media.media[index];
    const bool homogeneous = index < media.homogeneousCount;
    if ((homogeneous && medium.emissionKind == interop::kEmissionNone) || !(medium.emissionMeasure > 0.0f)) {
      return;
    }
    interop::Emitter emitter{};
    emitter.kind = interop::kEmitterVolume;
    emitter.index = index;
    homogeneous ? placeShape(medium, emitter) : placeGrid(media.placements[medium.emissionGrid].header, emitter);
    light::LightBounds bounds;
    bounds.box = boundsOf(media, medium, homogeneous, emitter);
    bounds.cosEmission = -1.0;
    // An upper bound for grids (their bricks' maxima), exact for homogeneous media.
    bounds.power = 4.0 * glm::pi<double>() * double(medium.emissionMeasure) *
                   (homogeneous ? luminance(glm::dvec3(medium.emission)) : 1.0);
    medium.emitter = static_cast<std::uint32_t>(out_.emitters.size());
    out_.emitters.push_back(emitter);
    bounds_.push_back(bounds);
    out_.volumes = true;
  }

  void finish() { out_.nodes = light::buildLightTree(out_.emitters, bounds_).nodes; }

private:
  bool isSmall(const interop::Emitter& emitter) const {
    return emitter.kind == interop::kEmitterPoint || emitter.kind == interop::kEmitterSpot ||
           (emitter.kind == interop::kEmitterSphere && double(emitter.edge1.x) <= smallRadius_);
  }

  void add(interop::Emitter emitter, double scale) {
    light::LightBounds bounds = light::lightBounds(emitter);
    bounds.power *= scale;
    if (isSmall(emitter)) {
      emitter.flags |= interop::kEmitterSmall;
      out_.small = true;
    }
    out_.emitters.push_back(emitter);
    bounds_.push_back(bounds);
  }

  /// world = position + (edge1 edge2 radiance) * local.
  static void place(const glm::dmat4& worldFromLocal, interop::Emitter& emitter) {
    emitter.edge1 = glm::vec3(worldFromLocal[0]);
    emitter.edge2 = glm::vec3(worldFromLocal[1]);
    emitter.radiance = glm::vec3(worldFromLocal[2]);
    emitter.position = glm::vec3(worldFromLocal[3]);
  }

  static void placeShape(const interop::Medium& medium, interop::Emitter& emitter) {
    const glm::dmat4 worldFromMedium = glm::inverse(glm::dmat4(glm::dmat4x3(medium.mediumFromWorld)));
    const bool sphere = medium.shape == interop::kShapeSphere;
    const glm::dvec3 scale = sphere ? glm::dvec3(medium.shapeMax.x) : glm::dvec3(medium.shapeMax - medium.shapeMin);
    place(glm::scale(glm::translate(worldFromMedium, glm::dvec3(medium.shapeMin)), scale), emitter);
  }

  static void placeGrid(const interop::Grid& grid, interop::Emitter& emitter) {
    place(glm::inverse(glm::dmat4(glm::dmat4x3(grid.voxelFromWorld))), emitter);
  }

  static Bounds3 boundsOf(const PackedMedia& media, const interop::Medium& medium, bool homogeneous,
                          const interop::Emitter& emitter) {
    Bounds3 local{glm::dvec3(0.0), glm::dvec3(1.0)};
    if (!homogeneous) {
      const interop::Grid& grid = media.placements[medium.emissionGrid].header;
      local = {glm::dvec3(grid.boundsMin), glm::dvec3(grid.boundsMax)};
    } else if (medium.shape == interop::kShapeSphere) {
      local.min = glm::dvec3(-1.0);
    }
    const glm::dmat4 world(glm::dvec4(emitter.edge1, 0.0), glm::dvec4(emitter.edge2, 0.0),
                           glm::dvec4(emitter.radiance, 0.0), glm::dvec4(emitter.position, 1.0));
    return transformed(world, local);
  }

  glm::dvec3 centre_;
  double smallRadius_;
  PackedEmitters& out_;
  std::vector<light::LightBounds> bounds_;
};

} // namespace

PackedEmitters packEmitters(const scene::Scene& scene, const PackedSurfaces& surfaces, PackedMedia& media,
                            const Bounds3& bounds) {
  PackedEmitters out;
  EmitterPacker packer(bounds, out);
  packer.addSurfaces(surfaces);
  for (const scene::NamedLight& named : scene.lights) {
    packer.addLight(named.light);
  }
  for (std::uint32_t i = 0; i < media.media.size(); ++i) {
    const bool grid = i >= media.homogeneousCount;
    if (!grid || media.media[i].emissionGrid != interop::kNoGrid) {
      packer.addMedium(media, i);
    }
  }
  packer.finish();
  return out;
}

} // namespace tyndall::gpu_scene
