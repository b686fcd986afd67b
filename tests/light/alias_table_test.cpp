// SPDX-License-Identifier: Apache-2.0
#include "light/alias_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace tyndall::light {
namespace {

/// Probability of each outcome as the table is drawn: slot uniformly, then kept or passed on.
std::vector<double> drawn(const std::vector<interop::AliasEntry>& table) {
  std::vector<double> probabilities(table.size(), 0.0);
  const double slot = 1.0 / static_cast<double>(table.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double keep = static_cast<double>(table[i].keep);
    probabilities[i] += slot * keep;
    probabilities[table[i].alias] += slot * (1.0 - keep);
  }
  return probabilities;
}

/// Largest difference between the table's probabilities, drawn and stored, and those of `weights`.
double worstError(const std::vector<interop::AliasEntry>& table, const std::vector<double>& weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  const std::vector<double> probabilities = drawn(table);
  double worst = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    worst = std::max(worst, std::abs(probabilities[i] - weights[i] / sum));
    worst = std::max(worst, std::abs(static_cast<double>(table[i].probability) - weights[i] / sum));
  }
  return worst;
}

TEST(AliasTable, ProbabilitiesEqualTheWeights) {
  std::mt19937 engine(3);
  std::exponential_distribution<double> exponential;
  std::vector<std::vector<double>> cases{{1.0}, {0.0, 2.0}, {1.0, 1.0, 1.0}, {1e-300, 1e300}, std::vector<double>(1000, 0.0)};
  cases.back()[123] = 5.0;
  for (const std::size_t count : {7u, 1000u, 100000u}) {
    cases.emplace_back(count);
    for (double& weight : cases.back()) {
      weight = std::pow(exponential(engine), 5.0);
    }
  }
  for (const std::vector<double>& weights : cases) {
    EXPECT_LT(worstError(makeAliasTable(weights), weights), 1e-6) << weights.size() << " weights";
  }
  // The checker: a table of other weights.
  EXPECT_GT(worstError(makeAliasTable(std::vector<double>{1.0, 2.0}), {1.0, 2.001}), 1e-6);
}

TEST(AliasTable, NeverDrawsWhatHasNoWeight) {
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> uniform;
  std::vector<double> weights(50000);
  for (double& weight : weights) {
    weight = uniform(engine) < 0.5 ? 0.0 : uniform(engine);
  }
  const std::vector<double> probabilities = drawn(makeAliasTable(weights));
  for (std::size_t i = 0; i < weights.size(); ++i) {
    EXPECT_EQ(probabilities[i] == 0.0, weights[i] == 0.0) << i;
  }
}

TEST(AliasTable, AllZeroHasNoProbability) {
  for (const interop::AliasEntry& entry : makeAliasTable(std::vector<double>(5, 0.0))) {
    EXPECT_EQ(entry.probability, 0.0f);
    EXPECT_LT(entry.alias, 5u);
  }
}

} // namespace
} // namespace tyndall::light
