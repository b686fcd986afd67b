// SPDX-License-Identifier: Apache-2.0
// Second moments of samples, for denoisers: RenderReport::sampleSquares.
#include "math/colour.h"
#include "render/film_fixture.h"
#include "support/path_scenes.h"

#include <gtest/gtest.h>

namespace tyndall::test {
namespace {

constexpr std::uint32_t kSamples = 20; ///< a batch and a part of one
constexpr std::uint32_t kSeed = 7;

PathScene lampOverFloor() {
  PathScene test({12, 8});
  test.depth(2);
  test.perspective({0.0, 1.5, 2.0}, {0.0, 0.0, 0.0}, 30.0);
  test.material("white", MaterialId::Diffuse, 0.7);
  test.lamp("lamp", 5.0);
  test.constant(0.2);
  test.quad("white", {-1.0, 0.0, 1.0}, {2.0, 0.0, 0.0}, {0.0, 0.0, -2.0});
  test.ball("lamp", {0.3, 0.6, 0.0}, 0.2);
  return test;
}

/// Sums over samples that the estimator takes one by one. Row by row.
std::vector<double> squaresOf(const PathScene& test, const render::EstimatorOptions& options) {
  const gpu_scene::GpuScene scene(probeDevice(), test.scene, test.volumes, render::layoutOf(options.method));
  const auto estimator = render::makeEstimator(probeDevice(), scene, test.volumes, options);
  const glm::uvec2 size = test.scene.film.size;
  const std::vector<std::uint32_t> pixels = render::dispatchOrder({glm::uvec2(0), size});
  std::vector<double> squares(pixels.size(), 0.0);
  for (std::uint32_t sample = 0; sample < kSamples; ++sample) {
    const auto sums = estimator->run(pixels, {sample, 1}, kSeed);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const interop::PixelSums& sum = sums[i];
      const double value =
          luminance({sum.moments[0] + sum.extras[0], sum.moments[1] + sum.extras[1], sum.moments[2] + sum.extras[2]});
      squares[(pixels[i] & 0xffffu) + std::size_t(size.x) * (pixels[i] >> 16)] += value * value;
    }
  }
  return squares;
}

/// Bit for bit those of single samples, the background in them; the picture is the one without them, but for the
/// rounding of sums that are taken on the host. Squares of a batch's mean would be smaller in every pixel with noise.
TEST(SampleSquares, AreThoseOfSingleSamplesAndChangeNoPicture) {
  const PathScene test = lampOverFloor();
  render::RenderOptions options;
  options.estimator.method = render::Method::Path;
  options.stop.samples = kSamples;
  options.seed = kSeed;
  const film::Film plain = renderFilm(test, options);
  options.moments = true;
  render::RenderReport report;
  const film::Film film = renderFilm(test, options, &report);
  const std::vector<double> expected = squaresOf(test, options.estimator);
  ASSERT_EQ(report.sampleSquares.size(), expected.size());
  std::size_t noisy = 0;
  for (std::size_t pixel = 0; pixel < expected.size(); ++pixel) {
    EXPECT_EQ(report.sampleSquares[pixel], expected[pixel]) << pixel;
    EXPECT_NEAR(film.mean(pixel, film::G), plain.mean(pixel, film::G), 1e-5 * plain.mean(pixel, film::G));
    const double mean = luminance({film.mean(pixel, film::R), film.mean(pixel, film::G), film.mean(pixel, film::B)});
    noisy += expected[pixel] / kSamples > 1.01 * mean * mean ? 1 : 0;
  }
  EXPECT_GT(noisy, expected.size() / 4) << "no noise, so that nothing was tested";
}

} // namespace
} // namespace tyndall::test
