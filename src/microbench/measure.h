// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// Speed of the parts, and variance times time of the estimators, as a program and not as a test.
namespace tyndall::microbench {

/// Wall and process time [s]. On a CPU device and a busy machine the second one is the repeatable figure.
struct Cost {
  double wall = 0.0;
  double cpu = 0.0;
};
Cost costOf(const std::function<void()>& work);

/// The upper one of the two middle values of an even count. `values` must not be empty.
double median(std::vector<double> values);

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

/// Median of positive times and its error, as if their logarithms were normal.
Figure medianTime(const std::vector<double>& seconds);

/// a over b, which were measured in turn: of the ratios round by round, so that what else the machine does cancels.
Figure ratioInTurn(const std::vector<double>& a, const std::vector<double>& b);

/// "1.02 [0.99, 1.05]": the figure and its 95 % interval.
std::string rangeText(const Figure& figure, std::size_t repeats);

/// Three digits, with an exponent only where the number needs one.
std::string shortText(double value);

} // namespace tyndall::microbench
