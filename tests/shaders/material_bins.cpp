// SPDX-License-Identifier: Apache-2.0
#include "shaders/material_oracle.h"
#include "support/statistics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tyndall::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kSlopes = 800;
constexpr std::size_t kAzimuths = 128;
constexpr std::size_t kRings = 24;
constexpr std::size_t kSectors = 8;
constexpr double kLowest = -5.0;  // ln of slope over scale: 5e-5 of GGX lies below
constexpr double kSteepest = 1e4; // slope of half vectors at most

} // namespace

ScatteringBins::ScatteringBins(const interop::BsdfQuery& query, const glm::dvec3& wo)
    : query_(query), wo_(wo), eta_(static_cast<double>(query.etaRatio)),
      scale_(std::max(static_cast<double>(query.alpha), 1e-4)) {
  if (wo.z < 0.0) {
    eta_ = 1.0 / eta_;
  }
  reflection_ = integrate(false);
  if (query.model == static_cast<std::uint32_t>(MaterialId::Dielectric)) {
    refraction_ = integrate(true);
  }
}

ScatteringBins::Lobe ScatteringBins::integrate(bool transmitted) {
  const double side = wo_.z < 0.0 ? -1.0 : 1.0;
  const glm::dvec3 o(wo_.x, wo_.y, std::abs(wo_.z));
  const double step = (std::log(kSteepest / scale_) - kLowest) / kSlopes;
  std::vector<double> masses(kSlopes * kAzimuths, 0.0);
  double total = 0.0;
  for (std::size_t cell = 0; cell < masses.size(); ++cell) {
    const double slope = scale_ * std::exp(kLowest + (static_cast<double>(cell / kAzimuths) + 0.5) * step);
    const double azimuth = 2.0 * kPi * (static_cast<double>(cell % kAzimuths) + 0.5) / kAzimuths;
    const glm::dvec3 h = glm::dvec3(slope * std::cos(azimuth), slope * std::sin(azimuth), 1.0) / std::hypot(1.0, slope);
    const double solidAngle = slope * slope * h.z * h.z * h.z * step * 2.0 * kPi / kAzimuths;
    const double ho = glm::dot(o, h);
    const double beyond2 = 1.0 - (1.0 - ho * ho) / (eta_ * eta_);
    if (ho <= 0.0 || (transmitted && beyond2 <= 0.0)) {
      continue;
    }
    glm::dvec3 i = 2.0 * ho * h - o;
    double jacobian = 4.0 * ho;
    if (transmitted) {
      i = -o / eta_ + (ho / eta_ - std::sqrt(beyond2)) * h;
      jacobian = std::pow(ho - eta_ * std::sqrt(beyond2), 2.0) / (eta_ * eta_ * std::sqrt(beyond2));
    }
    if (transmitted ? i.z >= 0.0 : i.z <= 0.0) {
      continue;
    }
    const Scattering s = oracleScattering(query_, wo_, {i.x, i.y, side * i.z});
    masses[cell] = s.pdf * jacobian * solidAngle;
    total += masses[cell];
    albedo_ += s.value * (jacobian * solidAngle * (transmitted ? eta_ * eta_ : 1.0));
  }
  pdfIntegral_ += total;

  Lobe lobe{std::vector<std::size_t>(kSlopes, 0), std::vector<double>(kRings * kSectors, 0.0)};
  double below = 0.0;
  for (std::size_t row = 0; row < kSlopes; ++row) {
    const std::size_t ring = total > 0.0 ? static_cast<std::size_t>(below / total * kRings) : 0;
    lobe.ringOf[row] = std::min(ring, kRings - 1);
    for (std::size_t column = 0; column < kAzimuths; ++column) {
      const double mass = masses[row * kAzimuths + column];
      lobe.probabilities[lobe.ringOf[row] * kSectors + column * kSectors / kAzimuths] += mass;
      below += mass;
    }
  }
  return lobe;
}

glm::dvec3 ScatteringBins::halfVector(const glm::dvec3& wi, bool transmitted) const {
  const double side = wo_.z < 0.0 ? -1.0 : 1.0;
  const glm::dvec3 sum = wo_ + (transmitted ? eta_ : 1.0) * wi;
  const glm::dvec3 h(sum.x, sum.y, side * sum.z);
  return h.z < 0.0 ? -h : h;
}

std::size_t ScatteringBins::binOf(const Lobe& lobe, const glm::dvec3& half) const {
  const double step = (std::log(kSteepest / scale_) - kLowest) / kSlopes;
  const double slope = std::log(std::hypot(half.x, half.y) / half.z / scale_ + 1e-300);
  const double row = std::clamp((slope - kLowest) / step, 0.0, kSlopes - 1.0);
  const double turns = std::atan2(half.y, half.x) / (2.0 * kPi);
  const std::size_t sector = static_cast<std::size_t>((turns - std::floor(turns)) * kSectors) % kSectors;
  return lobe.ringOf[static_cast<std::size_t>(row)] * kSectors + sector;
}

double ScatteringBins::pValue(const std::vector<interop::BsdfAnswer>& samples) const {
  constexpr std::size_t kBins = kRings * kSectors;
  std::vector<std::uint64_t> counts(2 * kBins + 1, 0);
  std::vector<double> probabilities = reflection_.probabilities;
  probabilities.insert(probabilities.end(), refraction_.probabilities.begin(), refraction_.probabilities.end());
  probabilities.resize(2 * kBins, 0.0);
  probabilities.push_back(std::max(1.0 - pdfIntegral_, 0.0));
  for (const interop::BsdfAnswer& sample : samples) {
    const bool transmitted = (sample.flags & interop::kAnswerTransmitted) != 0;
    if ((sample.flags & interop::kAnswerValid) == 0) {
      ++counts.back();
    } else {
      const glm::dvec3 half = halfVector(glm::normalize(glm::dvec3(sample.wi)), transmitted);
      ++counts[(transmitted ? kBins : 0) + binOf(transmitted ? refraction_ : reflection_, half)];
    }
  }
  // Slivers at the horizon are smaller than a cell: they join the samples that are lost there.
  for (std::size_t bin = 0; bin < 2 * kBins; ++bin) {
    if (probabilities[bin] * static_cast<double>(samples.size()) < 10.0) {
      counts.back() += counts[bin];
      probabilities.back() += probabilities[bin];
      counts[bin] = 0;
      probabilities[bin] = 0.0;
    }
  }
  if (probabilities.back() == 0.0 && counts.back() < 2) {
    counts.back() = 0; // rounding, once in all samples
  }
  return chiSquaredPValue(counts, probabilities);
}

} // namespace tyndall::test
