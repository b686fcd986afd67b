// SPDX-License-Identifier: Apache-2.0
#include "bench/exact_picture.h"

#include "scene/load.h"
#include "verify/oracle_radiance.h"

#include <algorithm>
#include <cmath>

namespace tyndall::bench {
namespace {

constexpr int kNodes = 3;           ///< along a pixel's edge, of which one more must give the same
constexpr double kAgreement = 1e-3; ///< relative; far below any picture's error
constexpr double kCovered = 0.01;

/// Discs of suns are no part of the quadrature's background.
bool hasQuadrature(const scene::NamedLight& light) {
  const auto* sun = std::get_if<scene::SunLight>(&light.light);
  return std::holds_alternative<scene::PointLight>(light.light) ||
         (sun != nullptr && (sun->angularDiameter == 0.0 || !light.visible)) ||
         std::holds_alternative<scene::ConstantEnvironment>(light.light);
}

bool hasQuadrature(const scene::Medium& medium) {
  return medium.homogeneous() && medium.instances.empty() && medium.extinctionColour == glm::dvec3(1.0);
}

bool hasQuadrature(const scene::Scene& scene) {
  return scene.objects.empty() && scene.depth() == 1 && scene.camera.lensRadius == 0.0 && !scene.film.transparent &&
         std::ranges::all_of(scene.media, [](const scene::Medium& medium) { return hasQuadrature(medium); }) &&
         std::ranges::all_of(scene.lights, [](const scene::NamedLight& light) { return hasQuadrature(light); });
}

} // namespace

std::optional<ExactPicture> exactPicture(const SuiteScene& suiteScene) {
  if (!suiteScene.arguments.empty()) {
    return std::nullopt;
  }
  scene::Scene scene = scene::loadScene(suiteScene.file);
  if (!hasQuadrature(scene)) {
    return std::nullopt;
  }
  scene.film.size = suiteScene.size;
  const gpu_scene::VolumeSet none;
  const verify::OracleScene oracle(scene, none);
  const std::size_t pixels = std::size_t(suiteScene.size.x) * suiteScene.size.y;
  ExactPicture exact{{suiteScene.size, std::vector<double>(3 * pixels), std::vector<bool>(pixels)},
                     std::vector<bool>(pixels, true)};
  for (int channel = 0; channel < 3; ++channel) {
    const auto radiance = [&](const verify::OracleRay& ray) { return oracle.total(ray, channel); };
    const std::vector<double> coarse = oracle.picture(radiance, kNodes);
    const std::vector<double> fine = oracle.picture(radiance, kNodes + 1);
    for (std::size_t i = 0; i < pixels; ++i) {
      exact.picture.values[3 * i + std::size_t(channel)] = fine[i];
      exact.sure[i] = exact.sure[i] && std::abs(coarse[i] - fine[i]) <= kAgreement * std::abs(fine[i]);
    }
  }
  const std::vector<double> transmittance = oracle.transmittancePicture(kNodes);
  std::transform(transmittance.begin(), transmittance.end(), exact.picture.covered.begin(),
                 [](double share) { return 1.0 - share > kCovered; });
  return exact;
}

} // namespace tyndall::bench
