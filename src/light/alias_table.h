// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "interop/environment.h"

#include <span>
#include <vector>

namespace tyndall::light {

/// A table that draws outcome i with probability weights[i] / sum. Slot i keeps outcome i with probability `keep`.
/// @param weights finite, >= 0, at least one. If all are 0, every probability is 0 and the table must not be drawn
/// from. @see [Vose91] "A linear algorithm for generating random numbers with a given distribution"
std::vector<interop::AliasEntry> makeAliasTable(std::span<const double> weights);

} // namespace tyndall::light
