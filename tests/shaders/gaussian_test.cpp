// SPDX-License-Identifier: Apache-2.0
// Properties of the truncated normal distribution of core/gaussian.glsl, and of the means and variances of distance
// chains, against their formulas in double.
#include "support/probe.h"
#include "support/statistics.h"

// Needs <cstdint> before it.
#include "kernels/gaussian_probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace tyndall::test {
namespace {

constexpr std::uint32_t kSampleCount = 1u << 18;
constexpr std::uint32_t kBins = 64;

enum Mode : std::uint32_t { Samples, Values, ErrorFunction, Chain };
enum Planted : std::uint32_t { None, NotTruncated, MeanOfSquares, SecondSide };

/// In single precision, as the device has it.
struct Shape {
  float mean, sigma, first, last;
};

/// A mean in the middle, at an end, far wider and far narrower than the interval, and a ray without an end.
const std::vector<Shape> kShapes{{2.0f, 0.5f, 1.0f, 4.0f},
                                 {1.0f, 1.0f, 1.0f, 5.0f},
                                 {2.0f, 1e4f, 1.0f, 4.0f},
                                 {3.0f, 1e-3f, 0.0f, 40.0f},
                                 {10.0f, 20.0f, 0.0f, 1e30f}};

std::vector<glm::vec2> runGaussian(const Shape& shape, Mode mode, Planted planted, std::vector<glm::vec2> inputs = {}) {
  struct Push {
    glm::vec4 shape;
    std::uint32_t count;
    interop::Ptr<glm::vec2> inputs;
    interop::Ptr<glm::vec2> outputs;
  };
  const ProbeRunner probe(k_gaussian_probe_spirv, {{0, mode}, {1, planted}});
  const std::uint32_t count = mode == Samples ? kSampleCount : static_cast<std::uint32_t>(inputs.size());
  inputs.resize(std::max<std::size_t>(inputs.size(), 1));
  const auto in = ProbeRunner::upload(inputs);
  const auto out = ProbeRunner::results<glm::vec2>(count);
  probe.run(Push{glm::vec4(shape.mean, shape.sigma, shape.first, shape.last), count, in.ptr(), out.ptr()}, count);
  return ProbeRunner::download(out);
}

/// Of the whole normal distribution, by the complement where that has more digits.
double mass(const Shape& shape, double low, double high) {
  const double scale = 1.0 / (std::numbers::sqrt2 * double(shape.sigma));
  return 0.5 * (std::erf((high - double(shape.mean)) * scale) - std::erf((low - double(shape.mean)) * scale));
}

/// What can be drawn at all.
double endOf(const Shape& shape) {
  return std::min(double(shape.last), double(shape.mean) + 9.0 * double(shape.sigma));
}
double beginOf(const Shape& shape) {
  return std::max(double(shape.first), double(shape.mean) - 9.0 * double(shape.sigma));
}

struct SampleVerdict {
  double pValue;        ///< chi-squared against the truncated distribution
  double worstPdfError; ///< relative
};

SampleVerdict judgeSamples(const Shape& shape, Planted planted) {
  const double begin = beginOf(shape);
  const double end = endOf(shape);
  const double whole = mass(shape, double(shape.first), double(shape.last));
  std::vector<std::uint64_t> counts(kBins);
  std::vector<double> probabilities;
  for (std::uint32_t i = 0; i < kBins; ++i) {
    const double width = (end - begin) / kBins;
    probabilities.push_back(mass(shape, begin + i * width, begin + (i + 1) * width) / whole);
  }
  SampleVerdict verdict{};
  for (const glm::vec2& sample : runGaussian(shape, Samples, planted)) {
    const double t = double(sample.x);
    const double deviations = (t - double(shape.mean)) / double(shape.sigma);
    const double expected =
        std::exp(-0.5 * deviations * deviations) / (std::sqrt(2.0 * std::numbers::pi) * double(shape.sigma) * whole);
    const double error = std::abs(double(sample.y) / expected - 1.0);
    verdict.worstPdfError = std::max(verdict.worstPdfError, std::isfinite(error) ? error : 1.0);
    const double bin = std::clamp((t - begin) / (end - begin) * kBins, 0.0, kBins - 1.0);
    ++counts[static_cast<std::size_t>(bin)];
  }
  verdict.pValue = chiSquaredPValue(counts, probabilities);
  return verdict;
}

/// Midpoints; the shape without an end is cut off where its density is none.
double integral(const Shape& shape, Planted planted) {
  constexpr int kSteps = 1 << 14;
  const double width = (endOf(shape) - beginOf(shape)) / kSteps;
  std::vector<glm::vec2> places;
  for (int i = 0; i < kSteps; ++i) {
    places.emplace_back(static_cast<float>(beginOf(shape) + (i + 0.5) * width), 0.0f);
  }
  double sum = 0.0;
  for (const glm::vec2& value : runGaussian(shape, Values, planted, places)) {
    sum += width * double(value.y);
  }
  return sum;
}

constexpr double kIntegralTolerance = 2e-5; // rounding of places where the density is steep
constexpr double kPdfTolerance = 3e-5;      // exp magnifies the exponent's rounding some deviations away

TEST(TruncatedGaussian, IntegratesToOne) {
  for (const Shape& shape : kShapes) {
    EXPECT_NEAR(integral(shape, None), 1.0, kIntegralTolerance) << shape.mean << " " << shape.sigma;
  }
}

TEST(TruncatedGaussian, SamplesFollowThePdf) {
  for (const Shape& shape : kShapes) {
    const SampleVerdict verdict = judgeSamples(shape, None);
    EXPECT_GT(verdict.pValue, kMinPValue) << shape.mean << " " << shape.sigma;
    EXPECT_LT(verdict.worstPdfError, kPdfTolerance) << shape.mean << " " << shape.sigma;
  }
}

TEST(TruncatedGaussian, ErrorFunctionAndItsInverseAreAccurate) {
  std::vector<glm::vec2> inputs;
  for (double x = 1e-6; x < 4.0; x *= 1.05) {
    inputs.emplace_back(static_cast<float>(x), static_cast<float>(std::min(std::erf(x), 0.999)));
  }
  const std::vector<glm::vec2> values = runGaussian(kShapes[0], ErrorFunction, None, inputs);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const double expected = std::erf(double(inputs[i].x));
    EXPECT_NEAR(double(values[i].x), expected, std::min(1e-6 * expected, 3e-7)) << inputs[i].x;
    const double back = std::erf(double(values[i].y));
    EXPECT_NEAR(back, double(inputs[i].y), 1e-6 * double(inputs[i].y)) << inputs[i].y;
  }
}

