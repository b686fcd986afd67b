// SPDX-License-Identifier: Apache-2.0
// Samples, values, reciprocity and energy of every rough material, against formulas in double written from the papers.
#include "shaders/material_cases.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace tyndall::test {
namespace {

using interop::BsdfAnswer;
using interop::BsdfQuery;

constexpr std::uint32_t kSamples = 1u << 16;

/// How far floats can be off: the half vector is the sum of two directions whose components are off by 1e-7, and its
/// slope is compared with alpha. Close to total reflection, the refracted cosine is the root of a small difference.
double tolerance(const BsdfQuery& query, const glm::dvec3& wo, const glm::dvec3& wi) {
  const double ratio = static_cast<double>(query.etaRatio);
  const double eta = wo.z > 0.0 ? ratio : 1.0 / ratio;
  const bool transmitted = wo.z * wi.z < 0.0;
  const glm::dvec3 sum = wo + (transmitted ? eta : 1.0) * wi;
  double critical = 0.0;
  if (query.model == static_cast<std::uint32_t>(MaterialId::Dielectric)) {
    const double ho = std::max(std::abs(glm::dot(wo, glm::normalize(sum))), 1e-9);
    const double beyond2 = std::max(std::abs(1.0 - (1.0 - ho * ho) / (eta * eta)), 1e-9);
    critical = transmitted ? 2e-6 / std::min(beyond2, ho) : 4e-6 / std::sqrt(beyond2);
  }
  return 2e-5 + critical + 2e-6 / (std::max(static_cast<double>(query.alpha), 1e-4) * glm::length(sum));
}

struct SampleVerdict {
  double pValue = 0.0;
  double worstPdf = 0.0; ///< relative error over the tolerance
  double worstWeight = 0.0;
  bool finite = true;
};

SampleVerdict judgeSamples(const BsdfQuery& query, std::uint32_t planted) {
  const std::vector<BsdfAnswer> samples = askBsdf({query}, interop::kProbeSamples, planted, kSamples);
  const glm::dvec3 wo = glm::normalize(glm::dvec3(query.wo));
  SampleVerdict verdict{.pValue = ScatteringBins(query, wo).pValue(samples)};
  for (const BsdfAnswer& sample : samples) {
    if ((sample.flags & interop::kAnswerValid) == 0) {
      continue;
    }
    const glm::dvec3 wi = glm::normalize(glm::dvec3(sample.wi));
    const Scattering expected = oracleScattering(query, wo, wi);
    const double allowed = tolerance(query, wo, wi);
    const double pdf = static_cast<double>(sample.pdf);
    verdict.finite = verdict.finite && std::isfinite(pdf) && (sample.flags & interop::kAnswerDelta) == 0;
    verdict.worstPdf = std::max({verdict.worstPdf, std::abs(pdf / expected.pdf - 1.0) / allowed,
                                 std::abs(static_cast<double>(sample.valuePdf) / expected.pdf - 1.0) / allowed});
    const glm::dvec3 weight = expected.value / expected.pdf;
    const glm::dvec3 ratio = glm::dvec3(sample.value) / static_cast<double>(sample.valuePdf);
    for (int c = 0; c < 3; ++c) {
      const double scale = std::max(weight[c], 1e-3) * allowed;
      verdict.worstWeight =
          std::max({verdict.worstWeight, std::abs(static_cast<double>(sample.weight[c]) - weight[c]) / scale,
                    std::abs(ratio[c] - weight[c]) / scale});
    }
  }
  return verdict;
}

TEST(Materials, SamplesFollowThePdfAndWeighTheirValueOverIt) {
  for (const NamedQuery& one : roughCases()) {
    const SampleVerdict verdict = judgeSamples(one.query, interop::kPlantNone);
    EXPECT_GT(verdict.pValue, kMinPValue) << one.name;
    EXPECT_TRUE(verdict.finite) << one.name;
    EXPECT_LT(verdict.worstPdf, 1.0) << one.name;
    EXPECT_LT(verdict.worstWeight, 1.0) << one.name;
  }
}

TEST(Materials, SampleCheckersSeePlantedBugs) {
  using enum MaterialId;
  for (const BsdfQuery& query :
       {bsdfQuery(Conductor, 0.3, 0.5), bsdfQuery(Dielectric, 0.3, 0.5), bsdfQuery(MetalRough, 0.3, 0.5)}) {
    EXPECT_LT(judgeSamples(query, interop::kPlantAlpha).pValue, kMinPValue);
    EXPECT_GT(judgeSamples(query, interop::kPlantAlpha).worstPdf, 1.0);
  }
  EXPECT_GT(judgeSamples(bsdfQuery(Dielectric, 0.3, 0.5), interop::kPlantImportance).worstWeight, 1.0);
  EXPECT_GT(judgeSamples(bsdfQuery(MetalRough, 0.3, 0.5), interop::kPlantBranchPdf).worstPdf, 1.0);
  EXPECT_GT(judgeSamples(bsdfQuery(Diffuse, 0.3, 0.5), interop::kPlantBright).worstWeight, 1.0);
  EXPECT_LT(judgeSamples(bsdfQuery(Conductor, 0.02, 0.9), interop::kPlantAngle).pValue, kMinPValue);
}

/// Random pairs of directions on all sides, many of them close to the horizon.
std::vector<BsdfQuery> randomPairs(std::size_t count) {
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const std::vector<NamedQuery> cases = roughCases();
  const auto direction = [&] {
    const double z = std::pow(unit(engine), 3.0) * (unit(engine) < 0.5 ? -1.0 : 1.0);
    const double azimuth = 6.283 * unit(engine);
    const double sine = std::sqrt(1.0 - z * z);
    return glm::vec3(sine * std::cos(azimuth), sine * std::sin(azimuth), z);
  };
  std::vector<BsdfQuery> pairs;
  for (std::size_t i = 0; i < count; ++i) {
    BsdfQuery query = cases[i % cases.size()].query;
    query.wo = direction();
    query.wi = direction();
    pairs.push_back(query);
  }
  return pairs;
}

TEST(Materials, ValuesAreTheFormulas) {
  const std::vector<BsdfQuery> pairs = randomPairs(1u << 18);
  const auto worst = [&](std::uint32_t planted) {
    const std::vector<BsdfAnswer> answers = askBsdf(pairs, interop::kProbeValues, planted);
    double error = 0.0;
    std::size_t seen = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const glm::dvec3 wo = glm::normalize(glm::dvec3(pairs[i].wo));
      const glm::dvec3 wi = glm::normalize(glm::dvec3(pairs[i].wi));
      if (std::min(std::abs(wo.z), std::abs(wi.z)) < 1e-5) {
        continue; // where tangent begins is the library's choice
      }
      const Scattering expected = oracleScattering(pairs[i], wo, wi);
      const double allowed = tolerance(pairs[i], wo, wi);
      const double pdf = static_cast<double>(answers[i].valuePdf);
      error = std::max(error, std::abs(pdf - expected.pdf) / allowed / (expected.pdf + 1e-6));
      for (int c = 0; c < 3; ++c) {
        error = std::max(error, std::abs(static_cast<double>(answers[i].value[c]) - expected.value[c]) / allowed /
                                    (expected.value[c] + 1e-6));
      }
      seen += expected.pdf > 0.0 ? 1 : 0;
    }
    EXPECT_GT(seen, pairs.size() / 4);
    return error;
  };
  EXPECT_LT(worst(interop::kPlantNone), 1.0);
  EXPECT_GT(worst(interop::kPlantImportance), 1.0);
  EXPECT_GT(worst(interop::kPlantBranchPdf), 1.0);
  EXPECT_GT(worst(interop::kPlantOneWay), 1.0);
}

