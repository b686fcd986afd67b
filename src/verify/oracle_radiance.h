// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/volumes.h"
#include "scene/scene.h"

#include <functional>
#include <vector>

namespace tyndall::verify {

struct OracleRay {
  glm::dvec3 origin{0.0};
  glm::dvec3 direction{0.0, 0.0, 1.0};  ///< unit
};

/// What light quadrature a ray's radiance uses.
struct OracleSettings {
  double relative = 1e-7;    ///< of the integral along the ray
  int polarNodes = 24;       ///< of environments; sun discs take 6
  int azimuths = 24;
};

/// Single scattering by quadrature in double, docs/theory.md (1): exact optical depths, adaptive integration along the
/// ray, Gauss-Legendre rules over discs and spheres of directions. Slow and simple. Lights: point, sun, constant.
class OracleScene {
public:
  OracleScene(const scene::Scene& scene, const gpu_scene::VolumeSet& volumes, const OracleSettings& settings = {});

  /// The camera's ray through x, y in [0, 1] across the image, y down.
  OracleRay cameraRay(const glm::dvec2& raster) const;
  /// Integral of the extinction of all media over t in [0, tMax].
  double opticalDepth(const OracleRay& ray, double tMax) const;
  /// Scattered and emitted radiance of one colour channel, without what lies behind the media.
  double radiance(const OracleRay& ray, int channel = 0) const;
  /// `radiance` plus the visible environment seen through the media. Sun discs are taken as outside the picture.
  double total(const OracleRay& ray, int channel = 0) const;

  /// Mean of a function of the ray over each pixel's footprint, by `nodes` x `nodes` Gauss-Legendre points.
  std::vector<double> picture(const std::function<double(const OracleRay&)>& function, int nodes) const;
  std::vector<double> transmittancePicture(int nodes) const;

private:
  double extinction(std::size_t medium, const glm::dvec3& point) const;
  double emission(std::size_t medium, const glm::dvec3& point, int channel) const;
  double inScattered(std::size_t medium, const glm::dvec3& point, const glm::dvec3& direction, int channel) const;
  double lightFrom(const scene::Light& light, std::size_t medium, const OracleRay& ray, int channel) const;
  double overCone(std::size_t medium, const OracleRay& ray, const glm::dvec3& axis, double cosine) const;
  std::vector<double> breaks(const OracleRay& ray) const;

  const scene::Scene& scene_;
  const gpu_scene::VolumeSet& volumes_;
  OracleSettings settings_;
  std::vector<glm::dmat4> mediumFromWorld_;
};

} // namespace tyndall::verify
