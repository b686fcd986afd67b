// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/variance.h"
#include "microbench/measure.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// What renders with several seeds say about an estimator. A run is one seed's render.
namespace tyndall::microbench {

/// How often each run is drawn in a resample.
using Draws = std::vector<std::uint32_t>;

struct Mean {
  double value = 0.0;
  double error = 0.0; ///< standard error
};
/// Over the runs of the mean over all pixels. @param runs at least 2.
Mean imageMean(const Pictures& runs);

/// Of every pixel, unbiased. @param runs at least 2.
std::vector<double> pixelVariances(const Pictures& runs);

/// The pixels, ascending, but for the ceil(share * pixels) where the sum of the rows' variances is largest.
std::vector<std::size_t> withoutWorst(std::span<const std::vector<double>> rows, double share);

/// Variance of a pixel, averaged over some pixels, for any resample of the runs: for that the products of runs, summed
/// over the pixels, are enough.
class RunProducts {
public:
  RunProducts(const Pictures& runs, const std::vector<std::size_t>& pixels);
  double variance() const { return variance(Draws(runs_, 1)); }
  /// Unbiased if each run is drawn once. @param draws one per run, as many in all as there are runs.
  double variance(const Draws& draws) const;
  std::size_t runs() const { return runs_; }

private:
  std::size_t runs_;
  std::vector<double> products_; ///< [run][run], of deviations from the mean picture; mean over the pixels
};

/// How many times better than a reference. Not a number where either has no noise.
struct Gain {
  double value = 0.0;
  Interval range; ///< 95 %, by the bootstrap
};
struct Gains {
  Gain samples; ///< in variance, at equal samples
  Gain time;    ///< in variance times time
};

/// What a gain is made of. Run i of both is of the same round, so that what else the machine did cancels in the ratio
/// of their times.
struct Efficiency {
  const RunProducts& products;
  const std::vector<double>& seconds; ///< of each run
};

/// At least 3 runs. The same figures give the same intervals.
Gains gainsOver(const Efficiency& reference, const Efficiency& row);

} // namespace tyndall::microbench
