// SPDX-License-Identifier: Apache-2.0
#include "gpu_scene/media.h"

#include "gpu_scene/atlas.h"
#include "light/blackbody.h"
#include "light/mie.h"
#include "math/colour.h"
#include "scene/camera_frame.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace tyndall::gpu_scene {
namespace {

using interop::Medium;
using volume::BrickGrid;

Bounds3 mediumBounds(const scene::Medium& medium, const VolumeSet& volumes, const VolumeSet::Use& use) {
  Bounds3 local;
  for (const std::optional<std::size_t>& grid : {use.density, use.emission}) {
    if (grid && !volumes.grids[*grid].empty()) {
      local.extend(volumes.grids[*grid].worldBounds());
    }
  }
  if (medium.homogeneous() && medium.shape == scene::MediumShape::Box) {
    local = medium.box;
  } else if (medium.homogeneous() && medium.shape == scene::MediumShape::Sphere) {
    local = {medium.centre - medium.radius, medium.centre + medium.radius};
  }
  return transformed(medium.worldFromMedium, local);
}

Medium commonFields(const scene::Medium& medium) {
  Medium packed{};
  packed.phase = packPhase(medium.phase);
  packed.albedo = medium.albedo;
  packed.densityGrid = interop::kNoGrid;
  packed.emissionGrid = interop::kNoGrid;
  return packed;
}

Medium packHomogeneous(const scene::Medium& medium, const glm::dvec3& centre) {
  Medium packed = commonFields(medium);
  packed.sigmaT = static_cast<float>(medium.sigmaT);
  // About the shape's own centre: its corners may be given far from the origin.
  const bool sphere = medium.shape == scene::MediumShape::Sphere;
  const glm::dvec3 middle = sphere                                    ? medium.centre
                            : medium.shape == scene::MediumShape::Box ? medium.box.centre()
                                                                      : glm::dvec3(0.0);
  const glm::dmat4 mediumFromWorld = glm::translate(glm::dmat4(1.0), -middle) * glm::inverse(medium.worldFromMedium) *
                                     glm::translate(glm::dmat4(1.0), centre);
  packed.mediumFromWorld = glm::mat4x3(glm::dmat4x3(mediumFromWorld));
  packed.shape = medium.shape == scene::MediumShape::Box      ? interop::kShapeBox
                 : medium.shape == scene::MediumShape::Sphere ? interop::kShapeSphere
                                                              : interop::kShapeUnbounded;
  packed.shapeMin = sphere ? glm::dvec3(0.0) : medium.box.min - middle;
  packed.shapeMax = sphere ? glm::dvec3(medium.radius) : medium.box.max - middle;
  if (medium.emission) {
    const scene::Emission& emission = *medium.emission;
    glm::dvec3 j = emission.scale * emission.colour;
    if (emission.kind == scene::Emission::Kind::Blackbody) {
      j *= light::blackbodyRadiance(emission.temperature);
    }
    if (emission.tiedToAbsorption) {
      j *= medium.sigmaT * (1.0 - medium.albedo);
    }
    packed.emission = j;
    packed.emissionKind = interop::kEmissionLinear;
  }
  return packed;
}

/// Emission of a grid medium; kelvin = temperatureScale * value + temperatureOffset.
struct GridEmission {
  const scene::Emission& settings;
  double temperatureScale = 1.0;