/// Planted: densities and samples of the whole distribution, and as much of it above the mean as below.
TEST(TruncatedGaussian, CheckersSeePlantedBugs) {
  for (const Planted bug : {NotTruncated, SecondSide}) {
    EXPECT_GT(std::abs(integral(kShapes[0], bug) - 1.0), kIntegralTolerance) << bug;
    const SampleVerdict verdict = judgeSamples(kShapes[0], bug);
    EXPECT_LT(verdict.pValue, kMinPValue) << bug;
    EXPECT_GT(verdict.worstPdfError, kPdfTolerance) << bug;
  }
}

/// Samples about a distance, with scores of two decades.
std::vector<glm::vec2> samplesAbout(double distance, double deviation) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal(distance, deviation);
  std::uniform_real_distribution<double> decades(-1.0, 1.0);
  std::vector<glm::vec2> samples;
  for (int i = 0; i < 512; ++i) {
    samples.emplace_back(static_cast<float>(normal(random)), static_cast<float>(std::pow(10.0, decades(random))));
  }
  return samples;
}

/// Relative error of a chain's deviation against that of its samples, weighted by their scores, in double.
double deviationError(double distance, Planted planted) {
  const std::vector<glm::vec2> samples = samplesAbout(distance, 0.1);
  double sum = 0.0;
  double mean = 0.0;
  double squares = 0.0;
  for (const glm::vec2& sample : samples) {
    const double before = mean;
    sum += double(sample.y);
    mean += double(sample.y) / sum * (double(sample.x) - before);
    squares += double(sample.y) * (double(sample.x) - before) * (double(sample.x) - mean);
  }
  const glm::vec2 chain = runGaussian(kShapes[0], Chain, planted, samples)[0];
  return std::abs(double(chain.x) / std::sqrt(squares / sum) - 1.0);
}

/// A thousand units away a distance is known to 6e-5, and its square to 0.06: six times the variance.
TEST(DistanceChain, DeviationIsKeptFarFromTheCamera) {
  EXPECT_LT(deviationError(1000.0, None), 1e-2);
  EXPECT_GT(deviationError(1000.0, MeanOfSquares), 1e-1) << "the planted mean of squares was not seen";
}

} // namespace
} // namespace tyndall::test
