// SPDX-License-Identifier: Apache-2.0
// Properties of every phase function of phase/list.h, against formulas in double written from the papers.
#include "interop/phase.h"
#include "light/mie.h"
#include "phase/list.h"
#include "shaders/sphere_bins.h"
#include "support/probe.h"
#include "support/statistics.h"

// Needs <cstdint> before it.
#include "kernels/phase_probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace tyndall::test {
namespace {

constexpr std::uint32_t kSampleCount = 1u << 18;
constexpr double kFourPi = 4.0 * std::numbers::pi;

enum Planted : std::uint32_t { None, WrongSign, MissingFourPi, BranchPdf, CosineForm, WrongJacobian };
enum Mode : std::uint32_t { Samples, Values, MeanCosine };

struct Case {
  std::string name;
  PhaseId id;
  glm::vec4 parameters;
  PolarDensity density;
  double meanCosine;
};

/// [Henyey41] eq. (2)
PolarDensity hg(double g) {
  return [g](double oneMinusCos, double onePlusCos) {
    const double h = std::abs(g);
    const double o = g < 0.0 ? onePlusCos : oneMinusCos;
    return (1.0 - h * h) / kFourPi / std::pow((1.0 - h) * (1.0 - h) + 2.0 * h * o, 1.5);
  };
}

/// [Draine03]
PolarDensity draine(double g, double alpha) {
  return [=](double oneMinusCos, double onePlusCos) {
    const double cosine = 0.5 * (onePlusCos - oneMinusCos);
    return hg(g)(oneMinusCos, onePlusCos) * (1.0 + alpha * cosine * cosine) / (1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0);
  };
}

double draineMean(double g, double alpha) {
  return g * (1.0 + alpha * (3.0 + 2.0 * g * g) / 5.0) / (1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0);
}

PolarDensity mixture(PolarDensity a, PolarDensity b, double weightOfB) {
  return [=](double m, double p) { return (1.0 - weightOfB) * a(m, p) + weightOfB * b(m, p); };
}

/// Parameters and axes are rounded to float first: at g = 0.9999 that moves the peak by more than the tests can bear.
/// Through memory, because g++ 12 at -O3 drops the conversion to float and back.
double rounded(double value) {
  const volatile float stored = static_cast<float>(value);
  return static_cast<double>(stored);
}

void addModel(std::vector<Case>& cases, PhaseId id) {
  const auto add = [&](const std::string& name, glm::vec4 parameters, PolarDensity density, double mean) {
    cases.push_back({name, id, parameters, std::move(density), mean});
  };
  switch (id) {
  case PhaseId::Isotropic:
    add("isotropic", glm::vec4(0.0f), [](double, double) { return 1.0 / kFourPi; }, 0.0);
    break;
  case PhaseId::HenyeyGreenstein:
    for (const double exact : {0.0, 1e-6, 0.5, -0.5, 0.9, -0.9, 0.99, -0.99, 0.9999, -0.9999}) {
      const double g = rounded(exact);
      add("hg " + std::to_string(exact), glm::vec4(static_cast<float>(g), 0.0f, 0.0f, 0.0f), hg(g), g);
    }
    break;
  case PhaseId::TwoLobe:
    for (const glm::dvec3 p : {glm::dvec3(0.8, -0.3, 0.7), glm::dvec3(0.99, -0.9, 0.5), glm::dvec3(0.5, 0.2, 0.0), glm::dvec3(0.5, 0.2, 1.0)}) {
      const glm::dvec3 q(rounded(p.x), rounded(p.y), rounded(p.z));
      add("two-lobe " + std::to_string(p.z), glm::vec4(glm::vec3(q), 0.0f), mixture(hg(q.y), hg(q.x), q.z), q.z * q.x + (1.0 - q.z) * q.y);
    }
    break;
  case PhaseId::Rayleigh:
    add("rayleigh", glm::vec4(0.0f), draine(0.0, 1.0), 0.0);
    break;
  case PhaseId::Draine:
    for (const glm::dvec2 p : {glm::dvec2(0.0, 1.0), glm::dvec2(0.7, 0.0), glm::dvec2(0.5, 30.0), glm::dvec2(-0.9, 1.0), glm::dvec2(0.9999, 5.0)}) {
      const glm::dvec2 q(rounded(p.x), rounded(p.y));
      add("draine " + std::to_string(p.x), glm::vec4(glm::vec2(q), 0.0f, 0.0f), draine(q.x, q.y), draineMean(q.x, q.y));
    }
    break;
  case PhaseId::Mie:
    for (const double diameter : {5.0, 12.0, 50.0}) {
      const glm::vec4 parameters = light::mieParameters(diameter);
      const glm::dvec4 p(parameters);
      add("mie " + std::to_string(diameter), parameters, mixture(hg(p.x), draine(p.y, p.z), p.w), (1.0 - p.w) * p.x + p.w * draineMean(p.y, p.z));
    }
    break;
  }
}

std::vector<Case> allCases() {
  std::vector<Case> cases;
#define X(Name, prefix, id, sceneName, parameters)                                                                     \
  {                                                                                                                    \
    const std::size_t before = cases.size();                                                                           \
    addModel(cases, PhaseId::Name);                                                                                    \
    EXPECT_GT(cases.size(), before) << sceneName << " has no test cases";                                             \
  }
  TYNDALL_PHASE_LIST(X)
#undef X
  return cases;
}

const std::vector<glm::dvec3> kAxes{glm::dvec3(rounded(0.30304576), rounded(-0.80812204), rounded(0.50507627)),
                                    glm::dvec3(0.0, 0.0, -1.0)};

std::vector<glm::vec4> runPhase(const Case& model, const glm::dvec3& axis, Mode mode, Planted planted,
                                const std::vector<glm::vec3>& directions = {glm::vec3(0.0f)}) {
  struct Push {
    interop::Phase phase;
    glm::vec3 dIn;
    std::uint32_t count;
    interop::Ptr<glm::vec3> directions;
    interop::Ptr<glm::vec4> outputs;
  };
  // Only the model's own bit is set: a mask that leaves it out would return 0.
  const ProbeRunner probe(k_phase_probe_spirv, {{0, mode}, {1, planted}, {2, 1u << static_cast<unsigned>(model.id)}});
  const std::uint32_t count = mode == Samples ? kSampleCount : static_cast<std::uint32_t>(directions.size());
  const auto in = ProbeRunner::upload(directions);
  const auto out = ProbeRunner::results<glm::vec4>(count);
  probe.run(Push{{static_cast<std::uint32_t>(model.id), model.parameters}, glm::vec3(axis), count, in.ptr(), out.ptr()}, count);
  return ProbeRunner::download(out);
}

struct SampleVerdict {
  double pValue;          ///< chi-squared of the directions against the formula
  double meanCosineZ;     ///< of 1 - cos or 1 + cos, whichever is small
  double worstPdfError;   ///< relative, reported pdf against the formula at the same direction
  bool finite = true;
};

SampleVerdict judgeSamples(const Case& model, const glm::dvec3& axis, Planted planted) {
  const std::vector<glm::vec4> samples = runPhase(model, axis, Samples, planted);
  SampleVerdict verdict{};
  std::vector<glm::dvec3> directions;
  std::vector<double> places;
  const bool backward = model.meanCosine < 0.0;
  for (const glm::vec4& sample : samples) {
    const glm::dvec3 w(sample);
    verdict.finite = verdict.finite && std::isfinite(glm::dot(w, w)) && std::abs(glm::length(w) - 1.0) < 1e-6;
    const glm::dvec2 place = polarPlace(axis, w);
    directions.push_back(w);
    places.push_back(backward ? place.y : place.x);
    const double expected = model.density(place.x, place.y);
    verdict.worstPdfError = std::max(verdict.worstPdfError, std::abs(static_cast<double>(sample.w) / expected - 1.0));
  }
  verdict.pValue = SphereBins(model.density, 50, 4).pValue(axis, directions);
  const double expectedPlace = backward ? 1.0 + model.meanCosine : 1.0 - model.meanCosine;
  verdict.meanCosineZ = estimateMean(places).zScore(expectedPlace, 1e-6 * expectedPlace);
  return verdict;
}

struct ValueVerdict {
  double integral;
  double worstError;      ///< relative, against the formula
};

ValueVerdict judgeValues(const Case& model, const glm::dvec3& axis, Planted planted) {
  const SphereQuadrature quadrature = sphereQuadrature(axis);
  const std::vector<glm::vec4> values = runPhase(model, axis, Values, planted, quadrature.directions);
  ValueVerdict verdict{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = static_cast<double>(values[i].w);
    const glm::dvec2 place = polarPlace(axis, glm::dvec3(quadrature.directions[i]));
    verdict.integral += value * quadrature.weights[i];
    const double error = std::abs(value / model.density(place.x, place.y) - 1.0);
    verdict.worstError = std::isfinite(error) ? std::max(verdict.worstError, error) : error;
  }
  return verdict;
}

Case caseOf(const std::string& name) {
  const std::vector<Case> cases = allCases();
  return *std::find_if(cases.begin(), cases.end(), [&](const Case& one) { return one.name.starts_with(name); });
}

// A dozen float operations, of which the exponent 3/2 magnifies some.
constexpr double kPdfTolerance = 2e-5;

// The quadrature's own error is 1e-6; the rest is rounding of peak directions.
constexpr double kIntegralTolerance = 1e-4;

TEST(Phase, SamplesFollowThePdfAndHaveItsMeanCosine) {
  for (const Case& model : allCases()) {
    for (const glm::dvec3& axis : kAxes) {
      const SampleVerdict verdict = judgeSamples(model, axis, None);
      EXPECT_TRUE(verdict.finite) << model.name;
      EXPECT_GT(verdict.pValue, kMinPValue) << model.name;
      EXPECT_LT(verdict.worstPdfError, kPdfTolerance) << model.name;
      EXPECT_LT(verdict.meanCosineZ, kMaxZ) << model.name;
    }
  }
}

TEST(Phase, MeanCosineIsTheFormula) {
  for (const Case& model : allCases()) {
    const double onDevice = static_cast<double>(runPhase(model, kAxes[0], MeanCosine, None)[0].w);
    EXPECT_NEAR(onDevice, model.meanCosine, 1e-6) << model.name;
  }
}

TEST(Phase, IntegratesToOneAndIsTheFormula) {
  for (const Case& model : allCases()) {
    for (const glm::dvec3& axis : kAxes) {
      const ValueVerdict verdict = judgeValues(model, axis, None);
      EXPECT_NEAR(verdict.integral, 1.0, kIntegralTolerance) << model.name;
      EXPECT_LT(verdict.worstError, kPdfTolerance) << model.name;
    }
  }
}

TEST(Phase, CheckersSeePlantedBugs) {
  const Case forward = caseOf("hg 0.5");
  EXPECT_LT(judgeSamples(forward, kAxes[0], WrongSign).pValue, kMinPValue);
  EXPECT_GT(judgeSamples(forward, kAxes[0], WrongSign).meanCosineZ, kMaxZ);
  EXPECT_GT(std::abs(judgeValues(forward, kAxes[0], MissingFourPi).integral - 1.0), kIntegralTolerance);
  EXPECT_LT(judgeSamples(caseOf("isotropic"), kAxes[0], WrongJacobian).pValue, kMinPValue);

  const SampleVerdict branch = judgeSamples(caseOf("two-lobe"), kAxes[0], BranchPdf);
  EXPECT_GT(branch.pValue, kMinPValue); // the samples are right,
  EXPECT_GT(branch.worstPdfError, kPdfTolerance); // what is said of them is not

  EXPECT_FALSE(judgeValues(caseOf("hg 0.9999"), kAxes[0], CosineForm).worstError < kPdfTolerance);
}

} // namespace
} // namespace tyndall::test
