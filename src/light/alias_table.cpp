// SPDX-License-Identifier: Apache-2.0
#include "light/alias_table.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace tyndall::light {

std::vector<interop::AliasEntry> makeAliasTable(std::span<const double> weights) {
  TYNDALL_CHECK(!weights.empty());
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  TYNDALL_CHECK(std::isfinite(sum));
  std::vector<interop::AliasEntry> table(weights.size());
  std::vector<double> scaled(weights.size());
  std::vector<std::uint32_t> poor;
  std::vector<std::uint32_t> rich;
  for (std::uint32_t i = 0; i < weights.size(); ++i) {
    TYNDALL_CHECK(weights[i] >= 0.0);
    const double probability = sum > 0.0 ? weights[i] / sum : 0.0;
    // Not below the smallest normal float: what can be drawn must have a pdf above 0.
    const double stored = probability > 0.0 ? std::max(probability, double(std::numeric_limits<float>::min())) : 0.0;
    table[i] = {1.0f, i, static_cast<float>(stored)};
    scaled[i] = probability * static_cast<double>(weights.size());
    (scaled[i] < 1.0 ? poor : rich).push_back(i);
  }
  // Each poor slot is filled up by a rich outcome, which may become poor itself.
  while (!poor.empty() && !rich.empty()) {
    const std::uint32_t slot = poor.back();
    const std::uint32_t donor = rich.back();
    poor.pop_back();
    table[slot].keep = static_cast<float>(scaled[slot]);
    table[slot].alias = donor;
    scaled[donor] -= 1.0 - scaled[slot];
    if (scaled[donor] < 1.0) {
      rich.pop_back();
      poor.push_back(donor);
    }
  }
  // What is left would be 1 without rounding, except where the donors' rounding left a slot unfilled.
  const auto likeliest = static_cast<std::uint32_t>(std::max_element(weights.begin(), weights.end()) - weights.begin());
  for (const std::uint32_t slot : poor) {
    table[slot].keep = scaled[slot] > 0.5 ? 1.0f : static_cast<float>(scaled[slot]);
    table[slot].alias = likeliest;
  }
  return table;
}

} // namespace tyndall::light
