// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

/// Integrals in double, for references.
namespace tyndall::verify {

/// Gauss-Legendre nodes on [0, 1] and weights that sum to 1. @see [Press07] section 4.6
struct GaussRule {
  std::vector<double> nodes;
  std::vector<double> weights;
};
/// @param count of nodes, >= 1; exact for polynomials of degree 2 count - 1. Computed once per count.
const GaussRule& gaussRule(int count);

/// Integral over [a, b], by bisection until a 7-node rule and the sum over its halves agree.
/// @param tolerance absolute error granted to the whole.
double integrate(const std::function<double(double)>& function, double a, double b, double tolerance);

/// Sum of integrals between neighbours of the sorted `breaks`, each found to `relative` of a first estimate of the sum.
double integratePieces(const std::function<double(double)>& function, const std::vector<double>& breaks, double relative);

} // namespace tyndall::verify
