// SPDX-License-Identifier: Apache-2.0
#include "gpu_scene/surface_buffers.h"

namespace tyndall::gpu_scene {
namespace {

template <class T>
gpu::Buffer<T> upload(const gpu::Device& device, const std::vector<T>& values) {
  return values.empty() ? gpu::Buffer<T>() : gpu::Buffer<T>(device, std::span<const T>(values));
}

std::uint32_t deviceWrap(geometry::Wrap wrap) {
  switch (wrap) {
  case geometry::Wrap::Repeat:
    return interop::kWrapRepeat;
  case geometry::Wrap::Clamp:
    return interop::kWrapClamp;
  case geometry::Wrap::Mirror:
    return interop::kWrapMirror;
  }
  return interop::kWrapRepeat;
}

} // namespace

SurfaceBuffers::SurfaceBuffers(const gpu::Device& device, const PackedSurfaces& surfaces,
                               const PackedEmitters& emitters) {
  if (!surfaces.materials.empty()) {
    nodes_ = upload(device, surfaces.bvh.nodes);
    primitives_ = upload(device, surfaces.bvh.primitives);
    triangles_ = upload(device, surfaces.triangles);
    vertices_ = upload(device, surfaces.vertices);
    spheres_ = upload(device, surfaces.spheres);
    instances_ = upload(device, surfaces.instances);
    materials_ = upload(device, surfaces.materials);
    interiors_ = upload(device, surfaces.interiors);
    motions_ = upload(device, surfaces.motions);
    uploadTextures(device, surfaces.textures);
    interop::Surfaces header{};
    header.nodes = nodes_.ptr();
    header.primitives = primitives_.ptr();
    header.triangles = triangles_.ptr();
    header.vertices = vertices_.ptr();
    header.spheres = spheres_.ptr();
    header.instances = instances_.ptr();
    header.materials = materials_.ptr();
    header.textures = textures_.ptr();
    header.interiors = interiors_.ptr();
    header.motions = motions_.ptr();
    header.boundsMin = surfaces.bvh.bounds.min;
    header.boundsMax = surfaces.bvh.bounds.max;
    surfaces_ = gpu::Buffer<interop::Surfaces>(device, std::span<const interop::Surfaces>(&header, 1));
  }
  if (!emitters.emitters.empty()) {
    emitterList_ = upload(device, emitters.emitters);
    lightNodes_ = upload(device, emitters.nodes);
    const interop::Emitters header{emitterList_.ptr(), lightNodes_.ptr(),
                                   static_cast<std::uint32_t>(emitters.emitters.size()), 0};
    emitters_ = gpu::Buffer<interop::Emitters>(device, std::span<const interop::Emitters>(&header, 1));
  }
}

void SurfaceBuffers::uploadTextures(const gpu::Device& device, const std::vector<const geometry::Texture*>& textures) {
  std::vector<interop::Texture> headers;
  for (const geometry::Texture* texture : textures) {
    texels_.push_back(upload(device, texture->texels));
    headers.push_back({texels_.back().ptr(), texture->size, deviceWrap(texture->wrapU), deviceWrap(texture->wrapV),
                       texture->srgb ? 1u : 0u, texture->nearest ? 1u : 0u});
  }
  textures_ = upload(device, headers);
}

std::size_t SurfaceBuffers::bytes() const {
  std::size_t sum = nodes_.bytes() + primitives_.bytes() + triangles_.bytes() + vertices_.bytes() + spheres_.bytes() +
                    instances_.bytes() + materials_.bytes() + interiors_.bytes() + motions_.bytes() + textures_.bytes() +
                    surfaces_.bytes() + emitterList_.bytes() + lightNodes_.bytes() + emitters_.bytes();
  for (const gpu::Buffer<std::uint32_t>& texels : texels_) {
    sum += texels.bytes();
  }
  return sum;
}

} // namespace tyndall::gpu_scene
