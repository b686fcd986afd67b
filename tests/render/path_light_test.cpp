// SPDX-License-Identifier: Apache-2.0
// Lights seen by paths, against closed forms and quadrature: the sphere light in fog (docs/theory.md A3), a ball that
// glows, a spot, holes in the way.
#include "support/path_scenes.h"
#include "verify/oracle_sphere.h"
#include "verify/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tyndall::test {
namespace {

using std::numbers::pi;

const BallInFog kBall;

/// One standard error is some 0.1 %.
TEST(SphereLightInFog, AgreesWithQuadratureByEachTechnique) {
  const PathScene test = kBall.withLamp();
  const double reference = kBall.lampRadiance();
  for (const MomentOptions& options : eachTechnique({.replicates = 24, .samples = 128})) {
    EXPECT_AGREES(imageTest(renderMoments(test.scene, test.volumes, options), reference, 0, 2e-5))
        << techniqueOf(options);
  }
  const MomentOptions both = byPaths({.replicates = 24, .samples = 64});
  const MomentOptions bad = withBug(both, interop::kBugBranchPdf);
  EXPECT_DIFFERS(imageTest(renderMoments(test.scene, test.volumes, bad), reference, 0, 2e-5));
}

/// The same place glows in all of its volume: emission 2 W/(m3 sr) within the fog, which dims it.
TEST(GlowingBall, InFogAgreesWithQuadratureByEachTechnique) {
  PathScene test = kBall.fog();
  test.sphere(kBall.centre, kBall.radius, 0.0, 0.0).emission = scene::Emission{};
  test.scene.media.back().emission->scale = 2.0;
  const double reference = kBall.airlight([](const Chord& chord) {
    return 2.0 * std::exp(-kBall.sigmaT * chord.first) * -std::expm1(-kBall.sigmaT * (chord.last - chord.first)) / kBall.sigmaT;
  });
  for (const MomentOptions& options : eachTechnique({.replicates = 24, .samples = 128})) {
    EXPECT_AGREES(imageTest(renderMoments(test.scene, test.volumes, options), reference, 0, 2e-5))
        << techniqueOf(options);
  }
}

/// Seen directly: j times the chord, whatever the techniques.
TEST(GlowingBall, SeenDirectlyIsAsBrightAsItsChordIsLong) {
  PathScene test({8, 8});
  test.perspective({0.0, 0.0, 4.0}, {0.4, 0.2, 0.0}, 1e-6);
  test.sphere({0.0, 0.0, 0.0}, 1.0, 0.0, 0.0).emission = scene::Emission{};
  const Chord chord = chordOf({0.0, 0.0, -4.0}, 1.0, glm::normalize(glm::dvec3(0.4, 0.2, -4.0)));
  const Moments moments = renderMoments(test.scene, test.volumes, byPaths({.replicates = 8}));
  EXPECT_AGREES(imageTest(moments, chord.last - chord.first, 0, 1e-5));
  EXPECT_DIFFERS(imageTest(moments, 1.001 * (chord.last - chord.first), 0, 1e-5)); // planted: 0.1 % off
}

/// A camera that looks straight down at a point of the floor y = 0.
PathScene floorView(const glm::dvec2& spot, double fov = 1e-6) {
  PathScene test({8, 8});
  test.perspective({spot.x, 3.0, spot.y}, {spot.x, 0.0, spot.y}, fov);
  test.scene.camera.up = {0.0, 0.0, -1.0};
  test.material("floor", MaterialId::Diffuse, 0.7);
  test.quad("floor", {-20.0, 0.0, 20.0}, {40.0, 0.0, 0.0}, {0.0, 0.0, -40.0});
  return test;
}

TEST(GlowingBall, LightsAFloorByEachTechnique) {
  PathScene test = floorView({0.5, 0.2});
  const glm::dvec3 centre(-0.6, 1.1, -0.3);
  test.sphere(centre, 0.7, 0.0, 0.0).emission = scene::Emission{};
  const glm::dvec3 toCentre = centre - glm::dvec3(0.5, 0.0, 0.2);
  const double reference = 0.7 / pi * overSphere(toCentre, 0.7, [&](const glm::dvec3& w) {
                             const Chord chord = chordOf(toCentre, 0.7, w);
                             return (chord.last - chord.first) * w.y;
                           });
  for (const MomentOptions& options : eachTechnique({.replicates = 24, .samples = 64})) {
    EXPECT_AGREES(imageTest(renderMoments(test.scene, test.volumes, options), reference, 0, 2e-5))
        << techniqueOf(options);
  }
  const MomentOptions bad = withBug(byPaths({.replicates = 24, .samples = 64}), interop::kBugVolumePdf);
  EXPECT_DIFFERS(imageTest(renderMoments(test.scene, test.volumes, bad), reference, 0, 2e-5));
}

/// Mean over each pixel's footprint of a function of the floor's point, seen straight from above.
std::vector<double> floorPicture(const PathScene& test, const std::function<double(double, double)>& radiance) {
  const double half = 3.0 * std::tan(0.5 * glm::radians(test.scene.camera.verticalFov));
  const glm::uvec2 size = test.scene.film.size;
  const GaussRule& rule = gaussRule(6);
  std::vector<double> picture(std::size_t(size.x) * size.y, 0.0);
  for (std::size_t i = 0; i < picture.size(); ++i) {
    for (std::size_t a = 0; a < rule.nodes.size(); ++a) {
      for (std::size_t b = 0; b < rule.nodes.size(); ++b) {
        const double x = half * (2.0 * (double(i % size.x) + rule.nodes[a]) / size.x - 1.0);
        const double z = half * (2.0 * (double(i / size.x) + rule.nodes[b]) / size.y - 1.0);
        picture[i] += rule.weights[a] * rule.weights[b] * radiance(x, z);
      }
    }
  }
  return picture;
}

/// The camera's place does not matter: nothing is in the air, and the spot is no obstacle.
TEST(SpotLight, OnAFloorHasTheClosedForm) {
  PathScene test = floorView({0.0, 0.0}, 40.0);
  scene::SpotLight spot;
  spot.position = {0.3, 1.5, -0.2};
  spot.direction = glm::normalize(glm::dvec3(-0.3, -1.0, 0.2));
  spot.intensity = glm::dvec3(4.0);
  spot.outerAngle = 35.0;
  spot.innerAngle = 10.0;
  test.spot(spot);
  const auto radiance = [&](double x, double z) {
    const glm::dvec3 way = glm::dvec3(x, 0.0, z) - spot.position;
    const double distance2 = glm::dot(way, way);
    const double cosine = glm::dot(glm::normalize(way), spot.direction);
    const double outer = std::cos(glm::radians(spot.outerAngle));
    const double inner = std::cos(glm::radians(spot.innerAngle));
    const double s = glm::clamp((cosine - outer) / (inner - outer), 0.0, 1.0);
    return 0.7 / pi * 4.0 * s * s * (3.0 - 2.0 * s) * -way.y / (std::sqrt(distance2) * distance2);
  };
  const auto reference = floorPicture(test, radiance);
  const Moments moments = renderMoments(test.scene, test.volumes, byPaths({.replicates = 16}));
  EXPECT_AGREES(imageTest(moments, meanOf(reference), 0, 1e-4)); // 1e-4: of the footprint's quadrature
  EXPECT_AGREES(pixelTest(moments, reference, 0, 1e-3));         // the same, where the falloff begins
  const Moments bad =
      renderMoments(test.scene, test.volumes, withBug(byPaths({.replicates = 16}), interop::kBugJacobian));
  EXPECT_DIFFERS(imageTest(bad, meanOf(reference), 0, 1e-4));
  spot.outerAngle = 34.5; // planted in the reference
  EXPECT_DIFFERS(imageTest(moments, meanOf(floorPicture(test, radiance)), 0, 1e-4));
}

/// A pane of opacity 0.4 between a lamp and the floor lets 0.6 of its light through, exactly.
TEST(Holes, LetTheirShareOfAShadowRayThrough) {
  for (const double opacity : {0.4, 1.0}) {
    PathScene test = floorView({0.0, 0.0});
    geometry::Material& pane = test.material("pane", MaterialId::Diffuse, 0.0);
    pane.opacity = opacity;
    pane.alpha = geometry::Alpha::Blend;
    test.quad("pane", {0.5, 0.5, 1.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, -2.0}); // not in the camera's way
    test.point({1.5, 1.0, 0.0}, 2.0);
    const double reference = 0.7 / pi * 2.0 * (1.0 - opacity) / std::pow(1.5 * 1.5 + 1.0, 1.5);
    const Moments moments = renderMoments(test.scene, test.volumes, byPaths({.replicates = 16, .samples = 64}));
    if (opacity == 1.0) {
      EXPECT_EQ(moments.image().mean, 0.0);
      continue;
    }
    EXPECT_AGREES(imageTest(moments, reference, 0, 2e-5));
    EXPECT_DIFFERS(imageTest(moments, reference * 0.59 / 0.6, 0, 2e-5)); // planted: an opacity of 0.41
  }
}

} // namespace
} // namespace tyndall::test
