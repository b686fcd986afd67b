// SPDX-License-Identifier: Apache-2.0
// The mean radiance of marches along given rays against quadrature in double on the same rays: without pixel jitter one
// standard error is below 0.006 %, in the long version below 0.0015 %. TYNDALL_TEST_VOLUMES: see cases().
#include "film/film.h"
#include "film/statistics.h"
#include "render/march_probe.h"
#include "support/probe.h"
#include "support/ray_reference.h"
#include "support/ray_sets.h"
#include "support/render_fixture.h"
#include "support/statistics.h"
#include "volume/depth.h"
#include "volume/load.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>

namespace tyndall::test {
namespace {

using volume::BrickGrid;

constexpr std::size_t kRays = 4096; ///< from around the grid; a quarter as many from inside
constexpr double kResolution =
    6e-5; ///< largest standard error of the mean over the rays, relative; times 1 / sqrt(effort())
constexpr double kFloats = 4e-6; ///< relative error that float arithmetic is granted

struct BiasCase {
  std::string name;
  TestScene test;
  std::uint32_t batches = 0; ///< of 16 samples per ray that reach the resolution
};

/// Rays that cross the first grid, from around it and from inside.
std::vector<OracleRay> raysAt(const TestScene& test) {
  const BrickGrid& grid = test.volumes.grids.front();
  const glm::dmat4 map = test.scene.media.front().worldFromMedium * grid.worldFromIndex;
  std::vector<OracleRay> world;
  for (const auto& [kind, count] : {std::pair(RayKind::Random, kRays), std::pair(RayKind::FromInside, kRays / 4)}) {
    for (const OracleRay& ray : rays(kind, count, 5, grid.indexBounds()).exact) {
      world.push_back(through(map, ray));
    }
  }
  return world;
}

/// The mean over rays of what batches of samples find.
struct RayMean {
  double reference = 0.0;
  double bias = 0.0;          ///< relative
  double standardError = 0.0; ///< relative; from the scatter of each ray's batches
  std::uint64_t cut = 0;

  /// In standard errors, float arithmetic's share taken off.
  double z() const { return std::max(std::abs(bias) - kFloats, 0.0) / standardError; }
  bool agrees() const { return film::normalTwoSidedP(z()) >= kFamilyRate; }
  std::string text() const {
    return fmt::format("bias {:+.5f} %, standard error {:.5f} %, z {:.2f}", 100.0 * bias, 100.0 * standardError, z());
  }
};

/// Per ray: mean over batches of the radiance of a sample, and the variance of that mean.
class RayMoments {
public:
  explicit RayMoments(std::size_t rays) : sums_(rays), squares_(rays) {}

  void add(const std::vector<interop::MarchProbeResult>& batch) {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const double value = double(batch[i].scattered) / film::kBatchSamples;
      sums_[i] += value;
      squares_[i] += value * value;
      cut_ += batch[i].cut;
    }
    ++batches_;
  }

