// SPDX-License-Identifier: Apache-2.0
#include "verify/verdict.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace tyndall::verify {
namespace {

/// Two-sided p of a difference, after what rounding may be to blame for is taken off.
double differenceP(double difference, double allowed, double standardError, double degrees, double& t) {
  if (!std::isfinite(difference)) {
    t = std::numeric_limits<double>::infinity();
    return 0.0;
  }
  const double excess = std::max(0.0, std::abs(difference) - allowed);
  t = excess == 0.0 ? 0.0 : excess / standardError; // infinite without any scatter
  if (excess == 0.0) {
    return 1.0;
  }
  return standardError > 0.0 && std::isfinite(t) ? film::studentTTwoSidedP(t, degrees) : 0.0;
}

double standardErrorOf(const film::SampleSummary& summary) { return std::sqrt(summary.variance / summary.count); }

/// Keeps the least likely of a family.
class Family {
public:
  void add(std::size_t index, double p, double t, double bias, double resolution = 0.0) {
    ++count_;
    if (p < smallest_ || count_ == 1) {
      smallest_ = p;
      verdict_.worst = index;
      verdict_.worstT = t;
      verdict_.bias = bias;
      verdict_.resolution = resolution;
    }
  }
  Verdict verdict() const {
    Verdict result = verdict_;
    result.familyP = film::sidakFamilyP(smallest_, double(count_));
    return result;
  }

private:
  Verdict verdict_;
  double smallest_ = 1.0;
  std::size_t count_ = 0;
};

} // namespace

std::string Verdict::text() const {
  return fmt::format("family p {:.3g}, worst at {}: {:.1f} standard errors, {:+.4g} % of the reference (one standard "
                     "error is {:.3g} %)",
                     familyP, worst, worstT, 100.0 * bias, 100.0 * resolution);
}

Verdict pixelTest(const Moments& moments, const std::vector<double>& reference, int channel, double tolerance) {
  Family family;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    if (std::isnan(reference[i])) {
      continue;
    }
    const film::SampleSummary& pixel = moments.pixels[i][static_cast<std::size_t>(channel)];
    const double difference = pixel.mean - reference[i];
    double t = 0.0;
    const double p =
        differenceP(difference, tolerance * std::abs(reference[i]), standardErrorOf(pixel), pixel.count - 1.0, t);
    family.add(i, p, t, difference / reference[i]);
  }
  Verdict verdict = family.verdict();
  verdict.resolution = standardErrorOf(moments.pixels[verdict.worst][static_cast<std::size_t>(channel)]) /
                       std::abs(reference[verdict.worst]);
  return verdict;
}

Verdict imageTest(const Moments& moments, double reference, int channel, double tolerance) {
  const film::SampleSummary image = moments.image(channel);
  Verdict verdict;
  verdict.degrees = image.count - 1.0;
  verdict.familyP = differenceP(image.mean - reference, tolerance * std::abs(reference), standardErrorOf(image),
                                verdict.degrees, verdict.worstT);
  verdict.bias = (image.mean - reference) / reference;
  verdict.resolution = standardErrorOf(image) / std::abs(reference);
  return verdict;
}

Verdict tileTest(const Moments& a, const Moments& b, double tolerance) {
  Family family;
  for (int channel = 0; channel < 4; ++channel) {
    for (std::size_t tile = 0; tile < a.tileMeans.front().size(); ++tile) {
      const film::SampleSummary first = a.tile(tile, channel);
      const film::SampleSummary second = b.tile(tile, channel);
      const double scale = 0.5 * (std::abs(first.mean) + std::abs(second.mean));
      // Welch's t with Satterthwaite's degrees of freedom.
      const double u = first.variance / first.count;
      const double v = second.variance / second.count;
      const double spread = u * u / (first.count - 1.0) + v * v / (second.count - 1.0);
      const double degrees = spread > 0.0 ? (u + v) * (u + v) / spread : 1.0;
      const double difference = first.mean - second.mean;
      double t = 0.0;
      const double p = differenceP(difference, tolerance * scale, std::sqrt(u + v), degrees, t);
      const double inverse = scale > 0.0 ? 1.0 / scale : 0.0;
      family.add(tile, p, t, difference * inverse, std::sqrt(u + v) * inverse);
    }
  }
  return family.verdict();
}

double meanOf(const std::vector<double>& values) {
  double sum = 0.0;
  double count = 0.0;
  for (const double value : values) {
    if (!std::isnan(value)) {
      sum += value;
      count += 1.0;
    }
  }
  return sum / count;
}

Verdict channelTest(const Moments& a, int channelA, const Moments& b, int channelB) {
  const film::SampleSummary first = a.image(channelA);
  const film::SampleSummary second = b.image(channelB);
  const film::TestResult test = film::welchTest(first, second);
  Verdict verdict;
  verdict.familyP = test.p;
  verdict.degrees = test.degrees;
  verdict.worstT = test.statistic;
  const double error = std::sqrt(first.variance / first.count + second.variance / second.count);
  const double scale = 0.5 * (std::abs(first.mean) + std::abs(second.mean));
  verdict.bias = scale > 0.0 ? (first.mean - second.mean) / scale : 0.0;
  verdict.resolution = scale > 0.0 ? error / scale : 0.0;
  return verdict;
}

Verdict channelTest(const Moments& a, const Moments& b, int channel) { return channelTest(a, channel, b, channel); }

} // namespace tyndall::verify
