// SPDX-License-Identifier: Apache-2.0
// What a picture says about its own error: standard errors against the spread over seeds, stopping by error.
#include "render/film_fixture.h"
#include "support/path_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tyndall::test {
namespace {

/// rRMSE that the march reaches in some 100 samples or fewer.
constexpr double kMarchTarget = 0.04;

TestScene puff() {
  TestScene test({12, 12});
  test.perspective({0.0, 0.0, 4.0}, {0.0, 0.0, 0.0}, 40.0);
  test.grid(constantGrid(9, glm::dvec3(-0.8), glm::dvec3(0.8), 1.0), 1.5, 0.9).phase = henyeyGreenstein(0.5);
  test.sun({0.3, -1.0, -0.5}, 1.0, 2.0);
  test.point({1.3, 0.9, 0.4}, 1.0);
  return test;
}

TestScene fog() {
  TestScene test({12, 12});
  test.perspective({0.0, 0.0, 4.0}, {0.0, 0.0, 0.0}, 40.0);
  test.sphere(glm::dvec3(0.0), 1.0, 1.0, 0.9);
  test.point({0.3, 0.2, 0.4}, 1.0);
  test.constant(0.3);
  return test;
}

/// A floor, a lamp and fog.
TestScene room() {
  PathScene test({8, 8});
  test.perspective({0.0, 0.3, 4.0}, {0.0, 0.0, 0.0}, 40.0);
  test.material("floor", MaterialId::Diffuse, 0.6);
  test.lamp("lamp", 4.0);
  test.quad("floor", {-4.0, -1.0, 4.0}, {8.0, 0.0, 0.0}, {0.0, 0.0, -8.0});
  test.ball("lamp", {0.4, 0.6, 0.0}, 0.3);
  test.sphere(glm::dvec3(0.0), 1.0, 0.7, 0.9);
  test.constant(0.3);
  return test;
}

/// sqrt of the mean reported variance, and of the mean variance over seeds: both over covered pixels and colours.
std::pair<double, double> reportedAndTrue(const TestScene& test, std::uint32_t samples, render::Method method) {
  constexpr int kSeeds = 50;
  std::vector<std::vector<double>> values(std::size_t(test.scene.film.size.x) * test.scene.film.size.y);
  double reported = 0.0;
  FilmRunner runner(test, {.method = method});
  std::string stoppedBy;
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
    const film::Film film = runner.run({.samples = samples, .seconds = {}, .error = {}}, seed, stoppedBy);
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i].push_back(film.mean(i, film::R));
      reported += film.varianceOfMean(i, film::R) / kSeeds;
    }
  }
  double spread = 0.0;
  for (const std::vector<double>& pixel : values) {
    spread += film::summarise(pixel).variance;
  }
  return {std::sqrt(reported), std::sqrt(spread)};
}

TEST(ErrorBars, AgreeWithTheSpreadOfFiftySeeds) {
  for (const TestScene& test : {puff(), fog()}) {
    for (const render::Method method : {render::Method::Tracking, render::Method::March}) {
      const auto [reported, spread] = reportedAndTrue(test, 128, method);
      EXPECT_NEAR(reported / spread, 1.0, 0.1) << render::methodName(method);
    }
  }
  const auto [reported, spread] = reportedAndTrue(room(), 128, render::Method::Path);
  EXPECT_NEAR(reported / spread, 1.0, 0.1) << "path";
}

/// Sums of squares over covered pixels and colours.
double rRmse(const film::Film& film, const Moments& truth) {
  double squares = 0.0;
  double norm = 0.0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    if (1.0 - truth.mean(i, kTransmittance) > 0.01) {
      for (int channel = 0; channel < 3; ++channel) {
        const double difference = film.mean(i, channel) - truth.mean(i, channel);
        squares += difference * difference;
        norm += truth.mean(i, channel) * truth.mean(i, channel);
      }
    }
  }
  return std::sqrt(squares / norm);
}

/// Stopped by error: the true error is below the target in 90 % of runs, and the mean over runs is that of runs of
/// fixed length.
void expectPromiseKept(const TestScene& test, render::Method method, double target, const Moments& truth) {
  SCOPED_TRACE(render::methodName(method));
  FilmRunner runner(test, {.method = method});
  const int runs = 24 * static_cast<int>(effort());
  int kept = 0;
  int byError = 0;
  std::vector<double> means;
  for (int run = 0; run < runs; ++run) {
    std::string stoppedBy;
    const film::Film film =
        runner.run({.samples = 1u << 14, .seconds = {}, .error = target}, static_cast<std::uint32_t>(run), stoppedBy);
    byError += stoppedBy == "error";
    kept += rRmse(film, truth) <= target;
    double mean = 0.0;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
      mean += film.mean(i, film::R) / double(truth.pixels.size());
    }
    means.push_back(mean);
  }
  EXPECT_EQ(byError, runs);
  // 90 % of 24 runs is 21.6; fewer than 16 would be one in 3000.
  EXPECT_GE(kept, static_cast<int>(0.9 * runs - 3.5 * std::sqrt(0.09 * runs)));
  const film::TestResult bias = film::welchTest(film::summarise(means), truth.image(0));
  EXPECT_GT(bias.p, kFamilyRate);
  for (double& mean : means) {
    mean *= 0.97; // planted: what stopping on one's own samples does
  }
  EXPECT_LT(film::welchTest(film::summarise(means), truth.image(0)).p, kFamilyRate);
}

TEST(StoppingByError, KeepsItsPromiseWithoutBias) {
  const TestScene test = puff();
  const Moments truth =
      renderMoments(test.scene, test.volumes, {.replicates = 64, .samples = 256, .firstSeed = 900000});
  expectPromiseKept(test, render::Method::Tracking, 0.25, truth); // some 500 samples
}

/// The second scene has errors that its pixels share: those of the sky's directions.
TEST(StoppingByError, KeepsItsPromiseInTheMarch) {
  TestScene sky = puff();
  sky.scene.lights.clear();
  sky.constant(0.3, false);
  for (const TestScene& test : {puff(), sky}) {
    MomentOptions options{.replicates = 16, .samples = 256, .firstSeed = 900000};
    options.estimator.method = render::Method::March;
    const Moments truth = renderMoments(test.scene, test.volumes, options);
    expectPromiseKept(test, render::Method::March, kMarchTarget, truth);
  }
}

} // namespace
} // namespace tyndall::test
