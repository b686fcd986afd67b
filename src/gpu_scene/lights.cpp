// SPDX-License-Identifier: Apache-2.0
#include "gpu_scene/lights.h"

#include "base/error.h"
#include "film/exr.h"
#include "light/sky.h"
#include "math/colour.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace tyndall::gpu_scene {
namespace {

using std::numbers::pi;

/// Sky maps are smooth: half a degree a texel.
constexpr glm::uvec2 kSkySize{512, 256};

/// A light's share of the selection, however weak it seems beside the others.
constexpr double kLeastShare = 1e-6;

/// Degrees. Float directions resolve 1e-7 radians: a smaller disc would lose samples at its rim, and lights like a
/// point.
constexpr double kLeastDiameter = 0.01;

class LightPacker {
public:
  LightPacker(const Bounds3& bounds, const glm::dvec3& centre, PackedLights& out)
      : bounds_(bounds), centre_(centre), out_(out) {}

  void add(const scene::NamedLight& named) {
    visible_ = named.visible;
    name_ = &named.name;
    std::visit([this](const auto& light) { addLight(light); }, named.light);
  }

  /// Pointers into the vectors: only once they no longer grow.
  void assignProbabilities() {
    double points = 0.0;
    points = std::accumulate(pointGuesses_.begin(), pointGuesses_.end(), points);
    const double all = std::accumulate(distantGuesses_.begin(), distantGuesses_.end(), points);
    for (std::size_t i = 0; i < pointGuesses_.size(); ++i) {
      out_.points[i].selectPdf = probability(pointGuesses_[i] / all);
      out_.points[i].equiangularPdf = probability(pointGuesses_[i] / points);
    }
    for (std::size_t i = 0; i < distantGuesses_.size(); ++i) {
      out_.distant[i].selectPdf = probability(distantGuesses_[i] / all);
    }
    normalise();
  }

private:
  static float probability(double share) { return static_cast<float>(std::max(share, kLeastShare)); }

  void normalise() {
    double points = 0.0;
    double equiangular = 0.0;
    double distant = 0.0;
    for (const interop::PointLight& light : out_.points) {
      points += double(light.selectPdf);
      equiangular += double(light.equiangularPdf);
    }
    for (const interop::DistantLight& light : out_.distant) {
      distant += double(light.selectPdf);
    }
    const double all = points + distant;
    for (interop::PointLight& light : out_.points) {
      light.selectPdf = static_cast<float>(double(light.selectPdf) / all);
      light.equiangularPdf = static_cast<float>(double(light.equiangularPdf) / equiangular);
    }
    for (interop::DistantLight& light : out_.distant) {
      light.selectPdf = static_cast<float>(double(light.selectPdf) / all);
    }
    out_.pointShare = out_.distant.empty() ? 1.0f : static_cast<float>(points / all);
  }

  void addLight(const scene::PointLight& light) {
    const double strength = luminance(light.intensity);
    if (strength <= 0.0) {
      return;
    }
    const double reach = std::max(0.5 * glm::length(bounds_.size()), glm::length(light.position - centre_));
    out_.points.push_back({glm::vec3(light.position - centre_), glm::vec3(light.intensity), 0.0f, 0.0f});
    pointGuesses_.push_back(reach > 0.0 ? strength / (reach * reach) : strength);
  }

  void addLight(const scene::SpotLight&) {} // an emitter: only paths know it

  void addDistant(interop::DistantLight light, double irradiance) {
    light.visible = visible_ ? 1 : 0;
    out_.background |= visible_ && light.kind != interop::kDistantDelta;
    out_.deltas |= light.kind == interop::kDistantDelta;
    out_.areas |= light.kind != interop::kDistantDelta;
    out_.distant.push_back(light);
    distantGuesses_.push_back(irradiance);
  }

  void addLight(const scene::SunLight& sun) {
    if (luminance(sun.irradiance) <= 0.0) {
      return;
    }
    interop::DistantLight light{};
    light.toLight = -sun.direction;
    light.kind = interop::kDistantDelta;
    light.radiance = sun.irradiance;
    if (sun.angularDiameter >= kLeastDiameter) {
      const double halfAngle = glm::radians(0.5 * sun.angularDiameter);
      const double sine = std::sin(halfAngle);
      light.kind = interop::kDistantDisc;
      light.oneMinusCos = static_cast<float>(2.0 * std::sin(0.5 * halfAngle) * std::sin(0.5 * halfAngle));
      // Irradiance on the perpendicular plane of a uniform disc: pi sin^2 L.
      light.radiance = sun.irradiance / (pi * sine * sine);
    }
    addDistant(light, luminance(sun.irradiance));
  }

  void addLight(const scene::ConstantEnvironment& environment) {
    if (luminance(environment.radiance) <= 0.0) {
      return;
    }
    interop::DistantLight light{};
    light.kind = interop::kDistantConstant;
    light.radiance = environment.radiance;
    addDistant(light, 4.0 * pi * luminance(environment.radiance));
  }

  void addTable(light::EnvironmentTable table, double rotationDegrees) {
    if (table.badTexels > 0) {
      out_.notes.push_back(
          fmt::format("light \"{}\": {} texels are negative or not finite and were set to 0", *name_, table.badTexels));
    }
    if (table.power <= 0.0) {
      return;
    }
    interop::DistantLight light{};
    light.kind = interop::kDistantMap;
    light.map = light::deviceMap(table, rotationDegrees, {}, {});
    const double power = table.power;
    out_.tables.push_back(std::move(table));
    addDistant(light, power);
  }

  void addLight(const scene::MapEnvironment& map) {
    const film::Image image = film::readExr(map.file);
    const auto channels = film::colourChannels(image, map.file);
    std::vector<glm::vec3> texels(channels[0]->size());
    for (std::size_t i = 0; i < texels.size(); ++i) {
      texels[i] = {(*channels[0])[i], (*channels[1])[i], (*channels[2])[i]};
    }
    addTable(light::makeEnvironment(texels, image.window.extent(), map.scale), map.rotation);
  }

  void addLight(const scene::SkyEnvironment& sky) {
    const light::SkyMap map = light::makeSky(sky.sunDirection, sky.turbidity, sky.groundAlbedo, kSkySize);
    addTable(light::makeEnvironment(map.radiance, map.size, sky.scale), 0.0);
  }

  const Bounds3& bounds_;
  const glm::dvec3& centre_;
  PackedLights& out_;
  std::vector<double> pointGuesses_;
  std::vector<double> distantGuesses_;
  bool visible_ = true;
  const std::string* name_ = nullptr;
};

} // namespace

PackedLights packLights(const scene::Scene& scene, const Bounds3& bounds, const glm::dvec3& centre) {
  PackedLights out;
  LightPacker packer(bounds, centre, out);
  for (const scene::NamedLight& named : scene.lights) {
    packer.add(named);
  }
  packer.assignProbabilities();
  // The strongest first: some estimators take those always, and draw one of the others.
  std::stable_sort(
      out.points.begin(), out.points.end(),
      [](const interop::PointLight& a, const interop::PointLight& b) { return a.selectPdf > b.selectPdf; });
  return out;
}

} // namespace tyndall::gpu_scene
