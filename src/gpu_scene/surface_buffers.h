// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/buffer.h"
#include "gpu_scene/emitters.h"
#include "gpu_scene/surfaces.h"

#include <vector>

namespace tyndall::gpu_scene {

/// Surfaces and emitters in device memory. Nothing is allocated for what a scene has none of.
class SurfaceBuffers {
public:
  SurfaceBuffers() = default;
  /// @throws Error on exhausted memory.
  SurfaceBuffers(const gpu::Device& device, const PackedSurfaces& surfaces, const PackedEmitters& emitters);

  interop::Ptr<interop::Surfaces> surfaces() const { return surfaces_.ptr(); }
  interop::Ptr<interop::Emitters> emitters() const { return emitters_.ptr(); }
  std::size_t bytes() const;

private:
  void uploadTextures(const gpu::Device& device, const std::vector<const geometry::Texture*>& textures);

  gpu::Buffer<interop::BvhNode> nodes_;
  gpu::Buffer<interop::BvhPrimitive> primitives_;
  gpu::Buffer<interop::Triangle> triangles_;
  gpu::Buffer<interop::Vertex> vertices_;
  gpu::Buffer<interop::Sphere> spheres_;
  gpu::Buffer<interop::Instance> instances_;
  gpu::Buffer<interop::Material> materials_;
  gpu::Buffer<interop::Interior> interiors_;
  gpu::Buffer<interop::Motion> motions_;
  std::vector<gpu::Buffer<std::uint32_t>> texels_;
  gpu::Buffer<interop::Texture> textures_;
  gpu::Buffer<interop::Surfaces> surfaces_;
  gpu::Buffer<interop::Emitter> emitterList_;
  gpu::Buffer<interop::LightTreeNode> lightNodes_;
  gpu::Buffer<interop::Emitters> emitters_;
};

} // namespace tyndall::gpu_scene
