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
#include <map>
#include <numbers>

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
  Bounds3 bounds;
  for (const glm::dmat4& place : placements(medium.worldFromMedium, medium.instances)) {
    bounds.extend(transformed(place, local));
  }
  return bounds;
}

double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

Medium commonFields(const scene::Medium& medium) {
  Medium packed{};
  const double strongest = largest(medium.extinctionColour);
  packed.colour = strongest > 0.0 ? glm::vec3(medium.extinctionColour / strongest) : glm::vec3(1.0f);
  packed.emitter = interop::kNoEmitter;
  packed.phase = packPhase(medium.phase);
  packed.albedo = medium.albedo;
  packed.densityGrid = interop::kNoGrid;
  packed.emissionGrid = interop::kNoGrid;
  return packed;
}

/// World volume of a bounded shape; 0 for others.
double shapeVolume(const scene::Medium& medium, const glm::dmat4& worldFromMedium) {
  const double scale = std::abs(glm::determinant(glm::dmat3(worldFromMedium)));
  if (medium.shape == scene::MediumShape::Box) {
    const glm::dvec3 size = medium.box.size();
    return scale * size.x * size.y * size.z;
  }
  const double radius = medium.radius;
  return medium.shape == scene::MediumShape::Sphere ? scale * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius
                                                    : 0.0;
}

std::uint32_t deviceShape(scene::MediumShape shape) {
  switch (shape) {
  case scene::MediumShape::Unbounded:
    return interop::kShapeUnbounded;
  case scene::MediumShape::Box:
    return interop::kShapeBox;
  case scene::MediumShape::Sphere:
    return interop::kShapeSphere;
  case scene::MediumShape::Objects:
    return interop::kShapeInterior;
  }
  return interop::kShapeUnbounded;
}

