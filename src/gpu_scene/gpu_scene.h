// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/buffer.h"
#include "gpu_scene/atlas.h"
#include "gpu_scene/cell_grids.h"
#include "gpu_scene/emitters.h"
#include "gpu_scene/lights.h"
#include "gpu_scene/media.h"
#include "gpu_scene/medium_tree.h"
#include "gpu_scene/surface_buffers.h"
#include "gpu_scene/volumes.h"
#include "interop/scene.h"
#include "scene/scene.h"

#include <vector>

namespace tyndall::gpu_scene {

/// What of the scene needs code, buffers or passes. Everything else is left out of the pipelines.
struct Features {
  std::uint32_t phaseMask = 0;
  std::uint32_t formatMask = 0;
  bool homogeneous = false;
  bool grids = false;
  bool gridEmission = false;
  bool pointLights = false;
  bool distantDeltas = false;
  bool distantAreas = false;
  bool orthographic = false;
  bool background = false;
  // Of the pass `path` alone:
  bool homogeneousEmission = false;
  bool chromatic = false;
  bool surfaces = false;
  std::uint32_t materialMask = 0;
  bool textures = false;
  bool spheres = false;
  bool instances = false;
  bool motion = false; ///< surfaces stood elsewhere in the previous frame
  bool passing = false;
  bool interiors = false;
  bool emitters = false;
  bool emissiveSurfaces = false;
  bool volumeEmitters = false;
  bool aimed = false; ///< small lights in homogeneous media
  bool lens = false;
  bool mediumTree = false;     ///< many media with grids: a tree of their boxes is walked
  bool overlapOfGrids = false; ///< more than one medium with a density grid: delta tracking, see tracker/walk.glsl
};

/// How grids lie in device memory, and what else is there.
enum class GridLayout {
  Atlas, ///< as loaded, in 3D images: for null-collision tracking
  Cells, ///< as blocks of floats (interop/cells.h): for walks from cell to cell
  Paths  ///< as Atlas; surfaces and the light tree are uploaded too
};

/// A scene in device memory. Owns everything; kernels borrow addresses.
class GpuScene {
public:
  /// @param previous the frame before, for the motion of surfaces; nullptr: there is none.
  /// @throws Error if memory or image limits do not suffice.
  GpuScene(const gpu::Device& device, const scene::Scene& scene, const VolumeSet& volumes,
           GridLayout layout = GridLayout::Atlas, const Pose* previous = nullptr);

  interop::Ptr<interop::Scene> ptr() const { return scene_.ptr(); }
  gpu::AtlasImages images() const { return atlas_.images(); }
  GridLayout layout() const { return layout_; }
  const CellGrids& cells() const { return cellGrids_; }
  const PackedMedia& media() const { return packed_; }
  const std::vector<interop::PointLight>& pointLights() const { return lights_.points; }
  const std::vector<interop::DistantLight>& distantLights() const { return lights_.distant; }
  /// Of the environment maps among the distant lights, in their order.
  const std::vector<light::EnvironmentTable>& environmentTables() const { return lights_.tables; }
  const Features& features() const { return features_; }
  /// Homogeneous media and lights: what a stage of the trace pass loops over.
  std::uint32_t loopCount() const { return loopCount_; }
  const std::vector<std::string>& notes() const { return notes_; }
  const PackedSurfaces& surfaces() const { return surfaces_; }
  const PackedEmitters& emitters() const { return emitters_; }
  /// Bytes of surfaces, textures and light tree in device memory.
  std::size_t surfaceBytes() const { return surfaceBuffers_.bytes(); }
  glm::uvec2 imageSize() const { return imageSize_; }
  /// Of everything bounded, in world space.
  const Bounds3& bounds() const { return bounds_; }
  /// World-space point that device coordinates are relative to.
  const glm::dvec3& centre() const { return centre_; }
  /// In world space.
  const glm::dvec3& cameraPosition() const { return cameraPosition_; }

private:
  void addSurfaces(const gpu::Device& device, const scene::Scene& scene, const MeshSet& meshes,
                   const Pose* previous);
  void uploadGrids(const gpu::Device& device);
  void uploadLights(const gpu::Device& device);

  GridLayout layout_;
  glm::uvec2 imageSize_;
  Bounds3 bounds_;
  glm::dvec3 centre_{0.0};
  glm::dvec3 cameraPosition_{0.0};
  PackedMedia packed_;
  PackedLights lights_;
  PackedSurfaces surfaces_;
  PackedEmitters emitters_;
  SurfaceBuffers surfaceBuffers_;
  Atlas atlas_;
  CellGrids cellGrids_;
  Features features_;
  float emitterShare_ = 0.0f;
  std::uint32_t loopCount_ = 0;
  std::vector<std::string> notes_;
  std::vector<gpu::Buffer<interop::Brick>> bricks_;
  std::vector<gpu::Buffer<float>> maxima_;
  std::vector<gpu::Buffer<glm::vec3>> vectors_;
  std::vector<gpu::Buffer<interop::AliasEntry>> cells_;
  gpu::Buffer<interop::Grid> grids_;
  gpu::Buffer<interop::Medium> media_;
  gpu::Buffer<interop::MediumNode> mediumNodes_;
  gpu::Buffer<std::uint32_t> emissive_;
  gpu::Buffer<interop::PointLight> points_;
  gpu::Buffer<interop::DistantLight> distant_;
  gpu::Buffer<interop::Scene> scene_;
};

} // namespace tyndall::gpu_scene
