// SPDX-License-Identifier: Apache-2.0
// Smooth surfaces, and whatever could make a material say something that is no number.
#include "shaders/material_cases.h"
#include "support/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace tyndall::test {
namespace {

using interop::BsdfAnswer;
using interop::BsdfQuery;

struct SmoothVerdict {
  double reflectedZ = 0.0;     ///< share of reflected samples against Fresnel's formula
  double worstDirection = 0.0; ///< distance from Snell's
  double worstWeight = 0.0;
  bool delta = true; ///< and without values
};

SmoothVerdict judgeSmooth(const BsdfQuery& query, std::uint32_t planted) {
  const std::vector<BsdfAnswer> samples = askBsdf({query}, interop::kProbeSamples, planted, 1u << 16);
  const glm::dvec3 wo = glm::normalize(glm::dvec3(query.wo));
  const double ratio = static_cast<double>(query.etaRatio);
  const double eta = wo.z > 0.0 ? ratio : 1.0 / ratio;
  const glm::dvec3 mirrored(-wo.x, -wo.y, wo.z);
  const double cosine2 = 1.0 - (1.0 - wo.z * wo.z) / (eta * eta);
  const glm::dvec3 refracted(-wo.x / eta, -wo.y / eta, -std::copysign(std::sqrt(std::max(cosine2, 0.0)), wo.z));
  SmoothVerdict verdict;
  std::vector<double> reflected;
  for (const BsdfAnswer& sample : samples) {
    const bool transmitted = (sample.flags & interop::kAnswerTransmitted) != 0;
    reflected.push_back(transmitted ? 0.0 : 1.0);
    verdict.worstDirection =
        std::max(verdict.worstDirection, glm::distance(glm::dvec3(sample.wi), transmitted ? refracted : mirrored));
    const glm::dvec3 weight = transmitted ? glm::dvec3(query.colour) / (eta * eta) : glm::dvec3(1.0);
    verdict.worstWeight = std::max(verdict.worstWeight, glm::distance(glm::dvec3(sample.weight), weight));
    verdict.delta = verdict.delta && sample.isDelta == 1 && sample.pdf == 0.0f && sample.valuePdf == 0.0f &&
                    sample.value == glm::vec3(0.0f) &&
                    (sample.flags | interop::kAnswerTransmitted) ==
                        (interop::kAnswerDelta | interop::kAnswerValid | interop::kAnswerTransmitted);
  }
  // Plus one count, for shares so small that none is drawn.
  const double expected = oracleFresnel(std::abs(wo.z), eta, 0.0);
  const double deviation = std::sqrt(expected * (1.0 - expected) / static_cast<double>(reflected.size())) +
                           1.0 / static_cast<double>(reflected.size());
  verdict.reflectedZ = std::abs(estimateMean(reflected).mean - expected) / deviation;
  return verdict;
}

std::vector<BsdfQuery> smoothCases() {
  std::vector<BsdfQuery> cases;
  for (const double ratio : {1.5, 1.0 / 1.5, 1.33, 2.4, 1.0001, 1.0}) {
    for (const double cosine : {1.0, 0.8, 0.6, 0.2, 0.01, 1e-5}) {
      for (const double side : {1.0, -1.0}) {
        cases.push_back(bsdfQuery(MaterialId::Dielectric, 0.0, side * cosine));
        cases.back().etaRatio = static_cast<float>(ratio);
      }
    }
  }
  return cases;
}

TEST(Materials, SmoothGlassObeysSnellAndFresnel) {
  bool total = false;
  for (const BsdfQuery& query : smoothCases()) {
    const SmoothVerdict verdict = judgeSmooth(query, interop::kPlantNone);
    const std::string name = std::to_string(query.etaRatio) + " at " + std::to_string(query.wo.z);
    EXPECT_LT(verdict.reflectedZ, kMaxZ) << name;
    // A root near 0 has half the digits of what is under it.
    EXPECT_LT(verdict.worstDirection, 2e-6) << name;
    EXPECT_LT(verdict.worstWeight, 2e-6) << name;
    EXPECT_TRUE(verdict.delta) << name;
    const double eta =
        query.wo.z > 0.0f ? static_cast<double>(query.etaRatio) : 1.0 / static_cast<double>(query.etaRatio);
    total = total || oracleFresnel(std::abs(static_cast<double>(query.wo.z)), eta, 0.0) == 1.0;
  }
  EXPECT_TRUE(total) << "no case of total reflection";
  const BsdfQuery query = bsdfQuery(MaterialId::Dielectric, 0.0, 0.2);
  EXPECT_GT(judgeSmooth(query, interop::kPlantSchlick).reflectedZ, kMaxZ);
  EXPECT_GT(judgeSmooth(query, interop::kPlantImportance).worstWeight, 2e-6);
  EXPECT_GT(judgeSmooth(query, interop::kPlantAngle).worstDirection, 2e-6);
}

TEST(Materials, EqualIndicesPassStraightHoweverRough) {
  const auto bent = [](double roughness, std::uint32_t planted) {
    BsdfQuery query = bsdfQuery(MaterialId::Dielectric, roughness, 0.3);
    query.etaRatio = 1.0f;
    std::size_t count = 0;
    for (const BsdfAnswer& sample : askBsdf({query}, interop::kProbeSamples, planted, 1000)) {
      const bool flags = sample.flags == (interop::kAnswerDelta | interop::kAnswerTransmitted | interop::kAnswerValid);
      count += flags && glm::distance(sample.wi, -query.wo) < 2e-7f && sample.weight == query.colour ? 0 : 1;
    }
    return count;
  };
  for (const double roughness : {0.0, 0.1, 1.0}) {
    EXPECT_EQ(bent(roughness, interop::kPlantNone), 0u);
    EXPECT_EQ(bent(roughness, interop::kPlantAngle), 1000u);
  }
}

TEST(Materials, MirrorsReflectByFresnel) {
  for (const bool gold : {false, true}) {
    for (const double cosine : {1.0, 0.5, 0.1, 0.01}) {
      BsdfQuery query = bsdfQuery(MaterialId::Conductor, 0.0, cosine);
      query.eta = glm::vec3(0.18f, 0.42f, 1.37f);
      query.k = gold ? glm::vec3(3.4f, 2.3f, 1.77f) : glm::vec3(0.0f);
      const BsdfAnswer sample = askBsdf({query}, interop::kProbeSamples)[0];
      EXPECT_EQ(sample.flags, interop::kAnswerDelta | interop::kAnswerValid);
      EXPECT_LT(glm::distance(sample.wi, glm::vec3(-query.wo.x, -query.wo.y, query.wo.z)), 2e-7f);
      for (int c = 0; c < 3; ++c) {
        const double colour = static_cast<double>(query.colour[c]);
        const double exact = oracleFresnel(static_cast<double>(query.wo.z), static_cast<double>(query.eta[c]),
                                           static_cast<double>(query.k[c]));
        const double schlick = colour + (1.0 - colour) * std::pow(1.0 - static_cast<double>(query.wo.z), 5.0);
        EXPECT_NEAR(static_cast<double>(sample.weight[c]), gold ? exact : schlick, 2e-6) << cosine;
        // What is not asked for differs: the test could tell.
        EXPECT_GT(std::abs(exact - schlick), 2e-5) << cosine;
      }
    }
  }
}

/// Directions and parameters at the ends of their ranges and next to them, in all combinations that chance makes.
std::vector<BsdfQuery> adversarial(std::size_t count) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto of = [&]<std::size_t N>(const std::array<double, N>& values) {
    return static_cast<float>(values[engine() % N]);
  };
  const std::array cosines{0.0, -0.0, 1e-45, 1e-30, 1e-10, 1e-7, 1e-6, 1.1e-6, 1e-4, 1e-2, 0.5, 0.99999994, 1.0};
  const std::array alphas{0.0, 1e-30, 9.9e-5, 1e-4, 1.01e-4, 1e-3, 0.01, 0.1, 0.5, 1.0};
  const std::array ratios{1.0, 0.99999994, 1.0000001, 1.0001, 1.01, 1.5, 0.6666667, 0.1, 10.0, 1e3, 1e-3};
  const std::array shares{0.0, 1.0, 0.5, 1e-20};
  const std::array indices{0.0, 1.0, 0.18, 1e-10, 30.0, 1e4};
  const auto direction = [&] {
    const float z = of(cosines) * (unit(engine) < 0.4 ? -1.0f : 1.0f);
    const double azimuth = unit(engine) < 0.3 ? 0.0 : 6.283 * unit(engine);
    const double sine = std::sqrt(std::max(0.0, 1.0 - static_cast<double>(z) * static_cast<double>(z)));
    return glm::vec3(static_cast<float>(sine * std::cos(azimuth)), static_cast<float>(sine * std::sin(azimuth)), z);
  };
  std::vector<BsdfQuery> queries(count);
  for (BsdfQuery& query : queries) {
    query.model = static_cast<std::uint32_t>(engine() % 5);
    query.colour = glm::vec3(of(shares), of(shares), of(shares));
    query.eta = glm::vec3(of(indices), of(indices), of(indices));
    query.k = unit(engine) < 0.5 ? glm::vec3(0.0f) : glm::vec3(of(indices), of(indices), of(indices));
    query.alpha = of(alphas);
    query.metallic = of(shares);
    query.etaRatio = of(ratios);
    query.coatF0 = of(shares);
    query.wo = direction();
    const double kind = unit(engine);
    query.wi = kind < 0.1   ? query.wo
               : kind < 0.2 ? -query.wo
               : kind < 0.3 ? glm::vec3(-query.wo.x, -query.wo.y, query.wo.z)
                            : direction();
  }
  return queries;
}