  double luminanceAt(double value) const {
    const double strength = settings.scale * luminance(settings.colour);
    if (settings.kind == scene::Emission::Kind::Linear) {
      return strength * std::max(value, 0.0);
    }
    return strength * luminance(light::blackbodyRadiance(temperatureScale * value + settings.temperatureOffset));
  }
};

/// How strongly each brick can glow: what chooses emission points. Emission is monotonic in the value.
std::vector<float> emissionMaxima(const BrickGrid& grid, const GridEmission& emission) {
  std::vector<float> maxima(grid.ranges.size());
  std::transform(grid.ranges.begin(), grid.ranges.end(), maxima.begin(), [&](const volume::Range& range) {
    return static_cast<float>(std::max(emission.luminanceAt(range.min), emission.luminanceAt(range.max)));
  });
  return maxima;
}

std::vector<float> densityMaxima(const BrickGrid& grid) {
  std::vector<float> maxima(grid.ranges.size());
  std::transform(grid.ranges.begin(), grid.ranges.end(), maxima.begin(),
                 [](const volume::Range& range) { return range.max; });
  return maxima;
}

std::vector<float> coarsen(const BrickGrid& grid, const std::vector<float>& maxima) {
  std::vector<float> coarse(std::size_t(grid.coarseCount.x) * grid.coarseCount.y * grid.coarseCount.z, 0.0f);
  std::size_t brick = 0;
  for (int z = 0; z < grid.brickCount.z; ++z) {
    for (int y = 0; y < grid.brickCount.y; ++y) {
      for (int x = 0; x < grid.brickCount.x; ++x, ++brick) {
        const glm::ivec3 cell = glm::ivec3(x, y, z) / volume::kCoarseEdge;
        float& target =
            coarse[cell.x + std::size_t(grid.coarseCount.x) * (cell.y + std::size_t(grid.coarseCount.y) * cell.z)];
        target = std::max(target, maxima[brick]);
      }
    }
  }
  return coarse;
}

/// A temperature grid whose maximum cannot be kelvin is mapped so that it peaks at light::kMappedMaximum.
double temperatureScaleFor(const scene::Emission& emission, const BrickGrid& grid, std::vector<std::string>& notes) {
  const double maximum = grid.maximum();
  const bool asGiven =
      !emission.temperatureAuto || emission.temperatureScale != 1.0 || emission.temperatureOffset != 0.0;
  if (asGiven || maximum >= light::kColdestGlow || maximum <= 0.0) {
    return emission.temperatureScale;
  }
  const double scale = light::kMappedMaximum / maximum;
  notes.push_back(fmt::format("grid \"{}\" is not in kelvin (maximum {:.4g}): its maximum is taken as {:.0f} K; "
                              "\"temperature_scale\": {:.6g} in \"emission\" says the same, another value overrides it",
                              grid.name, maximum, light::kMappedMaximum, scale));
  return scale;
}

class MediaPacker {
public:
  MediaPacker(const VolumeSet& volumes, const glm::dvec3& centre, PackedMedia& out)
      : volumes_(volumes), centre_(centre), out_(out) {}

  void addGrid(const scene::Medium& medium, const VolumeSet::Use& use) {
    Medium packed = commonFields(medium);
    packed.sigmaT = static_cast<float>(medium.densityScale);
    if (use.density && !volumes_.grids[*use.density].empty() && medium.densityScale > 0.0) {
      const BrickGrid& grid = volumes_.grids[*use.density];
      packed.densityGrid = place(*use.density, medium, densityMaxima(grid));
    }
    if (medium.emission && use.emission && !volumes_.grids[*use.emission].empty()) {
      addEmission(medium, *use.emission, packed);
    }
    if (packed.densityGrid == interop::kNoGrid && packed.emissionGrid == interop::kNoGrid) {
      return; // an empty volume costs nothing
    }
    if (packed.emissionGrid != interop::kNoGrid) {
      out_.emissive.push_back(static_cast<std::uint32_t>(out_.media.size()));
    }
    out_.media.push_back(packed);
  }

private:
  std::uint32_t place(std::size_t gridIndex, const scene::Medium& medium, std::vector<float> maxima) {
    const BrickGrid& grid = volumes_.grids[gridIndex];
    PackedMedia::Placement placement{gridIndex, packGrid(grid, medium.worldFromMedium, centre_), std::move(maxima), {}};
    placement.coarseMaxima = coarsen(grid, placement.maxima);
    out_.placements.push_back(std::move(placement));
    return static_cast<std::uint32_t>(out_.placements.size() - 1);
  }

  void addEmission(const scene::Medium& medium, std::size_t gridIndex, Medium& packed) {
    const BrickGrid& grid = volumes_.grids[gridIndex];
    const scene::Emission& settings = *medium.emission;
    const GridEmission emission{settings, temperatureScaleFor(settings, grid, out_.notes)};
    packed.emission = settings.scale * settings.colour;
    packed.emissionKind =
        settings.kind == scene::Emission::Kind::Linear ? interop::kEmissionLinear : interop::kEmissionBlackbody;
    packed.emissionTied = settings.tiedToAbsorption ? 1 : 0;
    packed.temperatureScale = static_cast<float>(emission.temperatureScale);
    packed.temperatureOffset = static_cast<float>(settings.temperatureOffset);
    packed.emissionGrid = place(gridIndex, medium, emissionMaxima(grid, emission));
  }

