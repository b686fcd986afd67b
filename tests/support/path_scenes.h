// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/render_fixture.h"
#include "support/render_scenes.h"

#include <string>

/// Scenes with surfaces made by hand, and what tests of the pass `path` share.
namespace tyndall::test {

/// A TestScene with materials and objects. Paths are of unlimited length unless `depth` says otherwise.
struct PathScene : TestScene {
  explicit PathScene(const glm::uvec2& size = {16, 16});

  void depth(std::uint32_t events) { scene.render.depth = events; }
  /// Adds a material; objects name it. `colour`: see geometry::Material.
  geometry::Material& material(const std::string& name, MaterialId model, double colour = 0.0);
  /// A black material that shines on its front.
  geometry::Material& lamp(const std::string& name, double radiance);
  /// Front: the side of cross(edgeU, edgeV).
  scene::Object& quad(const std::string& material, const glm::dvec3& origin, const glm::dvec3& edgeU,
                      const glm::dvec3& edgeV);
  scene::Object& ball(const std::string& material, const glm::dvec3& centre, double radius);
  scene::Object& crate(const std::string& material, const glm::dvec3& low, const glm::dvec3& high);
  scene::Object& mesh(const std::string& material, const geometry::Mesh& mesh);
  /// The closed object that was added last holds a medium of its own.
  scene::Medium& fill(double sigmaT, double albedo = 1.0);
  void spot(const scene::SpotLight& light);

private:
  scene::Object& object(const std::string& material, scene::Object::Kind kind);
};

/// `options` by the pass `path`.
MomentOptions byPaths(MomentOptions options = {});
/// The same by light samples alone, by directions alone and by both.
std::vector<MomentOptions> eachTechnique(const MomentOptions& options = {});
/// "light", "direction" or "both", and how light is selected.
std::string techniqueOf(const MomentOptions& options);

/// Welch's t of the image means of a channel each.
Verdict channelTest(const Moments& a, int channelA, const Moments& b, int channelB);
Verdict channelTest(const Moments& a, const Moments& b, int channel = 0);

} // namespace tyndall::test