Medium packHomogeneous(const scene::Medium& medium, const glm::dmat4& worldFromMedium, const glm::dvec3& centre) {
  Medium packed = commonFields(medium);
  packed.sigmaT = static_cast<float>(medium.sigmaT * largest(medium.extinctionColour));
  // About the shape's own centre: its corners may be given far from the origin.
  const bool sphere = medium.shape == scene::MediumShape::Sphere;
  const glm::dvec3 middle = sphere                                    ? medium.centre
                            : medium.shape == scene::MediumShape::Box ? medium.box.centre()
                                                                      : glm::dvec3(0.0);
  const glm::dmat4 mediumFromWorld = glm::translate(glm::dmat4(1.0), -middle) * glm::inverse(worldFromMedium) *
                                     glm::translate(glm::dmat4(1.0), centre);
  packed.mediumFromWorld = glm::mat4x3(glm::dmat4x3(mediumFromWorld));
  packed.shape = deviceShape(medium.shape);
  packed.shapeMin = sphere ? glm::dvec3(0.0) : medium.box.min - middle;
  packed.shapeMax = sphere ? glm::dvec3(medium.radius) : medium.box.max - middle;
  if (medium.emission) {
    const scene::Emission& emission = *medium.emission;
    glm::dvec3 j = emission.scale * emission.colour;
    if (emission.kind == scene::Emission::Kind::Blackbody) {
      j *= light::blackbodyRadiance(emission.temperature);
    }
    if (emission.tiedToAbsorption) {
      j *= medium.sigmaT * medium.extinctionColour * (1.0 - medium.albedo);
    }
    packed.emission = j;
    packed.emissionKind = luminance(j) > 0.0 ? interop::kEmissionLinear : interop::kEmissionNone;
    packed.emissionMeasure = static_cast<float>(shapeVolume(medium, worldFromMedium));
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

  void addGrid(const scene::Medium& medium, const VolumeSet::Use& use, const glm::dmat4& worldFromMedium) {
    Medium packed = commonFields(medium);
    worldFromMedium_ = worldFromMedium;
    packed.sigmaT = static_cast<float>(medium.densityScale * largest(medium.extinctionColour));
    if (use.density && !volumes_.grids[*use.density].empty() && medium.densityScale > 0.0) {
      const BrickGrid& grid = volumes_.grids[*use.density];
      packed.densityGrid = place(*use.density, {&medium, false}, [&] { return densityMaxima(grid); });
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
  /// What a placement's maxima are made of: a medium's density or its emission.
  using Source = std::pair<const scene::Medium*, bool>;

  template <class MakeMaxima>
  std::uint32_t place(std::size_t gridIndex, const Source& source, MakeMaxima makeMaxima) {
    const BrickGrid& grid = volumes_.grids[gridIndex];
    PackedMedia::Placement placement;
    placement.grid = gridIndex;
    placement.header = packGrid(grid, worldFromMedium_, centre_);
    const auto [first, isNew] = firstOf_.try_emplace(source, out_.placements.size());
    if (isNew) {
      placement.maxima = makeMaxima();
      placement.coarseMaxima = coarsen(grid, placement.maxima);
    } else {
      placement.sameAs = first->second;
    }
    out_.placements.push_back(std::move(placement));
    return static_cast<std::uint32_t>(out_.placements.size() - 1);
  }

  void addEmission(const scene::Medium& medium, std::size_t gridIndex, Medium& packed) {
    const BrickGrid& grid = volumes_.grids[gridIndex];
    const scene::Emission& settings = *medium.emission;
    std::vector<std::string> repeated; // said once, whatever the instances
    const bool first = !firstOf_.contains({&medium, true});
    const GridEmission emission{settings, temperatureScaleFor(settings, grid, first ? out_.notes : repeated)};
    packed.emission = settings.scale * settings.colour;
    packed.emissionKind =
        settings.kind == scene::Emission::Kind::Linear ? interop::kEmissionLinear : interop::kEmissionBlackbody;
    packed.emissionTied = settings.tiedToAbsorption ? 1 : 0;
    packed.temperatureScale = static_cast<float>(emission.temperatureScale);
    packed.temperatureOffset = static_cast<float>(settings.temperatureOffset);
    packed.emissionGrid = place(gridIndex, {&medium, true}, [&] { return emissionMaxima(grid, emission); });
    measureEmission(packed);
  }

  /// Sums over the bricks, by which a point of the emission is drawn: maximum times the volume inside the bounds.
  void measureEmission(Medium& packed) {
    PackedMedia::Placement& placement = out_.placements[packed.emissionGrid];
    const interop::Grid& header = placement.header;
    const double voxelVolume = 1.0 / std::abs(glm::determinant(glm::dmat3(glm::mat3(header.voxelFromWorld))));
    if (placement.sameAs) {
      const PackedMedia::Placement& first = out_.source(placement);
      const double firstVolume = 1.0 / std::abs(glm::determinant(glm::dmat3(glm::mat3(first.header.voxelFromWorld))));
      packed.emissionMeasure = static_cast<float>(double(first.cumulative.back()) / firstVolume * voxelVolume);
      return;
    }
    double sum = 0.0;
    std::size_t brick = 0;
    placement.cumulative.reserve(placement.maxima.size());
    for (int z = 0; z < header.brickCount.z; ++z) {
      for (int y = 0; y < header.brickCount.y; ++y) {
        for (int x = 0; x < header.brickCount.x; ++x, ++brick) {
          const glm::dvec3 low =
              glm::max(glm::dvec3(x, y, z) * double(interop::kBrickEdge), glm::dvec3(header.boundsMin));
          const glm::dvec3 high =
              glm::min(glm::dvec3(x + 1, y + 1, z + 1) * double(interop::kBrickEdge), glm::dvec3(header.boundsMax));
          const glm::dvec3 size = glm::max(high - low, glm::dvec3(0.0));
          sum += double(placement.maxima[brick]) * size.x * size.y * size.z * voxelVolume;
          placement.cumulative.push_back(static_cast<float>(sum));
        }
      }
    }
    packed.emissionMeasure = static_cast<float>(sum);
  }

  const VolumeSet& volumes_;
  const glm::dvec3& centre_;
  PackedMedia& out_;
  glm::dmat4 worldFromMedium_{1.0};
  std::map<Source, std::size_t> firstOf_;
};

} // namespace

Bounds3 sceneBounds(const scene::Scene& scene, const VolumeSet& volumes) {
  Bounds3 bounds;
  for (std::size_t i = 0; i < scene.media.size(); ++i) {
    bounds.extend(mediumBounds(scene.media[i], volumes, volumes.uses[i]));
  }
  bounds.extend(objectBounds(scene, volumes.meshes));
  for (const scene::NamedLight& named : scene.lights) {
    if (const auto* point = std::get_if<scene::PointLight>(&named.light)) {
      bounds.extend(point->position);
    } else if (const auto* spot = std::get_if<scene::SpotLight>(&named.light)) {
      bounds.extend(spot->position);
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
  out.indexOf.assign(scene.media.size(), interop::kNoMedium);
  for (std::size_t i = 0; i < scene.media.size(); ++i) {
    const scene::Medium& medium = scene.media[i];
    out.phaseMask |= 1u << static_cast<unsigned>(medium.phase.id);
    out.chromatic |= medium.extinctionColour != glm::dvec3(medium.extinctionColour.x);
    if (medium.homogeneous()) {
      out.indexOf[i] = static_cast<std::uint32_t>(out.media.size());
      for (const glm::dmat4& place : placements(medium.worldFromMedium, medium.instances)) {
        out.media.push_back(packHomogeneous(medium, place, centre));
      }
    }
  }
  out.homogeneousCount = static_cast<std::uint32_t>(out.media.size());
  MediaPacker packer(volumes, centre, out);
  for (std::size_t i = 0; i < scene.media.size(); ++i) {
    if (!scene.media[i].homogeneous()) {
      out.indexOf[i] = static_cast<std::uint32_t>(out.media.size());
      for (const glm::dmat4& place : placements(scene.media[i].worldFromMedium, scene.media[i].instances)) {
        packer.addGrid(scene.media[i], volumes.uses[i], place);
      }
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
  if (perspective && camera.lensRadius > 0.0) {
    packed.lensX = camera.lensRadius * right;
    packed.lensY = camera.lensRadius * up;
  }
  packed.focusDistance = static_cast<float>(camera.focusDistance);
  return packed;
}

} // namespace tyndall::gpu_scene
