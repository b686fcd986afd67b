// SPDX-License-Identifier: Apache-2.0
#include "microbench/frames_statistics.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tyndall::microbench {
namespace {

double meanOf(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

} // namespace

double frameError(const std::vector<std::vector<double>>& pictures, const std::vector<double>& reference) {
  constexpr double kEpsilon = 0.01;
  const double epsilon = kEpsilon * meanOf(reference);
  std::vector<double> errors(reference.size(), 0.0);
  for (const std::vector<double>& picture : pictures) {
    TYNDALL_CHECK(picture.size() == reference.size());
    for (std::size_t i = 0; i < picture.size(); ++i) {
      const double off = picture[i] - reference[i];
      errors[i] += off * off / (reference[i] * reference[i] + epsilon * epsilon) / double(pictures.size());
    }
  }
  std::sort(errors.begin(), errors.end());
  errors.resize(errors.size() - static_cast<std::size_t>(kTrimmedFrameShare * double(errors.size())));
  return meanOf(errors);
}

std::optional<std::size_t> framesToRecover(std::span<const double> errors, std::span<const double> steady) {
  TYNDALL_CHECK(!steady.empty());
  const double most = kRecoveredWithin * meanOf(steady);
  for (std::size_t first = 0; first + kRecoveryWindow <= errors.size(); ++first) {
    if (meanOf(errors.subspan(first, kRecoveryWindow)) <= most) {
      return first;
    }
  }
  return std::nullopt;
}

} // namespace tyndall::microbench
