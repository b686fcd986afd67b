// SPDX-License-Identifier: Apache-2.0
#include "gpu_scene/raster.h"

#include "gpu_scene/media.h"

namespace tyndall::gpu_scene {

glm::mat4x3 rasterFromWorld(const scene::Camera& camera, const glm::uvec2& imageSize, const glm::dvec3& centre) {
  const interop::Camera packed = packCamera(camera, imageSize, centre);
  const glm::dmat3 linear = glm::inverse(glm::dmat3(packed.rasterX, packed.rasterY, packed.corner));
  glm::dmat4x3 raster(linear[0], linear[1], linear[2], -linear * glm::dvec3(packed.origin));
  if (camera.kind == scene::Camera::Kind::Orthographic) { // its z is a distance, by which nothing shrinks
    for (int column = 0; column < 4; ++column) {
      raster[column].z = column == 3 ? 1.0 : 0.0;
    }
  }
  return glm::mat4x3(raster);
}

} // namespace tyndall::gpu_scene
