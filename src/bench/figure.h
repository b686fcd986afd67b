// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

/// Measured figures and their errors.
namespace tyndall::bench {

/// A positive figure and the standard error of its logarithm, so that products and ratios keep their errors.
struct Figure {
  double value = 0.0;
  double logError = 0.0;
};
Figure operator*(const Figure& a, const Figure& b); ///< of independent figures
Figure operator/(const Figure& a, const Figure& b);

/// Ends of the 95 % interval of a figure that `repeats` >= 2 runs gave: Student's t on the logarithm.
struct Interval {
  double low = 0.0;
  double high = 0.0;
};
Interval interval(const Figure& figure, std::size_t repeats);

/// The upper one of the two middle values of an even count. `values` must not be empty.
double median(std::vector<double> values);

/// Median of positive times and its error, as if their logarithms were normal.
Figure medianTime(const std::vector<double>& seconds);

/// a over b, which were measured in turn: of the ratios round by round, so that what else the machine does cancels.
Figure ratioInTurn(const std::vector<double>& a, const std::vector<double>& b);

/// "1.02 [0.99, 1.05]": the figure and its 95 % interval.
std::string rangeText(const Figure& figure, std::size_t repeats);

/// Three digits, with an exponent only where the number needs one.
std::string shortText(double value);

} // namespace tyndall::bench