bool soundNumber(float x) { return std::isfinite(x) && x >= 0.0f; }
bool soundColour(const glm::vec3& v) { return soundNumber(v.x) && soundNumber(v.y) && soundNumber(v.z); }

/// How many answers are not sound; `why` shows one of them.
std::size_t unsound(const std::vector<BsdfQuery>& queries, std::uint32_t mode, std::uint32_t planted,
                    std::string& why) {
  const std::vector<BsdfAnswer> answers = askBsdf(queries, mode, planted);
  std::size_t count = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const BsdfAnswer& a = answers[i];
    const BsdfQuery& q = queries[i];
    bool sound = soundColour(a.value) && soundNumber(a.valuePdf);
    const bool opaque = q.model == static_cast<std::uint32_t>(MaterialId::Conductor) ||
                        q.model == static_cast<std::uint32_t>(MaterialId::MetalRough);
    if (opaque && q.wo.z <= 0.0f) {
      sound = sound && a.valuePdf == 0.0f && (mode == interop::kProbeValues || (a.flags & interop::kAnswerValid) == 0);
    }
    if (mode == interop::kProbeSamples && (a.flags & interop::kAnswerValid) != 0) {
      const bool delta = (a.flags & interop::kAnswerDelta) != 0;
      sound = sound && soundColour(a.weight) && soundNumber(a.pdf) && (delta || a.pdf > 0.0f) &&
              delta == (a.isDelta == 1) && std::abs(glm::length(glm::dvec3(a.wi)) - 1.0) < 1e-6 &&
              (a.wi.z * q.wo.z < 0.0f) == ((a.flags & interop::kAnswerTransmitted) != 0);
    }
    if (!sound) {
      ++count;
      why = "model " + std::to_string(q.model) + " wo.z " + std::to_string(q.wo.z) + " wi " + std::to_string(a.wi.z) +
            " alpha " + std::to_string(q.alpha) + " ratio " + std::to_string(q.etaRatio) + " pdf " +
            std::to_string(a.pdf) + " weight " + std::to_string(a.weight.x) + " value " + std::to_string(a.value.x) +
            " flags " + std::to_string(a.flags);
    }
  }
  return count;
}

TEST(Materials, SayOnlyNumbers) {
  const std::vector<BsdfQuery> queries = adversarial(1u << 20);
  std::string why;
  EXPECT_EQ(unsound(queries, interop::kProbeValues, interop::kPlantNone, why), 0u) << why;
  EXPECT_EQ(unsound(queries, interop::kProbeSamples, interop::kPlantNone, why), 0u) << why;
  EXPECT_GT(unsound(queries, interop::kProbeValues, interop::kPlantUnguarded, why), 0u);
}

} // namespace
} // namespace tyndall::test