  const VolumeSet& volumes_;
  const glm::dvec3& centre_;
  PackedMedia& out_;
};

} // namespace

Bounds3 sceneBounds(const scene::Scene& scene, const VolumeSet& volumes) {
  Bounds3 bounds;
  for (std::size_t i = 0; i < scene.media.size(); ++i) {
    bounds.extend(mediumBounds(scene.media[i], volumes, volumes.uses[i]));
  }
  for (const scene::NamedLight& named : scene.lights) {
    if (const auto* point = std::get_if<scene::PointLight>(&named.light)) {
      bounds.extend(point->position);
    }
  }
  if (bounds.empty()) {
    bounds.extend(scene.camera.position);
  }
  return bounds;
}

interop::Grid packGrid(const BrickGrid& grid, const glm::dmat4& worldFromMedium, const glm::dvec3& centre) {
  const glm::dmat4 indexFromWorld = glm::inverse(worldFromMedium * grid.worldFromIndex);
  const glm::dmat4 voxelFromWorld = glm::translate(glm::dmat4(1.0), -glm::dvec3(grid.firstVoxel)) * indexFromWorld *
                                    glm::translate(glm::dmat4(1.0), centre);
  interop::Grid packed{};
  packed.voxelFromWorld = glm::mat4x3(glm::dmat4x3(voxelFromWorld));
  packed.boundsMin = grid.indexBounds().min - glm::dvec3(grid.firstVoxel);
  packed.boundsMax = grid.indexBounds().max - glm::dvec3(grid.firstVoxel);
  packed.brickCount = grid.brickCount;
  packed.coarseCount = grid.coarseCount;
  packed.format = formatOf(grid.storage);
  return packed;
}

interop::Phase packPhase(const scene::Phase& phase) {
  interop::Phase packed{static_cast<std::uint32_t>(phase.id), {}};
  if (phase.id == PhaseId::Mie) {
    packed.parameters = light::mieParameters(phase.parameters[0]);
    return packed;
  }
  for (int i = 0; i < 4; ++i) {
    packed.parameters[i] = static_cast<float>(phase.parameters[static_cast<std::size_t>(i)]);
  }
  return packed;
}

PackedMedia packMedia(const scene::Scene& scene, const VolumeSet& volumes, const glm::dvec3& centre) {
  PackedMedia out;
  for (const scene::Medium& medium : scene.media) {
    out.phaseMask |= 1u << static_cast<unsigned>(medium.phase.id);
    if (medium.homogeneous()) {
      out.media.push_back(packHomogeneous(medium, centre));
    }
  }
  out.homogeneousCount = static_cast<std::uint32_t>(out.media.size());
  MediaPacker packer(volumes, centre, out);
  for (std::size_t i = 0; i < scene.media.size(); ++i) {
    if (!scene.media[i].homogeneous()) {
      packer.addGrid(scene.media[i], volumes.uses[i]);
    }
  }
  return out;
}

interop::Camera packCamera(const scene::Camera& camera, const glm::uvec2& imageSize, const glm::dvec3& centre) {
  const auto [forward, right, up] = scene::cameraFrame(camera);
  const bool perspective = camera.kind == scene::Camera::Kind::Perspective;
  const double halfHeight = perspective ? std::tan(glm::radians(0.5 * camera.verticalFov)) : 0.5 * camera.height;
  const double halfWidth = halfHeight * imageSize.x / imageSize.y;
  const glm::dvec3 cornerOffset = halfHeight * up - halfWidth * right;
  const glm::dvec3 position = camera.position - centre;
  interop::Camera packed{};
  packed.origin = perspective ? position : position + cornerOffset;
  packed.corner = perspective ? forward + cornerOffset : forward;
  packed.rasterX = 2.0 * halfWidth * right;
  packed.rasterY = -2.0 * halfHeight * up;
  return packed;
}

} // namespace tyndall::gpu_scene
