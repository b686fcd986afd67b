// SPDX-License-Identifier: Apache-2.0
#include "gpu_scene/gpu_scene.h"

#include "light/blackbody.h"

#include <algorithm>
#include <limits>
#include <span>

namespace tyndall::gpu_scene {
namespace {

template <class T>
std::span<const T> view(const std::vector<T>& values) {
  return {values.data(), values.size()};
}

/// Where a scene has emitters as well as lights at infinity, each kind gets half of the light samples.
constexpr float kEmitterShare = 0.5f;

void addPathFeatures(const scene::Scene& scene, const PackedMedia& media, const PackedSurfaces& surfaces,
                     const PackedEmitters& emitters, Features& features) {
  const auto homogeneous = std::span(media.media).subspan(0, media.homogeneousCount);
  features.homogeneousEmission = std::any_of(homogeneous.begin(), homogeneous.end(), [](const interop::Medium& medium) {
    return medium.emissionKind != interop::kEmissionNone;
  });
  features.chromatic = media.chromatic;
  features.surfaces = !surfaces.triangles.empty() || !surfaces.spheres.empty();
  features.materialMask = surfaces.materialMask;
  features.textures = surfaces.textured;
  features.spheres = !surfaces.spheres.empty();
  features.instances = !surfaces.instances.empty();
  features.motion = !surfaces.motions.empty();
  features.passing = surfaces.passing;
  features.interiors = !surfaces.interiors.empty();
  features.emitters = !emitters.emitters.empty();
  features.emissiveSurfaces =
      std::any_of(surfaces.materials.begin(), surfaces.materials.end(),
                  [](const interop::Material& material) { return material.emission != glm::vec3(0.0f); });
  features.volumeEmitters = emitters.volumes;
  features.aimed = emitters.small && media.homogeneousCount > 0;
  features.lens = scene.camera.kind == scene::Camera::Kind::Perspective && scene.camera.lensRadius > 0.0;
}

Features featuresOf(const scene::Scene& scene, const PackedMedia& media, const PackedLights& lights,
                    std::uint32_t formatMask) {
  Features features;
  features.phaseMask = media.phaseMask;
  features.formatMask = formatMask;
  features.homogeneous = media.homogeneousCount > 0;
  const auto gridMedia = media.media.size() - media.homogeneousCount;
  features.grids = gridMedia > 0;
  const auto dense = std::count_if(media.media.begin(), media.media.end(), [](const interop::Medium& medium) {
    return medium.densityGrid != interop::kNoGrid;
  });
  features.overlapOfGrids = dense > 1;
  features.gridEmission = !media.emissive.empty();
  features.pointLights = !lights.points.empty();
  features.distantDeltas = lights.deltas;
  features.distantAreas = lights.areas;
  features.orthographic = scene.camera.kind == scene::Camera::Kind::Orthographic;
  features.background = lights.background;
  return features;
}

} // namespace

GpuScene::GpuScene(const gpu::Device& device, const scene::Scene& scene, const VolumeSet& volumes, GridLayout layout,
                   const Pose* previous)
    : layout_(layout), imageSize_(scene.film.size), bounds_(sceneBounds(scene, volumes)), centre_(bounds_.centre()),
      cameraPosition_(scene.camera.position),
      packed_(packMedia(scene, volumes, centre_)), lights_(packLights(scene, bounds_, centre_)) {
  if (layout == GridLayout::Paths) {
    addSurfaces(device, scene, volumes.meshes, previous);
  }
  if (layout == GridLayout::Cells) {
    cellGrids_ = CellGrids(device, packed_, volumes);
  } else {
    atlas_ = Atlas(device, volumes.grids);
    uploadGrids(device);
  }
  features_ = featuresOf(scene, packed_, lights_, atlas_.formatMask());
  addPathFeatures(scene, packed_, surfaces_, emitters_, features_);
  loopCount_ = static_cast<std::uint32_t>(packed_.homogeneousCount + lights_.points.size() + lights_.distant.size());
  notes_ = packed_.notes;
  notes_.insert(notes_.end(), lights_.notes.begin(), lights_.notes.end());
  notes_.insert(notes_.end(), surfaces_.notes.begin(), surfaces_.notes.end());

  uploadLights(device);
  media_ = gpu::Buffer<interop::Medium>(device, view(packed_.media));
  std::vector<interop::MediumNode> nodes;
  if (layout != GridLayout::Cells && packed_.media.size() - packed_.homogeneousCount >= kMediumTreeFrom) {
    nodes = mediumTree(packed_);
    mediumNodes_ = gpu::Buffer<interop::MediumNode>(device, view(nodes));
    features_.mediumTree = true;
  }
  emissive_ = gpu::Buffer<std::uint32_t>(device, view(packed_.emissive));

  interop::Scene header{};
  header.camera = packCamera(scene.camera, scene.film.size, centre_);
  header.imageSize = scene.film.size;
  header.homogeneousCount = packed_.homogeneousCount;
  header.mediumCount = static_cast<std::uint32_t>(packed_.media.size());
  header.emissiveCount = static_cast<std::uint32_t>(packed_.emissive.size());
  header.pointCount = static_cast<std::uint32_t>(lights_.points.size());
  header.distantCount = static_cast<std::uint32_t>(lights_.distant.size());
  header.pointShare = lights_.pointShare;
  header.camera.interiors = surfaces_.cameraInteriors;
  header.maxEvents = scene.depth() == 0 ? std::numeric_limits<std::uint32_t>::max() : scene.depth();
  header.emitterShare = emitterShare_;
  header.mediumNodeCount = static_cast<std::uint32_t>(nodes.size());
  header.mediumNodes = mediumNodes_.ptr();
  header.surfaces = surfaceBuffers_.surfaces();
  header.emitters = surfaceBuffers_.emitters();
  header.media = media_.ptr();
  header.grids = grids_.ptr();
  header.emissive = emissive_.ptr();
  header.points = points_.ptr();
  header.distant = distant_.ptr();
  if (std::any_of(packed_.media.begin(), packed_.media.end(),
                  [](const interop::Medium& medium) { return medium.emissionKind == interop::kEmissionBlackbody; })) {
    vectors_.emplace_back(device, view(light::blackbodyTable()));
    header.blackbody = vectors_.back().ptr();
  }
  scene_ = gpu::Buffer<interop::Scene>(device, std::span<const interop::Scene>(&header, 1));
}

void GpuScene::addSurfaces(const gpu::Device& device, const scene::Scene& scene, const MeshSet& meshes,
                           const Pose* previous) {
  surfaces_ = packSurfaces(scene, meshes, packed_.indexOf, centre_, previous);
  for (std::size_t i = 0; i < surfaces_.interiors.size(); ++i) {
    if (surfaces_.interiors[i].medium != interop::kNoMedium) {
      packed_.media[surfaces_.interiors[i].medium].interiors |= 1u << i;
    }
  }
  emitters_ = packEmitters(scene, surfaces_, packed_, bounds_);
  surfaceBuffers_ = SurfaceBuffers(device, surfaces_, emitters_);
  // Light selection of paths: emitters by the tree, the rest by their own shares.
  if (!emitters_.emitters.empty() && !lights_.distant.empty()) {
    emitterShare_ = kEmitterShare;
  } else {
    emitterShare_ = emitters_.emitters.empty() ? 0.0f : 1.0f;
  }
  for (interop::DistantLight& light : lights_.distant) {
    light.selectPdf *= (1.0f - emitterShare_) / (1.0f - lights_.pointShare);
  }
}

void GpuScene::uploadGrids(const gpu::Device& device) {
  std::vector<interop::Grid> headers;
  for (PackedMedia::Placement& placement : packed_.placements) {
    if (placement.sameAs) {
      const interop::Grid& first = headers[*placement.sameAs];
      placement.header.bricks = first.bricks;
      placement.header.maxima = first.maxima;
      placement.header.coarseMaxima = first.coarseMaxima;
      placement.header.cumulative = first.cumulative;
      headers.push_back(placement.header);
      continue;
    }
    bricks_.emplace_back(device, view(atlas_.records(placement.grid)));
    placement.header.bricks = bricks_.back().ptr();
    const auto upload = [&](const std::vector<float>& values) {
      maxima_.emplace_back(device, view(values));
      return maxima_.back().ptr();
    };
    placement.header.maxima = upload(placement.maxima);
    placement.header.coarseMaxima = upload(placement.coarseMaxima);
    if (!placement.cumulative.empty()) {
      placement.header.cumulative = upload(placement.cumulative);
    }
    headers.push_back(placement.header);
  }
  grids_ = gpu::Buffer<interop::Grid>(device, view(headers));
}

void GpuScene::uploadLights(const gpu::Device& device) {
  auto table = lights_.tables.begin();
  for (interop::DistantLight& light : lights_.distant) {
    if (light.kind == interop::kDistantMap) {
      vectors_.emplace_back(device, view(table->texels));
      light.map.texels = vectors_.back().ptr();
      cells_.emplace_back(device, view(table->cells));
      light.map.cells = cells_.back().ptr();
      ++table;
    }
  }
  points_ = gpu::Buffer<interop::PointLight>(device, view(lights_.points));
  distant_ = gpu::Buffer<interop::DistantLight>(device, view(lights_.distant));
}

} // namespace tyndall::gpu_scene
