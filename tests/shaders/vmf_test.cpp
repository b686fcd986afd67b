// SPDX-License-Identifier: Apache-2.0
// Properties of the von Mises-Fisher lobe of guide/vmf.glsl, against its formulas in double.
#include "shaders/sphere_bins.h"
#include "support/probe.h"
#include "support/statistics.h"

// Needs <cstdint> before it.
#include "kernels/vmf_probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tyndall::test {
namespace {

constexpr std::uint32_t kSampleCount = 1u << 18;
constexpr double kPi = std::numbers::pi;

enum Mode : std::uint32_t { Samples, Values, GivenNumbers, Concentrations };
enum Planted : std::uint32_t {
  None,
  CosinePdf,
  CosineSample,
  NoNormalisation,
  WiderLobe,
  ZeroNotSpecial,
  SmallAngles,
  TextbookKappa,
  UniformAngle
};

struct Lobe {
  glm::vec3 mu;
  float kappa;
};

const std::vector<glm::vec3> kAxes{glm::normalize(glm::vec3(0.3f, -0.8f, 0.5f)), glm::vec3(0.0f, 0.0f, -1.0f)};

double density(double kappa, double oneMinusCos) {
  const double peak = kappa == 0.0 ? 1.0 / (4.0 * kPi) : kappa / (2.0 * kPi * -std::expm1(-2.0 * kappa));
  return peak * std::exp(-kappa * oneMinusCos);
}

PolarDensity densityOf(const Lobe& lobe) {
  return [kappa = static_cast<double>(lobe.kappa)](double oneMinusCos, double) { return density(kappa, oneMinusCos); };
}

/// 1 - (coth kappa - 1 / kappa)
double meanOneMinusCos(double kappa) {
  return kappa < 1e-3 ? 1.0 - kappa / 3.0 : 1.0 - 1.0 / std::tanh(kappa) + 1.0 / kappa;
}

std::vector<glm::vec4> runVmf(const Lobe& lobe, Mode mode, Planted planted,
                              const std::vector<glm::vec3>& inputs = {glm::vec3(0.0f)}) {
  struct Push {
    glm::vec3 mu;
    float kappa;
    std::uint32_t count;
    interop::Ptr<glm::vec3> inputs;
    interop::Ptr<glm::vec4> outputs;
  };
  const ProbeRunner probe(k_vmf_probe_spirv, {{0, mode}, {1, planted}});
  const std::uint32_t count = mode == Samples ? kSampleCount : static_cast<std::uint32_t>(inputs.size());
  const auto in = ProbeRunner::upload(inputs);
  const auto out = ProbeRunner::results<glm::vec4>(count);
  probe.run(Push{lobe.mu, lobe.kappa, count, in.ptr(), out.ptr()}, count);
  return ProbeRunner::download(out);
}

/// Relative error of a reported pdf at a direction; below 1e-25 absolute, since exp() may return 0 for what is
/// denormal.
double pdfError(const Lobe& lobe, const glm::vec4& directionAndPdf) {
  const double place = polarPlace(glm::dvec3(lobe.mu), glm::dvec3(directionAndPdf)).x;
  const double expected = density(static_cast<double>(lobe.kappa), place);
  return std::abs(static_cast<double>(directionAndPdf.w) - expected) / std::max(expected, 1e-25);
}

struct SampleVerdict {
  double pValue;        ///< chi-squared of the directions against the density
  double meanZ;         ///< of the mean of 1 - cos
  double worstPdfError; ///< relative
  double worstLength;   ///< distance of a direction's length from 1
};

SampleVerdict judgeSamples(const Lobe& lobe, Planted planted) {
  const glm::dvec3 axis(lobe.mu);
  SampleVerdict verdict{};
  std::vector<glm::dvec3> directions;
  std::vector<double> places;
  for (const glm::vec4& sample : runVmf(lobe, Samples, planted)) {
    const glm::dvec3 w(sample);
    directions.push_back(w);
    places.push_back(polarPlace(axis, w).x);
    verdict.worstPdfError = std::max(verdict.worstPdfError, pdfError(lobe, sample));
    verdict.worstLength = std::max(verdict.worstLength, std::abs(glm::length(w) - 1.0));
  }
  verdict.pValue = SphereBins(densityOf(lobe), 50, 4).pValue(axis, directions);
  const double expected = meanOneMinusCos(static_cast<double>(lobe.kappa));
  verdict.meanZ = estimateMean(places).zScore(expected, 1e-6 * expected);
  return verdict;
}

struct ValueVerdict {
  double integral;
  double worstError; ///< relative, against the formula
};

ValueVerdict judgeValues(const Lobe& lobe, Planted planted) {
  const SphereQuadrature quadrature = sphereQuadrature(glm::dvec3(lobe.mu));
  const std::vector<glm::vec4> values = runVmf(lobe, Values, planted, quadrature.directions);
  ValueVerdict verdict{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    verdict.integral += static_cast<double>(values[i].w) * quadrature.weights[i];
    const double error = pdfError(lobe, values[i]);
    verdict.worstError = std::isfinite(error) ? std::max(verdict.worstError, error) : error;
  }
  return verdict;
}

struct Vector {
  float kappa;
  double cosine;
  double pdf;
};

/// To the seven digits that are written.
const std::vector<Vector> kVectors{{0.0f, 0.3, 0.0795775},  {1e-3f, 0.3, 0.0796013}, {1.0f, 1.0, 0.1840655},
                                   {1.0f, -1.0, 0.0249106}, {10.0f, 0.9, 0.5854983}, {100.0f, 0.99, 5.854983},
                                   {1e4f, 1.0, 1591.549},   {1e4f, 0.9999, 585.4983}};

double worstVectorError(Planted planted) {
  double worst = 0.0;
  for (const Vector& vector : kVectors) {
    const glm::vec3 w(std::sqrt(1.0 - vector.cosine * vector.cosine), 0.0, vector.cosine);
    const glm::vec4 value = runVmf({glm::vec3(0.0f, 0.0f, 1.0f), vector.kappa}, Values, planted, {w})[0];
    const double error = std::abs(static_cast<double>(value.w) / vector.pdf - 1.0);
    worst = std::isfinite(error) ? std::max(worst, error) : 1.0;
  }
  return worst;
}

/// The number of samples, among concentrations up to 1e7 and random numbers at the ends of (0, 1), whose direction is
/// not unit or whose pdf is negative or not finite.
int badExtremes(const glm::vec3& mu, Planted planted) {
  const std::vector<float> concentrations{0.0f, 1e-38f, 1e-30f, 1e-8f, 2.9e-8f, 3.1e-8f, 1e-4f,
                                          1.0f, 44.0f,  100.0f, 1e4f,  1e6f,    1e7f};
  const std::vector<float> ends{1.2e-38f, 1e-30f, 2.3e-10f, 3e-8f, 0.5f, 0.9999f, std::nextafter(1.0f, 0.0f)};
  std::vector<glm::vec3> inputs;
  for (const float kappa : concentrations) {
    for (const float a : ends) {
      for (const float b : ends) {
        inputs.emplace_back(kappa, a, b);
      }
    }
  }
  const std::vector<glm::vec4> samples = runVmf({mu, 0.0f}, GivenNumbers, planted, inputs);
  return static_cast<int>(std::ranges::count_if(samples, [](const glm::vec4& sample) {
    const bool isUnit = std::abs(glm::length(glm::dvec3(sample)) - 1.0) < 1e-6;
    return !isUnit || !std::isfinite(sample.w) || sample.w < 0.0f;
  }));
}

/// Largest error of the concentration against the rational function in double, relative where that is above 1.
double worstConcentrationError(Planted planted) {
  std::vector<glm::vec3> means{glm::vec3(2.0f), glm::vec3(1.5f), glm::vec3(1.0f)};
  for (double e = 1.0; e > 1e-7; e *= 0.93) {
    means.emplace_back(static_cast<float>(e));
  }
  const std::vector<glm::vec4> results = runVmf({kAxes[0], 0.0f}, Concentrations, planted, means);
  double worst = 0.0;
  for (std::size_t i = 0; i < means.size(); ++i) {
    const double e = std::min(static_cast<double>(means[i].x), 1.0);
    const double expected = (2.0 - 3.0 * e * e + e * e * e) / (e * (2.0 - e));
    const double error = std::abs(static_cast<double>(results[i].x) - expected) / std::max(expected, 1.0);
    worst = std::isfinite(error) ? std::max(worst, error) : 1.0;
  }
  return worst;
}

constexpr double kPdfTolerance = 2e-5;      // exp magnifies the exponent's rounding where the pdf is far below its peak
constexpr double kIntegralTolerance = 1e-4; // the quadrature's own error is 1e-6, the rest rounding of directions
constexpr double kVectorTolerance = 4e-6;   // half a unit of the last digit written, and rounding
constexpr double kConcentrationTolerance = 1e-6;
constexpr double kLengthTolerance = 1e-6;

TEST(Vmf, IntegratesToOneAndIsTheFormula) {
  for (const float kappa : {0.0f, 1e-6f, 1.0f, 1e2f, 1e5f}) {
    for (const glm::vec3& axis : kAxes) {
      const ValueVerdict verdict = judgeValues({axis, kappa}, None);
      EXPECT_NEAR(verdict.integral, 1.0, kIntegralTolerance) << kappa;
      EXPECT_LT(verdict.worstError, kPdfTolerance) << kappa;
    }
  }
}

TEST(Vmf, HasThePublishedValues) { EXPECT_LT(worstVectorError(None), kVectorTolerance); }

TEST(Vmf, SamplesFollowThePdfAndHaveItsMeanCosine) {
  for (const float kappa : {0.0f, 1.0f, 30.0f, 1e4f, 1e6f}) {
    for (const glm::vec3& axis : kAxes) {
      const SampleVerdict verdict = judgeSamples({axis, kappa}, None);
      EXPECT_GT(verdict.pValue, kMinPValue) << kappa;
      EXPECT_LT(verdict.meanZ, kMaxZ) << kappa;
      EXPECT_LT(verdict.worstPdfError, kPdfTolerance) << kappa;
      EXPECT_LT(verdict.worstLength, kLengthTolerance) << kappa;
    }
  }
}

TEST(Vmf, ExtremeNumbersGiveUnitDirectionsAndFinitePdfs) {
  for (const glm::vec3& axis : kAxes) {
    EXPECT_EQ(badExtremes(axis, None), 0);
  }
}

TEST(Vmf, ConcentrationOfAMeanIsTheFormula) { EXPECT_LT(worstConcentrationError(None), kConcentrationTolerance); }

TEST(Vmf, CheckersSeePlantedBugs) {
  const glm::vec3 axis = kAxes[0];
  EXPECT_GT(std::abs(judgeValues({axis, 1.0f}, NoNormalisation).integral - 1.0), kIntegralTolerance);
  EXPECT_FALSE(judgeValues({axis, 1e5f}, CosinePdf).worstError < kPdfTolerance);
  EXPECT_FALSE(judgeValues({axis, 0.0f}, ZeroNotSpecial).worstError < kPdfTolerance);
  EXPECT_GT(worstVectorError(NoNormalisation), kVectorTolerance);
  EXPECT_GT(worstVectorError(ZeroNotSpecial), kVectorTolerance);

  EXPECT_LT(judgeSamples({axis, 0.0f}, UniformAngle).pValue, kMinPValue);
  for (const float kappa : {1.0f, 30.0f, 1e4f, 1e6f}) {
    const SampleVerdict wider = judgeSamples({axis, kappa}, WiderLobe);
    EXPECT_LT(wider.pValue, kMinPValue) << kappa;
    EXPECT_GT(wider.meanZ, kMaxZ) << kappa;
  }
  EXPECT_LT(judgeSamples({axis, 1e6f}, CosineSample).pValue, kMinPValue);
  EXPECT_GT(judgeSamples({axis, 1e6f}, CosinePdf).worstPdfError, kPdfTolerance);
  EXPECT_GT(judgeSamples({axis, 1.0f}, SmallAngles).worstLength, kLengthTolerance);

  EXPECT_GT(badExtremes(axis, ZeroNotSpecial), 0);
  EXPECT_GT(badExtremes(axis, SmallAngles), 0);
  EXPECT_GT(worstConcentrationError(TextbookKappa), kConcentrationTolerance);
}

} // namespace
} // namespace tyndall::test