  RayMean against(const std::vector<double>& reference) const {
    double sum = 0.0;
    double variance = 0.0;
    RayMean mean;
    for (std::size_t i = 0; i < reference.size(); ++i) {
      mean.reference += reference[i];
      sum += sums_[i] / batches_;
      variance += std::max(squares_[i] - sums_[i] * sums_[i] / batches_, 0.0) / (batches_ * (batches_ - 1.0));
    }
    mean.bias = sum / mean.reference - 1.0;
    mean.standardError = std::sqrt(variance) / mean.reference;
    mean.cut = cut_;
    return mean;
  }

private:
  std::vector<double> sums_;
  std::vector<double> squares_;
  double batches_ = 0.0;
  std::uint64_t cut_ = 0;
};

RayMoments marched(const MarchProbe& probe, const MarchRays& rays, std::uint32_t batches) {
  RayMoments moments(rays.device.size());
  for (std::uint32_t b = 0; b < batches; ++b) {
    moments.add(probe.march(rays, {b * film::kBatchSamples, film::kBatchSamples, 3}));
  }
  return moments;
}

RayMean measured(const BiasCase& scene, std::uint32_t batches) {
  const MarchProbe probe(scene.test);
  const MarchRays rays = probe.rays(raysAt(scene.test));
  return marched(probe, rays, batches).against(singleScattering(scene.test.scene, scene.test.volumes, rays.exact));
}

/// A cloud with holes and a soft rim.
BrickGrid cloud(const glm::dmat4& worldFromIndex, double phase) {
  const glm::ivec3 size(42, 30, 37);
  return gridOf(size, glm::ivec3(-9, 4, -20), worldFromIndex, [&](const glm::ivec3& index) {
    const glm::dvec3 p = (glm::dvec3(index - glm::ivec3(-9, 4, -20)) + 0.5) / glm::dvec3(size) * 2.0 - 1.0;
    const double waves = std::sin(9.0 * p.x + phase) * std::sin(7.0 * p.y - phase) + std::sin(8.0 * p.z + 5.0 * p.x);
    return std::max(0.0, 1.0 - glm::dot(p, p) + 0.4 * waves);
  });
}

/// Adds a grid whose median optical depth is `depth`.
scene::Medium& addCloud(TestScene& test, const BrickGrid& grid, double depth) {
  scene::Medium& medium = test.grid(grid, depth / volume::medianOpticalDepth(grid, 400), 0.9);
  medium.phase = henyeyGreenstein(0.3);
  return medium;
}

BiasCase underASun(const std::string& name, const BrickGrid& grid, double depth, std::uint32_t batches) {
  BiasCase scene{name + " under a sun", TestScene(), batches};
  addCloud(scene.test, grid, depth);
  scene.test.sun({0.4, -1.0, -0.3}, 2.0);
  return scene;
}

BiasCase inFog(const std::string& name, const BrickGrid& grid, double depth, std::uint32_t batches) {
  BiasCase scene{name + " in fog beside a point light", TestScene(), batches};
  addCloud(scene.test, grid, depth);
  const Bounds3 bounds = grid.worldBounds();
  scene.test.point(bounds.centre() + glm::dvec3(0.8, 0.55, 0.2) * bounds.size(), 50.0);
  scene.test.box({}, {}, 0.3 / glm::length(bounds.size()), 0.9).shape = scene::MediumShape::Unbounded;
  return scene;
}

/// The second one is turned and moved into the first.
BiasCase overlapping(const std::string& name, const BrickGrid& first, const BrickGrid& second) {
  BiasCase scene{name + " overlapping", TestScene(), 6};
  addCloud(scene.test, first, 2.0);
  scene::Medium& medium = addCloud(scene.test, second, 1.0);
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 0.9, glm::normalize(glm::dvec3(-1.0, 0.4, 2.0)));
  const glm::dvec3 size = second.worldBounds().size();
  const double scale = glm::length(first.worldBounds().size()) / glm::length(size);
  const glm::dvec3 to = first.worldBounds().centre() + 0.15 * first.worldBounds().size();
  medium.worldFromMedium = glm::translate(glm::dmat4(1.0), to) * turn * glm::scale(glm::dmat4(1.0), glm::dvec3(scale)) *
                           glm::translate(glm::dmat4(1.0), -second.worldBounds().centre());
  medium.densityScale /= scale;
  scene.test.sun({-0.3, -1.0, 0.5}, 2.0);
  return scene;
}

std::vector<BiasCase> generatedCases() {
  const BrickGrid plain = cloud(affineMaps()[2].worldFromIndex, 0.3);
  return {underASun("thin cloud", plain, 0.1, 2), underASun("normal cloud", plain, 3.0, 4),
          underASun("dense cloud", plain, 10.0, 20), inFog("normal cloud", plain, 3.0, 2),
          overlapping("two clouds", plain, cloud(affineMaps().back().worldFromIndex, 2.1))};
}

BrickGrid realVolume(const std::filesystem::path& folder, const char* name) {
  return volume::loadGrid(folder / name, {});
}

/// Real clouds where the environment's TYNDALL_TEST_VOLUMES names a folder that has them, else generated ones.
std::vector<BiasCase> cases() {
  const char* folder = std::getenv("TYNDALL_TEST_VOLUMES");
  if (folder == nullptr || !std::filesystem::exists(std::filesystem::path(folder) / "wdas_cloud_sixteenth.vdb")) {
    return generatedCases();
  }
  const BrickGrid wdas = realVolume(folder, "wdas_cloud_sixteenth.vdb");
  const BrickGrid smoke = realVolume(folder, "smoke1_v222_half.vdb");
  const BrickGrid dragon = realVolume(folder, "dragon_with_xform.vdb");
  return {underASun("wdas_cloud", wdas, 4.0, 16), underASun("smoke1", smoke, 0.3, 4),
          underASun("dragon", dragon, 8.0, 24), inFog("wdas_cloud", wdas, 4.0, 8),
          overlapping("smoke1 and dragon", smoke, dragon)};
}

TEST(MarchBias, IsNotToBeSeen) {
  for (const BiasCase& scene : cases()) {
    const RayMean found = measured(scene, scene.batches * effort());
    EXPECT_TRUE(found.agrees()) << scene.name << ": " << found.text();
    EXPECT_EQ(found.cut, 0u) << scene.name;
    EXPECT_LE(found.standardError, kResolution / std::sqrt(effort())) << scene.name << ": the test has become blind";
    std::cout << "  " << scene.name << ": " << found.text() << std::endl;
  }
}

TEST(MarchBias, PlantedBugsAreSeen) {
  const BiasCase scene = generatedCases()[1];
  const MarchRays rays = MarchProbe(scene.test).rays(raysAt(scene.test));
  const std::vector<double> reference = singleScattering(scene.test.scene, scene.test.volumes, rays.exact);
  for (const std::uint32_t bug : {interop::kBugNoCorrection, interop::kBugOtherCache, interop::kBugHalfVoxel,
                                  interop::kBugPhaseSign, interop::kBugNoInverse4Pi}) {
    const RayMean found = marched(MarchProbe(scene.test, bug), rays, 2).against(reference);
    EXPECT_FALSE(found.agrees()) << "bug " << bug << ": " << found.text();
  }
}