/// Theory (20): f(wo, wi) / n(wo)^2 is the same both ways.
TEST(Materials, AreReciprocal) {
  const std::vector<BsdfQuery> there = randomPairs(1u << 17);
  std::vector<BsdfQuery> back = there;
  for (BsdfQuery& query : back) {
    std::swap(query.wo, query.wi);
  }
  const auto worst = [&](std::uint32_t planted) {
    const std::vector<BsdfAnswer> first = askBsdf(there, interop::kProbeValues, planted);
    const std::vector<BsdfAnswer> second = askBsdf(back, interop::kProbeValues, planted);
    double error = 0.0;
    for (std::size_t i = 0; i < there.size(); ++i) {
      const glm::dvec3 wo(there[i].wo);
      const glm::dvec3 wi(there[i].wi);
      const auto square = [&](double z) {
        return z > 0.0 ? 1.0 : std::pow(static_cast<double>(there[i].etaRatio), 2.0);
      };
      for (int c = 0; c < 3; ++c) {
        const double a = static_cast<double>(first[i].value[c]) / std::abs(wi.z) * square(wi.z);
        const double b = static_cast<double>(second[i].value[c]) / std::abs(wo.z) * square(wo.z);
        error = std::max(error, std::abs(a - b) / (a + b + 1e-6) /
                                    std::max(tolerance(there[i], wo, wi), tolerance(there[i], wi, wo)));
      }
    }
    return error;
  };
  EXPECT_LT(worst(interop::kPlantNone), 1.0);
  EXPECT_GT(worst(interop::kPlantOneWay), 1.0);
  EXPECT_GT(worst(interop::kPlantImportance), 1.0);
}

