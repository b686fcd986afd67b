// SPDX-License-Identifier: Apache-2.0
#include "verify/oracle_sphere.h"

#include "verify/oracle_phase.h"
#include "verify/quadrature.h"

#include <cmath>
#include <numbers>

namespace tyndall::verify {
namespace {

using std::numbers::pi;

constexpr double kLampRadiance = 5.0;

} // namespace

Chord chordOf(const glm::dvec3& toCentre, double radius, const glm::dvec3& direction) {
  const double middle = glm::dot(toCentre, direction);
  const glm::dvec3 aside = toCentre - middle * direction;
  const double half2 = radius * radius - glm::dot(aside, aside);
  return half2 > 0.0 ? Chord{middle - std::sqrt(half2), middle + std::sqrt(half2)} : Chord{};
}

/// By Gauss's rule in the angle from the axis (stretched, so that chords have no root at the horizon) and an even one
/// around it.
double overSphere(const glm::dvec3& toCentre, double radius, const std::function<double(const glm::dvec3&)>& function) {
  const double distance = glm::length(toCentre);
  const glm::dvec3 axis = toCentre / distance;
  const glm::dvec3 across = glm::normalize(glm::cross(axis, glm::dvec3(0.3, 1.0, 0.2)));
  const glm::dvec3 up = glm::cross(axis, across);
  const GaussRule& rule = gaussRule(24);
  constexpr int kAround = 48;
  double sum = 0.0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    // sin(theta) = R / d sin(u), u from 0 to 90 degrees.
    const double u = 0.5 * pi * rule.nodes[i];
    const double sine = radius / distance * std::sin(u);
    const double cosine = std::sqrt(1.0 - sine * sine);
    const double weight = rule.weights[i] * 0.5 * pi * sine * radius / distance * std::cos(u) / cosine;
    for (int k = 0; k < kAround; ++k) {
      const double phi = 2.0 * pi * (k + 0.5) / kAround;
      sum += weight * 2.0 * pi / kAround *
             function(sine * std::cos(phi) * across + sine * std::sin(phi) * up + cosine * axis);
    }
  }
  return sum;
}

PathScene BallInFog::fog() const {
  PathScene test({8, 8});
  test.perspective({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 1e-6);
  test.box({-30.0, -30.0, 0.0}, {30.0, 30.0, depth}, sigmaT, albedo).phase = henyeyGreenstein(g);
  test.depth(1);
  return test;
}

PathScene BallInFog::withLamp() const {
  PathScene test = fog();
  test.lamp("lamp", kLampRadiance);
  test.ball("lamp", centre, radius);
  return test;
}

double BallInFog::lampRadiance() const {
  return airlight([this](const Chord& chord) { return kLampRadiance * std::exp(-sigmaT * chord.first); });
}

double BallInFog::airlight(const std::function<double(const Chord&)>& light) const {
  const auto at = [&](double t) {
    const glm::dvec3 toBall = centre - glm::dvec3(0.0, 0.0, t);
    const auto scattered = [&](const glm::dvec3& w) {
      return phaseOracle(henyeyGreenstein(g), w.z) * light(chordOf(toBall, radius, w));
    };
    return albedo * sigmaT * std::exp(-sigmaT * t) * overSphere(toBall, radius, scattered);
  };
  return integratePieces(at, {0.0, 2.0, 3.0, 4.0, depth}, 1e-7);
}

} // namespace tyndall::verify
