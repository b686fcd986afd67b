// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/figure.h"

#include <vector>

namespace tyndall::bench {

/// An effort: how long it took and how wrong it was.
struct Effort {
  double samples = 0.0; ///< or any measure of effort that error goes down with as 1 / samples; 0: no such measure
  Figure squaredError;  ///< noise alone
  Figure seconds;
};

enum class Reach {
  Measured,     ///< between two efforts, by a straight line of logarithms
  Extrapolated, ///< beyond the greatest effort: noise as 1 / samples, time linear
  Better,       ///< the least effort is better already: its time, an upper bound
  Never         ///< what remains without noise is more than that
};

/// When an error falls to a bound.
struct Crossing {
  Reach reach = Reach::Never;
  Figure seconds;
};

/// @param efforts rising, at least one.
/// @param squaredBias what remains however long it takes.
/// @param squaredBound the error that is asked for, squared like theirs.
Crossing secondsTo(double squaredBound, const std::vector<Effort>& efforts, double squaredBias);

/// Slope of squared error times seconds beyond the least effort; nothing for a single effort, or one without noise.
/// Invariant under the number of samples where noise falls as 1 / samples.
bool efficiencyOf(const std::vector<Effort>& efforts, Figure& efficiency);

} // namespace tyndall::bench
