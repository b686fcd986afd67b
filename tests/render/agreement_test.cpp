// SPDX-License-Identifier: Apache-2.0
// The march against tracking, which shares neither distances, nor lights, nor shadows with it: the same expectation in
// scenes of every kind. The preview's bias.
#include "film/exr.h"
#include "support/render_fixture.h"
#include "support/render_scenes.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

namespace tyndall::test {
namespace {

/// A scene, and a planted bug that must be seen in it (kBugNone: none is planted).
struct Case {
  const char* name;
  TestScene (*scene)();
  std::uint32_t bug = interop::kBugNone;
  std::uint32_t samples = 64; ///< of a replicate of tracking; dense media cost it a thousand times as much
  bool fast = true;           ///< false: in the long version alone, others having each of its parts
};

TestScene view() {
  TestScene test({16, 16});
  test.perspective({1.0, 0.5, 4.0}, {0.0, 0.0, 0.0}, 26.0);
  return test;
}

TestScene puff(double density = 1.0, double g = 0.3) {
  TestScene test = view();
  test.grid(puffGrid(), density, 0.9).phase = henyeyGreenstein(g);
  return test;
}

TestScene sunlit(double density, double diameter = 0.0, double g = 0.3) {
  TestScene test = puff(density, g);
  test.sun({0.4, -1.0, -0.3}, 1.0, diameter);
  return test;
}

TestScene lamplit(const glm::dvec3& position) {
  TestScene test = puff();
  test.point(position, 2.0);
  return test;
}

/// Looks at one half of the puff, so that no ray comes near the light in the other: there, tracking's variance is
/// without bounds.
TestScene lampInAVoxel() {
  TestScene test = lamplit({-0.41, 0.13, 0.07});
  test.perspective({0.5, 0.0, 4.0}, {0.5, 0.0, 0.0}, 10.0);
  return test;
}

TestScene twelveLamps() {
  TestScene test = puff();
  for (int i = 0; i < 12; ++i) {
    test.point({1.6 * std::cos(0.5 * i), 1.3 * std::sin(1.1 * i), 1.6 * std::sin(0.5 * i)}, 0.2 + 0.1 * (i * 7 % 12));
  }
  return test;
}

TestScene underAnEnvironment(const scene::Light& light, double g = 0.6) {
  TestScene test = puff(1.0, g);
  test.scene.lights.push_back({"environment", light, true});
  return test;
}

/// A lat-long map of three unequal patches on a dim ground, removed when the program ends.
struct MapFile {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / fmt::format("tyndall-agreement-{}.exr", ::getpid());

