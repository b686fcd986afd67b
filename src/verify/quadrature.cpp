// SPDX-License-Identifier: Apache-2.0
#include "verify/quadrature.h"

#include <cmath>
#include <map>
#include <numbers>

namespace tyndall::verify {
namespace {

GaussRule makeRule(int count) {
  GaussRule rule;
  for (int i = 0; i < count; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
    double slope = 1.0;
    for (int step = 0; step < 100; ++step) {
      double previous = 1.0;
      double value = x;
      for (int n = 2; n <= count; ++n) {
        const double next = ((2 * n - 1) * x * value - (n - 1) * previous) / n;
        previous = value;
        value = next;
      }
      slope = count * (x * value - previous) / (x * x - 1.0);
      const double change = value / slope;
      x -= change;
      if (std::abs(change) < 1e-15) {
        break;
      }
    }
    rule.nodes.push_back(0.5 * (1.0 - x));
    rule.weights.push_back(1.0 / ((1.0 - x * x) * slope * slope));
  }
  return rule;
}

double gauss(const std::function<double(double)>& function, double a, double b) {
  const GaussRule& rule = gaussRule(7);
  double sum = 0.0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    sum += rule.weights[i] * function(a + (b - a) * rule.nodes[i]);
  }
  return sum * (b - a);
}

double refine(const std::function<double(double)>& function, double a, double b, double whole, double tolerance, int depth) {
  const double middle = 0.5 * (a + b);
  const double left = gauss(function, a, middle);
  const double right = gauss(function, middle, b);
  if (depth == 0 || std::abs(left + right - whole) <= tolerance) {
    return left + right;
  }
  return refine(function, a, middle, left, 0.5 * tolerance, depth - 1) + refine(function, middle, b, right, 0.5 * tolerance, depth - 1);
}

} // namespace

const GaussRule& gaussRule(int count) {
  static std::map<int, GaussRule> rules;
  const auto [place, fresh] = rules.try_emplace(count);
  if (fresh) {
    place->second = makeRule(count);
  }
  return place->second;
}

double integrate(const std::function<double(double)>& function, double a, double b, double tolerance) {
  return a < b ? refine(function, a, b, gauss(function, a, b), tolerance, 40) : 0.0;
}

double integratePieces(const std::function<double(double)>& function, const std::vector<double>& breaks, double relative) {
  double estimate = 0.0;
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    estimate += std::abs(gauss(function, breaks[i - 1], breaks[i]));
  }
  double sum = 0.0;
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    sum += integrate(function, breaks[i - 1], breaks[i], relative * estimate / static_cast<double>(breaks.size()));
  }
  return sum;
}

} // namespace tyndall::verify
