// SPDX-License-Identifier: Apache-2.0
#include "film_fixture.h"

#include <cmath>
#include <functional>

namespace tyndall::film {
namespace {

/// Sum over the samples of one batch of a pixel.
using BatchSum = std::function<double(std::mt19937& generator, std::size_t pixel)>;

/// A synthetic picture: how its batches are drawn and what their means tend to.
struct Noise {
  glm::uvec2 size;
  BatchSum batchSum;
  std::function<double(std::size_t pixel)> truth;
};

double shading(std::size_t pixel) { return 0.2 + double(pixel % 37) / 37.0; }

/// Normal noise of a relative deviation of 1 a sample.
Noise normalNoise(glm::uvec2 size) {
  return {size,
          [](std::mt19937& generator, std::size_t pixel) {
            return std::normal_distribution<double>(16.0 * shading(pixel), 4.0 * shading(pixel))(generator);
          },
          shading};
}

/// Mostly `1`, and once in 100 samples 26: the rare bright samples of a small light.
Noise rareBrightNoise(glm::uvec2 size) {
  return {size,
          [](std::mt19937& generator, std::size_t) {
            return 16.0 + 25.0 * std::binomial_distribution<int>(16, 0.01)(generator);
          },
          [](std::size_t) { return 1.25; }};
}

Film render(const Noise& noise, std::uint32_t batches, std::mt19937& generator) {
  Film film(noise.size, {{0, 0}, noise.size});
  for (std::size_t pixel = 0; pixel < film.pixels().size(); ++pixel) {
    for (std::uint32_t batch = 0; batch < batches; ++batch) {
      BatchSums sums;
      sums.moments = {float(noise.batchSum(generator, pixel)), float(noise.batchSum(generator, pixel)),
                      float(noise.batchSum(generator, pixel)), 0.0f};
      film.add(pixel, batch, kBatchSamples, sums);
    }
  }
  return film;
}

double trueError(const Film& film, const Noise& noise) {
  double error = 0.0;
  double signal = 0.0;
  for (std::size_t pixel = 0; pixel < film.pixels().size(); ++pixel) {
    for (int channel = R; channel <= B; ++channel) {
      const double difference = film.mean(pixel, channel) - noise.truth(pixel);
      error += difference * difference;
      signal += noise.truth(pixel) * noise.truth(pixel);
    }
  }
  return std::sqrt(error / signal);
}

struct Calibration {
  double coverage = 0.0;   ///< share of replicates whose true error is below the bound
  double ratioZ = 0.0;     ///< of the mean of estimate^2 - true^2
  double looseness = 0.0;  ///< mean of bound / true error
};

Calibration calibrate(const Noise& noise, std::uint32_t batches, int replicates,
                      const std::function<ErrorEstimate(const Film&)>& estimate) {
  std::mt19937 generator(17);
  Calibration result;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < replicates; ++i) {
    const Film film = render(noise, batches, generator);
    const ErrorEstimate error = estimate(film);
    const double truth = trueError(film, noise);
    const double difference = error.relative * error.relative - truth * truth;
    sum += difference / replicates;
    squares += difference * difference / replicates;
    result.coverage += (truth <= error.upper ? 1.0 : 0.0) / replicates;
    result.looseness += error.upper / truth / replicates;
  }
  result.ratioZ = sum / std::sqrt((squares - sum * sum) / replicates);
  return result;
}

constexpr double kSigma = 5.0;
// The bound promises 90 %; over 200 replicates a share of 0.9 is below this once in 100 seeds; ours is fixed.
constexpr double kSmallestCoverage = 0.85;
constexpr int kReplicates = 200;

void expectCalibrated(const Calibration& calibration, double loosest) {
  testing::Test::RecordProperty("coverage", std::to_string(calibration.coverage));
  testing::Test::RecordProperty("ratioZ", std::to_string(calibration.ratioZ));
  testing::Test::RecordProperty("looseness", std::to_string(calibration.looseness));
  EXPECT_GT(calibration.coverage, kSmallestCoverage);
  EXPECT_LT(std::abs(calibration.ratioZ), kSigma);
  EXPECT_LT(calibration.looseness, loosest);
}

TEST(ErrorEstimate, CalibratedForNormalNoise) {
  expectCalibrated(calibrate(normalNoise({24, 24}), 8, kReplicates, estimateError), 1.3);
}

TEST(ErrorEstimate, CalibratedForRareBrightSamples) {
  expectCalibrated(calibrate(rareBrightNoise({24, 24}), 4, kReplicates, estimateError), 1.3);
}

TEST(ErrorEstimate, CalibratedOnAFewPixels) {
  expectCalibrated(calibrate(normalNoise({3, 2}), 16, 1000, estimateError), 2.5);
  expectCalibrated(calibrate(normalNoise({1, 1}), 16, 1000, estimateError), 60.0);  // one pixel's own luck
}

TEST(ErrorEstimate, OneHalfForecastsTheWholePicture) {
  const auto fromHalf = [](const Film& film) { return estimateErrorFromHalf(film, 1); };
  expectCalibrated(calibrate(normalNoise({24, 24}), 16, kReplicates, fromHalf), 1.3);
}

TEST(ErrorEstimate, CheckerFindsAnEstimateThatIsTooSmall) {
  const auto tooSmall = [](const Film& film) {
    ErrorEstimate error = estimateError(film);
    error.relative *= 0.9;
    error.upper *= 0.9;
    return error;
  };
  const Calibration calibration = calibrate(normalNoise({24, 24}), 8, kReplicates, tooSmall);
  EXPECT_LT(calibration.coverage, kSmallestCoverage);
  EXPECT_GT(std::abs(calibration.ratioZ), kSigma);
}

TEST(ErrorEstimate, OnlyCoveredPixelsCount) {
  Film film({4, 1}, {{0, 0}, {4, 1}});
  for (std::size_t pixel = 0; pixel < 4; ++pixel) {
    const float transmittance = pixel < 2 ? 16.0f : 8.0f;
    film.add(pixel, 0, 16, {{15.0f, 15.0f, 15.0f, transmittance}, {}});
    film.add(pixel, 1, 16, {{17.0f, 17.0f, 17.0f, transmittance}, {}});
  }
  const ErrorEstimate error = estimateError(film);
  EXPECT_EQ(error.coveredPixels, 2u);
  // Batch means 15/16 and 17/16: variance of the mean 1/256, unbiased squared mean 1 - 1/256.
  EXPECT_NEAR(error.relative, std::sqrt(1.0 / 255.0), 1e-12);
  EXPECT_GT(error.upper, error.relative);
}

TEST(ErrorEstimate, InfiniteUntilEveryCoveredPixelHasTwoBatches) {
  Film film({2, 1}, {{0, 0}, {2, 1}});
  for (std::uint32_t batch = 0; batch < 4; ++batch) {
    film.add(0, batch, 16, {{float(batch + 1), 1.0f, 1.0f, 0.0f}, {}});
  }
  EXPECT_TRUE(std::isinf(estimateError(film).relative));
  film.add(1, 0, 16, {{0.0f, 0.0f, 0.0f, 16.0f}, {}});  // sees nothing: finished after one batch
  EXPECT_TRUE(std::isfinite(estimateError(film).upper));
  EXPECT_TRUE(std::isfinite(estimateErrorFromHalf(film, 1).upper));
}

TEST(ErrorEstimate, EmptyAndNoiselessPicturesHaveNoError) {
  Film film({2, 1}, {{0, 0}, {2, 1}});
  for (std::uint32_t batch = 0; batch < 2; ++batch) {
    film.add(0, batch, 16, {{0.0f, 0.0f, 0.0f, 16.0f}, {}});
    film.add(1, batch, 16, {{8.0f, 8.0f, 8.0f, 0.0f}, {}});
  }
  EXPECT_EQ(estimateError(film).relative, 0.0);
  EXPECT_EQ(estimateError(film).coveredPixels, 1u);
}

TEST(ErrorEstimate, NoiseThatHidesThePictureIsInfinite) {
  Film film({1, 1}, {{0, 0}, {1, 1}});
  for (std::uint32_t batch = 0; batch < 4; ++batch) {
    const float sign = batch % 2 == 0 ? 1.0f : -1.0f;
    film.add(0, batch, 16, {{sign, sign, sign, 0.0f}, {}});
  }
  EXPECT_TRUE(std::isinf(estimateError(film).relative));
}

/// Mean of many pixels that stop by error, as a renderer does: at powers of two, from 64 samples on.
struct StoppedMeans {
  double bias = 0.0;           ///< relative
  double standardError = 0.0;  ///< relative
  double samples = 0.0;        ///< mean over the pixels
};

constexpr double kTarget = 0.1;
constexpr std::uint32_t kFirstCheckpoint = 4;   // batches
constexpr std::uint32_t kLastCheckpoint = 256;

template <class StopHalves>
StoppedMeans stoppedMeans(int replicates, bool independentHalves, StopHalves stopHalves) {
  const Noise noise = rareBrightNoise({1, 1});
  std::mt19937 generator(23);
  double sum = 0.0;
  double squares = 0.0;
  double samples = 0.0;
  for (int i = 0; i < replicates; ++i) {
    Film deciding(noise.size, {{0, 0}, noise.size});
    Film picture(noise.size, {{0, 0}, noise.size});
    picture.independentHalves = independentHalves;
    std::array<bool, 2> stopped{};
    for (std::uint32_t batch = 0; batch < kLastCheckpoint && !(stopped[0] && stopped[1]); ++batch) {
      BatchSums sums;
      sums.moments = {float(noise.batchSum(generator, 0)), 0.0f, 0.0f, 0.0f};
      deciding.add(0, batch, kBatchSamples, sums);
      if (!stopped[batch % 2]) {
        picture.add(0, batch, kBatchSamples, sums);
      }
      const std::uint32_t done = batch + 1;
      if (done >= kFirstCheckpoint && (done & (done - 1)) == 0) {
        stopHalves(deciding, stopped);
      }
    }
    const double mean = picture.mean(0, R) / noise.truth(0);
    sum += mean / replicates;
    squares += mean * mean / replicates;
    samples += double(picture.samples(0)) / replicates;
  }
  const double standardError = std::sqrt((squares - sum * sum) / replicates);
  testing::Test::RecordProperty("bias", std::to_string(sum - 1.0));
  testing::Test::RecordProperty("standardError", std::to_string(standardError));
  testing::Test::RecordProperty("samples", std::to_string(samples));
  return {sum - 1.0, standardError, samples};
}

TEST(StoppingRule, EachHalfDecidingForTheOtherHasNoBias) {
  const StoppedMeans means = stoppedMeans(6000, true, [](const Film& deciding, std::array<bool, 2>& stopped) {
    for (int half = 0; half < 2; ++half) {
      stopped[1 - half] |= estimateErrorFromHalf(deciding, half).relative <= kTarget;
    }
  });
  EXPECT_LT(means.standardError, 0.005);  // so a bias of 2.5 % would be found
  EXPECT_LT(std::abs(means.bias), kSigma * means.standardError);
  EXPECT_LT(means.samples, 0.7 * 16 * kLastCheckpoint);  // it does stop
}

TEST(StoppingRule, DecidingFromThePicturesOwnSamplesIsBiased) {
  const StoppedMeans means = stoppedMeans(6000, false, [](const Film& deciding, std::array<bool, 2>& stopped) {
    stopped[0] = stopped[1] = estimateError(deciding).relative <= kTarget;
  });
  EXPECT_LT(means.bias, -0.07);
}

} // namespace
} // namespace tyndall::film