  MapFile() {
    constexpr glm::uvec2 kSize{64, 32};
    film::Image image;
    image.displaySize = kSize;
    image.window = {glm::uvec2(0), kSize};
    for (std::uint32_t channel = 0; channel < 3; ++channel) {
      std::vector<float> texels(std::size_t(kSize.x) * kSize.y, 0.1f);
      for (std::uint32_t i = 0; i < 12; ++i) {
        texels[(5 + i % 4) * kSize.x + 11 + i / 4] = 20.0f;
        texels[(20 + i % 3) * kSize.x + 40 + 3 * channel + i / 3] = 4.0f;
      }
      image.channels[channel == 0 ? "R" : channel == 1 ? "G" : "B"] = texels;
    }
    film::writeExr(path, image);
  }
  ~MapFile() { std::filesystem::remove(path); }
};

TestScene underAMap() {
  static const MapFile file;
  return underAnEnvironment(scene::MapEnvironment{file.path.string(), 1.0, 30.0});
}

TestScene underTheSky() {
  scene::SkyEnvironment sky;
  sky.sunDirection = glm::normalize(glm::dvec3(0.6, -0.5, -0.3));
  sky.scale = 5.0;
  return underAnEnvironment(sky);
}

TestScene fogAroundAGrid() {
  TestScene test = sunlit(2.0);
  test.sphere({0.0, 0.2, 0.0}, 2.5, 0.15, 0.8).phase = henyeyGreenstein(0.6);
  test.point({2.0, 1.8, 0.5}, 2.0);
  return test;
}

TestScene boxAndSphereAcrossAGrid() {
  TestScene test = sunlit(1.0, 3.0);
  test.box({-1.4, -0.6, -0.7}, {0.3, 0.4, 0.8}, 0.6, 0.5).phase = henyeyGreenstein(-0.4);
  test.sphere({0.4, 0.3, 0.2}, 0.7, 0.9, 0.9);
  return test;
}

/// Lattices that neither share planes nor directions; one of them mirrored and sheared.
TestScene twoGridsAcross() {
  TestScene test = sunlit(1.0);
  scene::Medium& other = test.grid(puffGrid({3, -9, 5}, volume::Storage::Half), 1.5, 0.6);
  other.phase = henyeyGreenstein(-0.5);
  other.worldFromMedium = glm::translate(glm::dmat4(1.0), {0.4, 0.3, -0.2}) *
                          glm::dmat4(glm::dmat3(0.3) * glm::dmat3(affineMaps().back().worldFromIndex));
  test.point({-1.5, 1.0, 1.5}, 2.0);
  return test;
}

TestScene hotGrid() {
  TestScene test = sunlit(1.0);
  scene::Emission emission;
  emission.kind = scene::Emission::Kind::Blackbody;
  emission.scale = 1e-5;
  emission.temperatureScale = 1500.0;
  emission.temperatureAuto = false;
  emission.tiedToAbsorption = true;
  const volume::BrickGrid shape = constantGrid(9, glm::dvec3(-0.8), glm::dvec3(1.1), 1.0);
  test.emissionGrid(gridOf(glm::ivec3(9), glm::ivec3(0), shape.worldFromIndex,
                           [](const glm::ivec3& i) { return 0.6 + 0.07 * i.y + 0.04 * i.x; }),
                    emission);
  return test;
}

TestScene orthographic() {
  TestScene test = sunlit(1.0, 0.5);
  test.orthographic({2.0, 3.0, 4.0}, {0.0, 0.0, 0.0}, 1.8);
  return test;
}

TestScene cameraInside() {
  TestScene test = sunlit(3.0);
  test.perspective({0.2, 0.1, 0.3}, {0.0, 0.0, -1.0}, 70.0);
  return test;
}

TestScene cameraFarAway() {
  TestScene test = sunlit(1.0);
  test.perspective({2e3, 4e3, 9e3}, {0.0, 0.0, 0.0}, 0.011);
  return test;
}

TestScene farFromTheOrigin() {
  TestScene test = sunlit(1.0);
  const glm::dvec3 far(1e5, -1e5, 1e5);
  test.scene.media[0].worldFromMedium = glm::translate(glm::dmat4(1.0), far);
  test.scene.camera.position += far;
  test.scene.camera.target += far;
  return test;
}

TestScene stored(volume::Storage storage) {
  TestScene test = sunlit(1.0);
  test.volumes.grids[0] = puffGrid({-1, -9, 1000}, storage);
  return test;
}

const Case kCases[] = {
    {"Sun", [] { return sunlit(1.0); }, interop::kBugOtherCache},
    {.name = "WideSunDisc", .scene = [] { return sunlit(1.0, 10.0); }, .fast = false},
    {"PeakedPhaseFunction", [] { return sunlit(1.0, 10.0, 0.9); }, interop::kBugPhaseSign},
    {"ConstantEnvironment", [] { return underAnEnvironment(scene::ConstantEnvironment{glm::dvec3(0.3)}, 0.8); },
     interop::kBugNoInverse4Pi},
    {"Sky", underTheSky},
    {"EnvironmentMap", underAMap, interop::kBugNoInverse4Pi},
    {"LampOutside",
     [] {
       return lamplit({1.5, 1.0, 0.5});
     },
     interop::kBugJacobian},
    {.name = "LampNear",
     .scene =
         [] {
           return lamplit({0.1, 1.02, 0.1});
         },
     .bug = interop::kBugJacobian,
     .fast = false},
    {"LampInAVoxel", lampInAVoxel, interop::kBugNoCorrection},
    {"TwelveLamps", twelveLamps, interop::kBugJacobian},
    {.name = "FogAroundAGrid", .scene = fogAroundAGrid, .fast = false},
    {"BoxAndSphereAcrossAGrid", boxAndSphereAcrossAGrid},
    {"TwoGridsAcross", twoGridsAcross, interop::kBugPhaseSign},
    {"HotGrid", hotGrid},
    {.name = "Orthographic", .scene = orthographic, .fast = false},
    {"CameraInside", cameraInside},
    {.name = "CameraFarAway", .scene = cameraFarAway, .fast = false},
    {"FarFromTheOrigin", farFromTheOrigin},
    {"Thin", [] { return sunlit(0.01); }, interop::kBugNoInverse4Pi},
    {"Thick", [] { return sunlit(5.0); }, interop::kBugNoCorrection},
    {"Opaque", [] { return sunlit(500.0); }, interop::kBugNoCorrection, 4},
    {.name = "EightBits", .scene = [] { return stored(volume::Storage::Unorm8); }, .fast = false},
    {.name = "HalfFloats", .scene = [] { return stored(volume::Storage::Half); }, .fast = false},
};

class Agreement : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(, Agreement, testing::ValuesIn(kCases),
                         [](const auto& one) { return std::string(one.param.name); });

TEST_P(Agreement, OfTheMarchWithTracking) {
  if (!GetParam().fast && effort() == 1) {
    GTEST_SKIP() << "long version only";
  }
  const TestScene test = GetParam().scene();
  const Moments tracking = renderMoments(test.scene, test.volumes, {.replicates = 32, .samples = GetParam().samples});
  MomentOptions options{.replicates = 16, .firstSeed = 100001};
  options.estimator.method = render::Method::March;
  EXPECT_AGREES(tileTest(renderMoments(test.scene, test.volumes, options), tracking));
  if (GetParam().bug != interop::kBugNone) {
    EXPECT_DIFFERS(tileTest(renderMoments(test.scene, test.volumes, withBug(options, GetParam().bug)), tracking));
  }
}

/// Root of the summed squares of the preview's error, relative to the picture's; what chance adds is taken off.
double previewBias(const TestScene& test) {
  MomentOptions options{.replicates = 24};
  options.estimator.method = render::Method::March;
  const Moments exact = renderMoments(test.scene, test.volumes, options);
  options.firstSeed = 100001;
  options.estimator.preview = true;
  const Moments preview = renderMoments(test.scene, test.volumes, options);
  double squares = 0.0;
  double norm = 0.0;
  for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
    const film::SampleSummary& a = exact.pixels[i][0];
    const film::SampleSummary& b = preview.pixels[i][0];
    squares += (a.mean - b.mean) * (a.mean - b.mean) - a.variance / a.count - b.variance / b.count;
    norm += a.mean * a.mean;
  }
  return std::sqrt(std::max(squares, 0.0) / norm);
}

/// Grows with density: measured in a prototype as 0.05, 0.4 and 3 % where a cloud of 128 voxels is thin, normal, dense.
TEST(Preview, IsBiasedAsMuchAsItsCachesAre) {
  const volume::BrickGrid grid = volume::loadGrid("volumes/cloud.vdb", {});
  const Bounds3 bounds = grid.worldBounds();
  const double size = glm::length(bounds.size());
  TestScene test({16, 16});
  test.perspective(bounds.centre() + size * glm::dvec3(0.3, 0.2, 1.2), bounds.centre(), 45.0);
  test.sun({0.4, -1.0, -0.6}, 2.0);
  test.grid(grid, 1.0, 0.9).phase = henyeyGreenstein(0.3);
  const auto biasAt = [&](double density) {
    test.scene.media[0].densityScale = density / size;
    return previewBias(test);
  };
  const double normal = biasAt(20.0);
  const double dense = biasAt(200.0);
  EXPECT_GT(normal, 2e-4);
  EXPECT_LT(normal, 0.01);
  EXPECT_GT(dense, 2.0 * normal);
  EXPECT_LT(dense, 0.1);
}

} // namespace
} // namespace tyndall::test