TEST(MarchBias, AHundredthOfAPercentIsSeen) {
  const BiasCase scene = generatedCases().front();
  BiasCase brighter = scene;
  brighter.test.scene.media.front().albedo *= 1.0001;
  const MarchProbe probe(brighter.test);
  const MarchRays rays = probe.rays(raysAt(scene.test));
  const RayMoments moments = marched(probe, rays, 2);
  EXPECT_FALSE(moments.against(singleScattering(scene.test.scene, scene.test.volumes, rays.exact)).agrees());
  EXPECT_TRUE(moments.against(singleScattering(brighter.test.scene, brighter.test.volumes, rays.exact)).agrees());
}

/// The covariance over rays of how far two batches are off the reference, in its standard errors.
double covariance(const std::vector<double>& reference, const std::vector<interop::MarchProbeResult>& a,
                  const std::vector<interop::MarchProbeResult>& b) {
  // Relative, so that the brightest rays do not decide alone; without the faintest, whose errors have heavy tails.
  const double least = 0.1 * *std::max_element(reference.begin(), reference.end());
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    if (reference[i] > least) {
      const double x = double(a[i].scattered) / film::kBatchSamples / reference[i] - 1.0;
      const double y = double(b[i].scattered) / film::kBatchSamples / reference[i] - 1.0;
      sum += x * y;
      squares += x * y * x * y;
    }
  }
  return sum / std::sqrt(squares);
}

TEST(MarchSamples, OfOtherBatchesAndSeedsAreIndependent) {
  const BiasCase scene = generatedCases()[1];
  const MarchProbe probe(scene.test);
  const MarchRays rays = probe.rays(raysAt(scene.test));
  const std::vector<double> reference = singleScattering(scene.test.scene, scene.test.volumes, rays.exact);
  const auto batch = [&](std::uint32_t index, std::uint32_t seed) {
    return probe.march(rays, {index * film::kBatchSamples, film::kBatchSamples, seed});
  };
  const auto first = batch(0, 1);
  EXPECT_LT(std::abs(covariance(reference, first, batch(1, 1))), kMaxZ) << "the next batch";
  EXPECT_LT(std::abs(covariance(reference, first, batch(0, 2))), kMaxZ) << "the next seed";
  EXPECT_LT(std::abs(covariance(reference, first, batch(16, 1))), kMaxZ) << "the sixteenth batch";
  EXPECT_LT(std::abs(covariance(reference, first, batch(0, 1u << 31))), kMaxZ) << "a high bit of the seed";
  EXPECT_GT(covariance(reference, first, batch(0, 1)), kMaxZ); // planted: the same batch
}

/// Sums of one sample each, added up in order as the kernel does.
std::vector<float> oneByOne(render::Estimator& marcher, std::span<const std::uint32_t> pixels, std::uint32_t first) {
  std::vector<float> sums(4 * pixels.size(), 0.0f);
  for (std::uint32_t s = 0; s < film::kBatchSamples; ++s) {
    const std::span<const interop::PixelSums> found = marcher.run(pixels, {first + s, 1}, 9);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      sums[i] += found[i / 4].moments[int(i % 4)];
    }
  }
  return sums;
}

TEST(MarchSamples, SumsDoNotDependOnTheDispatch) {
  BiasCase scene = generatedCases().back();
  const Bounds3 bounds = scene.test.volumes.grids.front().worldBounds();
  scene.test.perspective(bounds.centre() + glm::dvec3(0.2, 0.4, 1.6) * bounds.size(), bounds.centre(), 0.6);
  const render::EstimatorOptions options{.method = render::Method::March};
  const gpu_scene::GpuScene onDevice(probeDevice(), scene.test.scene, scene.test.volumes, gpu_scene::GridLayout::Cells);
  const auto marcher = render::makeEstimator(probeDevice(), onDevice, scene.test.volumes, options);
  std::vector<std::uint32_t> pixels;
  for (std::uint32_t i = 0; i < 256; ++i) {
    pixels.push_back((i % 16) | ((i / 16) << 16));
  }
  const std::span<const interop::PixelSums> found = marcher->run(pixels, {32, film::kBatchSamples}, 9);
  std::vector<float> together;
  for (const interop::PixelSums& sums : found) {
    for (int c = 0; c < 4; ++c) {
      together.push_back(sums.moments[c]);
    }
  }
  EXPECT_EQ(together, oneByOne(*marcher, pixels, 32));
  EXPECT_NE(together, oneByOne(*marcher, pixels, 48)); // planted: another batch
  EXPECT_GT(*std::max_element(together.begin(), together.end()), 0.0f);
}

} // namespace
} // namespace tyndall::test
