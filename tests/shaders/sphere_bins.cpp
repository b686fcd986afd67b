// SPDX-License-Identifier: Apache-2.0
#include "shaders/sphere_bins.h"

#include "support/statistics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tyndall::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSmallest = 1e-14; // of 1 -+ cos: angles of 1e-7, what float directions resolve
constexpr int kCells = 20000;       // of each hemisphere

/// Monotonic in the angle and logarithmic near both poles: ln((1 - cos) / (1 + cos)).
double polarCoordinate(const glm::dvec2& place) {
  return std::log(std::max(place.x, kSmallest) / std::max(place.y, kSmallest));
}

/// 1 - cos and 1 + cos of a coordinate.
glm::dvec2 polarPlaceOf(double coordinate) {
  const double ratio = std::exp(-std::abs(coordinate)); // of the smaller to the larger
  const glm::dvec2 place(2.0 * ratio / (1.0 + ratio), 2.0 / (1.0 + ratio));
  return coordinate < 0.0 ? place : glm::dvec2(place.y, place.x);
}

} // namespace

glm::dvec2 polarPlace(const glm::dvec3& axis, const glm::dvec3& w) {
  const double minus = glm::dot(axis - w, axis - w);
  const double plus = glm::dot(axis + w, axis + w);
  return glm::dvec2(minus, plus) * (2.0 / (minus + plus));
}

SphereBins::SphereBins(const PolarDensity& density, int rings, int sectors) : sectors_(sectors) {
  const double end = std::log(2.0 / kSmallest);
  const double step = 2.0 * end / (2 * kCells);
  std::vector<double> cumulative{0.0};
  for (int i = 0; i < 2 * kCells; ++i) {
    // d(1 - cos) = (1 - cos)(1 + cos) / 2 d(coordinate)
    const glm::dvec2 place = polarPlaceOf(-end + (i + 0.5) * step);
    cumulative.push_back(cumulative.back() + 2.0 * kPi * density(place.x, place.y) * 0.5 * place.x * place.y * step);
  }
  integral_ = cumulative.back();
  std::size_t cell = 0;
  double previous = 0.0;
  for (int ring = 1; ring < rings; ++ring) {
    while (cumulative[cell] < integral_ * ring / rings) {
      ++cell;
    }
    ringEdges_.push_back(-end + static_cast<double>(cell) * step);
    ringProbabilities_.push_back((cumulative[cell] - previous) / integral_);
    previous = cumulative[cell];
  }
  ringProbabilities_.push_back((integral_ - previous) / integral_);
}

double SphereBins::pValue(const glm::dvec3& axis, std::span<const glm::dvec3> directions) const {
  const glm::dvec3 helper = std::abs(axis.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 tangent = glm::normalize(glm::cross(helper, axis));
  const glm::dvec3 bitangent = glm::cross(axis, tangent);
  std::vector<std::uint64_t> counts(ringProbabilities_.size() * static_cast<std::size_t>(sectors_));
  std::vector<double> probabilities(counts.size());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    probabilities[i] = ringProbabilities_[i / static_cast<std::size_t>(sectors_)] / sectors_;
  }
  for (const glm::dvec3& w : directions) {
    const double coordinate = polarCoordinate(polarPlace(axis, w));
    const auto ring = std::upper_bound(ringEdges_.begin(), ringEdges_.end(), coordinate) - ringEdges_.begin();
    const double turns = std::atan2(glm::dot(w, bitangent), glm::dot(w, tangent)) / (2.0 * kPi) + 0.5;
    const int sector = std::clamp(static_cast<int>(turns * sectors_), 0, sectors_ - 1);
    ++counts[static_cast<std::size_t>(ring) * static_cast<std::size_t>(sectors_) + static_cast<std::size_t>(sector)];
  }
  return chiSquaredPValue(counts, probabilities);
}

SphereQuadrature sphereQuadrature(const glm::dvec3& axis) {
  SphereQuadrature result;
  const glm::dvec3 helper = std::abs(axis.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 tangent = glm::normalize(glm::cross(helper, axis));
  const glm::dvec3 bitangent = glm::cross(axis, tangent);
  constexpr int kRings = 4000;
  constexpr int kSectors = 5;
  const double end = std::log(2.0 / kSmallest);
  const double step = 2.0 * end / kRings;
  for (int ring = 0; ring < kRings; ++ring) {
    const glm::dvec2 place = polarPlaceOf(-end + (ring + 0.5) * step);
    const double sine = std::sqrt(place.x * place.y);
    for (int sector = 0; sector < kSectors; ++sector) {
      const double azimuth = 2.0 * kPi * (sector + 0.25) / kSectors;
      const glm::dvec3 w = (1.0 - place.x) * axis + sine * (std::cos(azimuth) * tangent + std::sin(azimuth) * bitangent);
      result.directions.emplace_back(w);
      result.weights.push_back(2.0 * kPi / kSectors * 0.5 * place.x * place.y * step);
    }
  }
  return result;
}

} // namespace tyndall::test
