// SPDX-License-Identifier: Apache-2.0
#include "scene/checks.h"

#include "interop/guide.h"
#include "scene/check_report.h"
#include "scene/checks_surfaces.h"

#include <fmt/format.h>

#include <algorithm>

namespace tyndall::scene {
namespace {

class Checker {
public:
  Checker(const Scene& scene, CheckReport& report) : scene_(scene), report_(report) {}

  void run() {
    checkCamera();
    checkGuide();
    report_.checkNames("media", scene_.media);
    report_.checkNames("lights", scene_.lights);
    for (std::size_t i = 0; i < scene_.media.size(); ++i) {
      checkMedium(scene_.media[i], fmt::format("media.{}", i));
    }
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
      checkLight(scene_.lights[i].light, fmt::format("lights.{}", i));
    }
    checkSomethingToSee();
  }

private:
  void checkCamera() {
    const Camera& camera = scene_.camera;
    if (report_.wrong("camera", {"position", "target", "up"})) {
      return;
    }
    if (camera.target == camera.position) {
      return report_.error("camera.target", "is the point where the camera stands; move one of them, so that there is "
                                            "a direction to look in");
    }
    const glm::dvec3 forward = glm::normalize(camera.target - camera.position);
    if (glm::length(glm::cross(forward, camera.up)) < 1e-6) {
      report_.error("camera.up", "is parallel to the direction of view; choose another, such as [0, 0, 1] for a camera "
                                 "that looks straight up or down");
    }
  }

  /// Of two settings that contradict each other the one is blamed that is not the integrator's own.
  void checkGuide() {
    const GuideSettings& guide = scene_.guide;
    const GuideSettings usual = guideSettings(guide.preset);
    if (!report_.wrong("guide", {"loads", "states"}) && guide.loads * guide.states > interop::kMostLobes) {
      report_.error(guide.loads != usual.loads ? "guide.loads" : "guide.states",
                    fmt::format("makes {} lobes, {} loads times {} states, but {} is the most; take at most {} loads "
                                "or {} states",
                                guide.loads * guide.states, guide.loads, guide.states, interop::kMostLobes,
                                interop::kMostLobes / guide.states, interop::kMostLobes / guide.loads));
    }
    if (!report_.wrong("guide", {"least_share", "most_share"}) && guide.leastShare > guide.mostShare) {
      report_.error(guide.leastShare != usual.leastShare ? "guide.least_share" : "guide.most_share",
                    fmt::format("leaves nothing between the least_share of {} and the most_share of {}; make the least "
                                "at most the most",
                                guide.leastShare, guide.mostShare));
    }
    if (!report_.wrong("render", {"integrator", "deterministic"}) && scene_.render.deterministic &&
        scene_.render.integrator == Integrator::ScreenChains) {
      report_.error("render.deterministic",
                    "needs an integrator that learns in a fixed order, which screen-chains does "
                    "not; take mcpg, or leave --deterministic away");
    }
    if (!report_.wrong("guide", {"distance_share"}) && scene_.render.deterministic && guidesDistances(guide)) {
      report_.error("guide.distance_share",
                    "must be 0 with --deterministic: distance chains are not written in a fixed order; set it to 0, or "
                    "leave --deterministic away");
    }
  }

  void checkMedium(const Medium& medium, const std::string& path) {
    if (medium.homogeneous() && medium.shape == MediumShape::Box) {
      report_.checkBox(medium.box, path + ".shape");
    }
    if (medium.clip) {
      report_.checkBox(*medium.clip, path + ".clip");
    }
    if (report_.wrong(path, {"type", "file", "shape.type", "extinction", "extinction_colour", "emission"})) {
      return;
    }
    if (medium.grid == "none" && !medium.emission) {
      report_.warning(path + ".grid", "is \"none\" and there is no emission, so that nothing of this medium is seen; "
                                      "name a grid or add \"emission\"");
    }
    if (medium.homogeneous() && medium.shape == MediumShape::Unbounded) {
      checkUnbounded(medium, path);
    }
  }