struct Furnace {
  double albedo;        ///< by the oracle
  double zScore;        ///< of the device's mean weight against it
  double largestAlbedo; ///< of the device, less 5 standard errors
  double lossZ;         ///< of the share of invalid samples against 1 - the pdf's integral
};

/// White surroundings: what a surface reflects and refracts of them, by samples.
Furnace furnace(const BsdfQuery& query, std::uint32_t planted) {
  const std::vector<BsdfAnswer> samples = askBsdf({query}, interop::kProbeSamples, planted, kSamples);
  const double ratio = static_cast<double>(query.etaRatio);
  const double eta2 = query.wo.z > 0.0f ? ratio * ratio : 1.0 / (ratio * ratio);
  std::vector<double> weights;
  std::vector<double> lost;
  for (const BsdfAnswer& sample : samples) {
    const bool valid = (sample.flags & interop::kAnswerValid) != 0;
    const bool transmitted = (sample.flags & interop::kAnswerTransmitted) != 0;
    weights.push_back(valid ? static_cast<double>(sample.weight.x) * (transmitted ? eta2 : 1.0) : 0.0);
    lost.push_back(valid ? 0.0 : 1.0);
  }
  const ScatteringBins oracle(query, glm::normalize(glm::dvec3(query.wo)));
  const MeanEstimate mean = estimateMean(weights);
  // The quadrature's cells cut the horizon roughly: 5e-4. Of samples none may be lost: one is added to the error.
  const MeanEstimate loss = estimateMean(lost);
  const double lossError = std::abs(loss.mean - 1.0 + oracle.pdfIntegral()) - 5e-4;
  return {oracle.albedo().x, mean.zScore(oracle.albedo().x, 5e-4), mean.mean - 5.0 * mean.standardError,
          lossError / (loss.standardError + 1.0 / kSamples)};
}

TEST(Materials, LoseEnergyAsStatedAndNeverMakeAny) {
  for (NamedQuery& one : roughCases()) {
    one.query.colour = glm::vec3(1.0f);
    one.query.k = glm::vec3(0.0f);
    const Furnace result = furnace(one.query, interop::kPlantNone);
    EXPECT_LT(result.albedo, 1.0 + 2e-4) << one.name;
    EXPECT_LT(result.zScore, kMaxZ) << one.name;
    EXPECT_LT(result.lossZ, kMaxZ) << one.name;
    EXPECT_LT(result.largestAlbedo, 1.0 + 1e-4) << one.name;
  }
  BsdfQuery planted = bsdfQuery(MaterialId::Dielectric, 0.1, 0.5);
  planted.colour = glm::vec3(1.0f);
  EXPECT_GT(furnace(planted, interop::kPlantBright).zScore, kMaxZ);
  EXPECT_GT(furnace(planted, interop::kPlantBright).largestAlbedo, 1.0 + 1e-4);
  EXPECT_GT(furnace(bsdfQuery(MaterialId::Conductor, 0.7, 0.5), interop::kPlantAlpha).lossZ, kMaxZ);
}

double whiteAlbedo(MaterialId model, double roughness, double cosine, float colour) {
  BsdfQuery query = bsdfQuery(model, roughness, cosine);
  query.colour = glm::vec3(colour);
  query.coatF0 = 0.0f;
  return ScatteringBins(query, glm::normalize(glm::dvec3(query.wo))).albedo().x;
}

/// The quadrature that the furnace is judged by: GGX of alpha 1, seen from above, reflects 1 - ln 2 of all light.
TEST(Materials, QuadratureReproducesAClosedForm) {
  EXPECT_NEAR(whiteAlbedo(MaterialId::Conductor, 1.0, 1.0, 1.0f), 1.0 - std::log(2.0), 5e-4);
  EXPECT_GT(std::abs(whiteAlbedo(MaterialId::Conductor, 0.99, 1.0, 1.0f) - 1.0 + std::log(2.0)), 5e-4);
}

/// Where coat and base together come closest to 1: roughness 0.38, cosine 0.6, no reflection at normal incidence.
TEST(Materials, CoatedBaseKeepsItsEnergyWhereThatIsHardest) {
  const double all = whiteAlbedo(MaterialId::MetalRough, 0.38, 0.6, 1.0f);
  const double coat = whiteAlbedo(MaterialId::MetalRough, 0.38, 0.6, 0.0f);
  EXPECT_LT(all, 1.0);
  EXPECT_GT(all, 0.998);
  EXPECT_GT(coat + (all - coat) * 1.05 / 1.047, 1.0); // the factor for smooth coats makes energy
}

} // namespace
} // namespace tyndall::test
