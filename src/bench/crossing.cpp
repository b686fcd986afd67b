// SPDX-License-Identifier: Apache-2.0
#include "bench/crossing.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace tyndall::bench {
namespace {

double total(const Effort& effort, double squaredBias) { return effort.squaredError.value + squaredBias; }

/// Between two efforts, of which the second reaches the bound.
Crossing between(double bound, const Effort& before, const Effort& after, double bias) {
  const double low = std::log(total(before, bias));
  const double high = std::log(std::max(total(after, bias), 1e-300));
  const double share = (low - std::log(bound)) / (low - high);
  const double rise = std::log(after.seconds.value / before.seconds.value);
  const double slope = rise / (low - high);
  const double error = std::hypot((1.0 - share) * before.squaredError.logError, share * after.squaredError.logError);
  const double time = std::hypot((1.0 - share) * before.seconds.logError, share * after.seconds.logError);
  return {Reach::Measured, {before.seconds.value * std::exp(share * rise), std::hypot(slope * error, time)}};
}

/// Seconds that do not grow with samples: where the line through the first and the last effort meets none. 0, so that
/// all of the time is taken to grow, where times are too uncertain to tell.
double fixedSeconds(const std::vector<Effort>& efforts) {
  const Effort& first = efforts.front();
  const Effort& last = efforts.back();
  if (efforts.size() < 2 || last.samples <= first.samples || last.seconds.value <= first.seconds.value) {
    return 0.0;
  }
  const double slope = (last.seconds.value - first.seconds.value) / (last.samples - first.samples);
  return std::max(first.seconds.value - slope * first.samples, 0.0);
}

} // namespace

Crossing secondsTo(double squaredBound, const std::vector<Effort>& efforts, double squaredBias) {
  TYNDALL_CHECK(!efforts.empty());
  if (total(efforts.front(), squaredBias) <= squaredBound) {
    return {Reach::Better, efforts.front().seconds};
  }
  for (std::size_t i = 1; i < efforts.size(); ++i) {
    if (total(efforts[i], squaredBias) <= squaredBound) {
      return between(squaredBound, efforts[i - 1], efforts[i], squaredBias);
    }
  }
  const Effort& last = efforts.back();
  if (squaredBound <= squaredBias || last.samples <= 0.0) {
    return {Reach::Never, {}};
  }
  const double fixed = fixedSeconds(efforts);
  const double growth = last.squaredError.value / (squaredBound - squaredBias);
  const double seconds = fixed + (last.seconds.value - fixed) * growth;
  return {Reach::Extrapolated, {seconds, std::hypot(last.squaredError.logError, last.seconds.logError)}};
}

bool efficiencyOf(const std::vector<Effort>& efforts, Figure& efficiency) {
  const Effort& last = efforts.back();
  const double fixed = fixedSeconds(efforts);
  if (efforts.size() < 2 || last.samples <= 0.0 || last.squaredError.value <= 0.0 || last.seconds.value <= fixed) {
    return false;
  }
  efficiency = {last.squaredError.value * (last.seconds.value - fixed),
                std::hypot(last.squaredError.logError, last.seconds.logError)};
  return true;
}

} // namespace tyndall::bench