  void checkUnbounded(const Medium& medium, const std::string& path) {
    if (!medium.instances.empty() && !report_.wrong(path, {"instances"})) {
      report_.error(path + ".instances", "copies a medium that fills all space already; remove it or give the medium a "
                                         "shape");
    }
    const glm::dvec3 extinction = medium.sigmaT * medium.extinctionColour;
    const bool clear = std::min({extinction.x, extinction.y, extinction.z}) == 0.0;
    if (clear && medium.emission && !medium.emission->tiedToAbsorption) {
      report_.error(path + ".emission", "shines from infinitely far, because the medium is unbounded and absorbs "
                                        "nothing; give it a shape or an extinction above 0 in every channel");
    }
    if (extinction != glm::dvec3(0.0)) {
      checkDistantLights(path);
    }
  }

  /// Between the camera and infinity an unbounded medium has infinite optical depth.
  void checkDistantLights(const std::string& path) {
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
      const Light& light = scene_.lights[i].light;
      const bool local = std::holds_alternative<PointLight>(light) || std::holds_alternative<SpotLight>(light);
      if (local || report_.wrong(fmt::format("lights.{}", i), {"type"})) {
        continue;
      }
      report_.error(path + ".shape",
                    fmt::format("is unbounded: no light comes from infinity (lights.{}) through a medium that fills "
                                "all space, and the picture would be black; give it a shape, such as {{\"type\": "
                                "\"box\", \"min\": [-1, -1, -1], \"max\": [1, 1, 1]}}, or use lights that have a place",
                                i));
      return;
    }
  }

  void checkLight(const Light& light, const std::string& path) {
    const auto* sky = std::get_if<SkyEnvironment>(&light);
    if (sky != nullptr && !report_.wrong(path, {"sun_direction"}) && sky->sunDirection.y > 0.0) {
      report_.warning(path + ".sun_direction", "points up: it is the way the light travels, so that the sun is below "
                                               "the horizon and the sky dark; by day y is negative");
    }
    const auto* spot = std::get_if<SpotLight>(&light);
    if (spot != nullptr && !report_.wrong(path, {"inner_angle", "outer_angle"}) &&
        spot->innerAngle > spot->outerAngle) {
      report_.error(path + ".inner_angle", fmt::format("is {}, beyond the outer_angle of {}; make it at most that",
                                                       spot->innerAngle, spot->outerAngle));
    }
  }

  void checkSomethingToSee() {
    const bool glows = std::any_of(scene_.media.begin(), scene_.media.end(),
                                   [](const Medium& medium) { return medium.emission.has_value(); });
    const bool broken = report_.errorIn("lights") || report_.errorIn("media") || report_.errorIn("materials") ||
                        report_.errorIn("objects");
    if (scene_.lights.empty() && !glows && !surfacesMayShine(scene_) && !broken) {
      report_.warning("lights", "there are no lights and no emission: the picture will be black; add a light, such as "
                                "{\"type\": \"sun\", \"direction\": [0, -1, 0], \"irradiance\": 3}");
    }
    if (scene_.media.empty() && scene_.objects.empty() && !broken) {
      report_.warning("media", "there are no media and no objects: nothing scatters light; add one, such as "
                               "{\"type\": \"grid\", \"file\": \"cloud.vdb\"}");
    }
  }

  const Scene& scene_;
  CheckReport& report_;
};

} // namespace

void checkScene(const Scene& scene, const json::Value& root, Findings& findings) {
  // Findings without a path come from the text itself: values are then missing from the scene.
  const bool unread = std::any_of(findings.all().begin(), findings.all().end(),
                                  [](const Finding& finding) { return finding.path.empty(); });
  if (!unread) {
    CheckReport report(root, findings);
    Checker(scene, report).run();
    checkSurfaces(scene, report);
  }
}

} // namespace tyndall::scene
