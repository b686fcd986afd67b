// SPDX-License-Identifier: Apache-2.0
#include "support/render_fixture.h"

#include "gpu_scene/gpu_scene.h"
#include "support/probe.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace tyndall::test {
namespace {

constexpr std::uint32_t kTile = 16;

void reportMessages() {
  static std::size_t reported = 0;
  const std::vector<std::string>& messages = probeDevice().messages();
  for (; reported < messages.size(); ++reported) {
    ADD_FAILURE() << "validation: " << messages[reported];
  }
}

std::vector<std::uint32_t> pixelsOf(const glm::uvec2& size, const std::vector<bool>& skip) {
  std::vector<std::uint32_t> pixels;
  for (std::uint32_t y = 0; y < size.y; ++y) {
    for (std::uint32_t x = 0; x < size.x; ++x) {
      if (skip.empty() || !skip[x + std::size_t(size.x) * y]) {
        pixels.push_back(x | y << 16);
      }
    }
  }
  return pixels;
}

/// Means of the pixels over the samples of one seed.
std::vector<std::array<double, 4>> renderReplicate(render::Estimator& estimator,
                                                   const std::vector<std::uint32_t>& pixels, std::uint32_t samples,
                                                   std::uint32_t seed) {
  std::vector<std::array<double, 4>> means(pixels.size(), std::array<double, 4>{});
  for (std::uint32_t first = 0; first < samples; first += film::kBatchSamples) {
    const std::uint32_t count = std::min(film::kBatchSamples, samples - first);
    for (std::size_t begin = 0; begin < pixels.size(); begin += estimator.chunkPixels()) {
      const std::size_t chunk = std::min<std::size_t>(estimator.chunkPixels(), pixels.size() - begin);
      const auto sums = estimator.run(std::span(pixels).subspan(begin, chunk), {first, count}, seed);
      for (std::size_t i = 0; i < chunk; ++i) {
        for (std::size_t channel = 0; channel < 4; ++channel) {
          const double background = channel < 3 ? double(sums[i].extras[channel]) : 0.0;
          means[begin + i][channel] += (double(sums[i].moments[channel]) + background) / samples;
        }
      }
    }
  }
  return means;
}

/// Two-sided p of a difference, after what rounding may be to blame for is taken off.
double differenceP(double difference, double allowed, double standardError, double degrees, double& t) {
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

/// Tiles across and down; the last ones may be cut off.
glm::uvec2 tilesOf(const glm::uvec2& size) { return (size + kTile - 1u) / kTile; }

/// Sums over the pixels of each tile, divided by the pixels of the image.
std::vector<std::array<double, 4>> tileMeans(const glm::uvec2& size, std::span<const std::uint32_t> pixels,
                                             const std::vector<std::array<double, 4>>& means) {
  const glm::uvec2 tiles = tilesOf(size);
  std::vector<std::array<double, 4>> result(std::size_t(tiles.x) * tiles.y);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    std::array<double, 4>& tile = result[(pixels[i] & 0xffffu) / kTile + tiles.x * ((pixels[i] >> 16) / kTile)];
    for (std::size_t channel = 0; channel < 4; ++channel) {
      tile[channel] += means[i][channel] / double(pixels.size());
    }
  }
  return result;
}

} // namespace

std::uint32_t effort() {
  const char* text = std::getenv("TYNDALL_TEST_EFFORT");
  return text == nullptr ? 1u : std::max(1u, static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10)));
}

std::vector<MomentOptions> eachMethod(const MomentOptions& options) {
  MomentOptions march = options;
  march.estimator.method = render::Method::March;
  march.replicates = std::max(8u, options.replicates / 4);
  return {options, march};
}

std::vector<MomentOptions> eachTracker(const MomentOptions& options) {
  std::vector<MomentOptions> result = eachMethod(options);
  MomentOptions delta = options;
  delta.estimator.deltaTracking = true;
  result.push_back(delta);
  return result;
}

MomentOptions withBug(MomentOptions options, std::uint32_t bug) {
  options.estimator.plantedBug = bug;
  return options;
}

std::string nameOf(const MomentOptions& options) {
  return options.estimator.deltaTracking ? "delta tracking" : render::methodName(options.estimator.method);
}

film::SampleSummary Moments::image(int channel) const {
  std::vector<double> values;
  for (const auto& replicate : tileMeans) {
    values.push_back(0.0);
    for (const auto& tile : replicate) {
      values.back() += tile[static_cast<std::size_t>(channel)];
    }
  }
  return film::summarise(values);
}

Moments renderMoments(const scene::Scene& scene, const gpu_scene::VolumeSet& volumes, const MomentOptions& options) {
  gpu_scene::VolumeSet set = volumes;
  set.uses.resize(scene.media.size());
  const gpu_scene::GpuScene gpuScene(probeDevice(), scene, set, render::layoutOf(options.estimator.method));
  const std::unique_ptr<render::Estimator> estimator =
      render::makeEstimator(probeDevice(), gpuScene, set, options.estimator);
  const std::vector<std::uint32_t> pixels = pixelsOf(scene.film.size, options.skip);
  Moments result;
  result.size = scene.film.size;
  result.replicates = options.replicates * effort();
  result.pixels.resize(std::size_t(scene.film.size.x) * scene.film.size.y);
  // Welford's running moments: the values of all replicates would not fit for big pictures.
  for (std::uint32_t replicate = 0; replicate < result.replicates; ++replicate) {
    const auto means = renderReplicate(*estimator, pixels, options.samples, options.firstSeed + replicate);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      for (std::size_t channel = 0; channel < 4; ++channel) {
        film::SampleSummary& summary =
            result.pixels[(pixels[i] & 0xffffu) + scene.film.size.x * (pixels[i] >> 16)][channel];
        const double delta = means[i][channel] - summary.mean;
        summary.count += 1.0;
        summary.mean += delta / summary.count;
        summary.variance += delta * (means[i][channel] - summary.mean);
      }
    }
    result.tileMeans.push_back(tileMeans(scene.film.size, pixels, means));
  }
  for (auto& pixel : result.pixels) {
    for (film::SampleSummary& summary : pixel) {
      summary.variance /= std::max(1.0, summary.count - 1.0);
    }
  }
  result.totals = estimator->totals();
  reportMessages();
  if (options.estimator.plantedBug == interop::kBugNone) {
    EXPECT_EQ(result.totals.nonFinite, 0u);
    EXPECT_EQ(result.totals.majorantExceeded, 0u);
    EXPECT_EQ(result.totals.cut, 0u);
  }
  return result;
}

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
  verdict.familyP = differenceP(image.mean - reference, tolerance * std::abs(reference), standardErrorOf(image),
                                image.count - 1.0, verdict.worstT);
  verdict.bias = (image.mean - reference) / reference;
  verdict.resolution = standardErrorOf(image) / std::abs(reference);
  return verdict;
}

film::SampleSummary Moments::tile(std::size_t tile, int channel) const {
  std::vector<double> values;
  for (const auto& replicate : tileMeans) {
    values.push_back(replicate[tile][static_cast<std::size_t>(channel)]);
  }
  return film::summarise(values);
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

} // namespace tyndall::test
