// SPDX-License-Identifier: Apache-2.0
#include "gpu_scene/gpu_scene.h"

#include "light/blackbody.h"

#include <algorithm>

namespace tyndall::gpu_scene {
namespace {

template <class T>
std::span<const T> view(const std::vector<T>& values) {
  return {values.data(), values.size()};
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

GpuScene::GpuScene(const gpu::Device& device, const scene::Scene& scene, const VolumeSet& volumes, GridLayout layout)
    : layout_(layout), bounds_(sceneBounds(scene, volumes)), centre_(bounds_.centre()),
      packed_(packMedia(scene, volumes, centre_)), lights_(packLights(scene, bounds_, centre_)) {
  if (layout == GridLayout::Cells) {
    cellGrids_ = CellGrids(device, packed_, volumes);
  } else {
    atlas_ = Atlas(device, volumes.grids);
    uploadGrids(device);
  }
  features_ = featuresOf(scene, packed_, lights_, atlas_.formatMask());
  loopCount_ = static_cast<std::uint32_t>(packed_.homogeneousCount + lights_.points.size() + lights_.distant.size());
  notes_ = packed_.notes;
  notes_.insert(notes_.end(), lights_.notes.begin(), lights_.notes.end());

  uploadLights(device);
  media_ = gpu::Buffer<interop::Medium>(device, view(packed_.media));
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

void GpuScene::uploadGrids(const gpu::Device& device) {
  std::vector<interop::Grid> headers;
  for (PackedMedia::Placement& placement : packed_.placements) {
    bricks_.emplace_back(device, view(atlas_.records(placement.grid)));
    placement.header.bricks = bricks_.back().ptr();
    maxima_.emplace_back(device, view(placement.maxima));
    placement.header.maxima = maxima_.back().ptr();
    maxima_.emplace_back(device, view(placement.coarseMaxima));
    placement.header.coarseMaxima = maxima_.back().ptr();
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
