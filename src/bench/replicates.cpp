// SPDX-License-Identifier: Apache-2.0
#include "bench/replicates.h"

#include "base/error.h"
#include "film/compare.h"
#include "film/exr.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tyndall::bench {
namespace {

/// Unbiased variance of each value over the pictures.
std::vector<double> variances(const Replicates& pictures, const std::vector<double>& mean) {
  std::vector<double> result(mean.size(), 0.0);
  for (const Picture& picture : pictures) {
    for (std::size_t i = 0; i < mean.size(); ++i) {
      const double off = picture.values[i] - mean[i];
      result[i] += off * off / double(pictures.size() - 1);
    }
  }
  return result;
}

double weighted(const std::vector<double>& weights, const std::vector<double>& values) {
  return std::inner_product(weights.begin(), weights.end(), values.begin(), 0.0);
}

double squaredError(const Picture& picture, const Picture& reference, const std::vector<double>& weights) {
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double off = picture.values[i] - reference.values[i];
    sum += weights[i] * off * off;
  }
  return sum;
}

double spread(const std::vector<double>& values) {
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
  double squares = 0.0;
  for (const double value : values) {
    squares += (value - mean) * (value - mean);
  }
  return std::sqrt(squares / double(values.size() - 1));
}

/// Weighted variance and the jackknife of its logarithm over the pictures.
Figure weightedVariance(const Replicates& pictures, const std::vector<double>& weights) {
  const double count = double(pictures.size());
  const Picture mean = meanOf(pictures);
  const double whole = weighted(weights, variances(pictures, mean.values));
  if (whole <= 0.0 || pictures.size() < 3) {
    return {whole, 0.0};
  }
  std::vector<double> logs;
  for (const Picture& left : pictures) { // without this picture
    const double off = squaredError(left, mean, weights);
    logs.push_back(std::log((whole * (count - 1.0) - off * count / (count - 1.0)) / (count - 2.0)));
  }
  return {whole, (count - 1.0) / std::sqrt(count) * spread(logs)};
}

/// Mean squared error and its standard error over the pictures.
Figure weightedError(const Replicates& pictures, const Reference& reference, const std::vector<double>& weights) {
  std::vector<double> errors;
  for (const Picture& picture : pictures) {
    errors.push_back(squaredError(picture, reference.picture, weights));
  }
  const double mean = std::accumulate(errors.begin(), errors.end(), 0.0) / double(errors.size());
  const bool certain = errors.size() < 2 || mean <= 0.0;
  return {mean, certain ? 0.0 : spread(errors) / std::sqrt(double(errors.size())) / mean};
}

/// Of the pixels that count.
double imageMean(const Picture& picture, const std::vector<bool>& sure) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < picture.values.size(); ++i) {
    const bool counts = sure.empty() || sure[i / 3];
    sum += counts ? picture.values[i] : 0.0;
    count += counts ? 1.0 : 0.0;
  }
  return sum / count;
}

/// Mean and the square of its standard error, of the pictures' means.
std::pair<double, double> meanOfMeans(const Replicates& pictures, const std::vector<bool>& sure) {
  std::vector<double> means;
  for (const Picture& picture : pictures) {
    means.push_back(imageMean(picture, sure));
  }
  const double mean = std::accumulate(means.begin(), means.end(), 0.0) / double(means.size());
  const double scatter = means.size() < 2 ? 0.0 : spread(means);
  return {mean, scatter * scatter / double(means.size())};
}

/// What the noise of a mean adds to its weighted squared error.
double noiseOfMean(const Replicates& pictures, const std::vector<double>& weights) {
  return pictures.size() < 2 ? 0.0 : weightedVariance(pictures, weights).value / double(pictures.size());
}

} // namespace

Picture readPicture(const std::filesystem::path& exr) {
  const film::Image image = film::readExr(exr);
  const auto colour = film::colourChannels(image, exr.string());
  Picture picture{image.window.extent(), {}, {}};
  const std::size_t pixels = image.window.pixelCount();
  picture.values.reserve(3 * pixels);
  picture.covered.reserve(pixels);
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    for (const std::vector<float>* channel : colour) {
      if (!std::isfinite((*channel)[pixel])) {
        fail("{}: pixel {} is not finite; such a picture has no error to measure", exr.string(), pixel);
      }
      picture.values.push_back(double((*channel)[pixel]));
    }
    picture.covered.push_back(film::coveredAt(image, pixel));
  }
  return picture;
}

Picture meanOf(const Replicates& pictures) {
  TYNDALL_CHECK(!pictures.empty());
  Picture mean{pictures.front().size, std::vector<double>(pictures.front().values.size(), 0.0),
               pictures.front().covered};
  for (const Picture& picture : pictures) {
    TYNDALL_CHECK(picture.size == mean.size);
    for (std::size_t i = 0; i < mean.values.size(); ++i) {
      mean.values[i] += picture.values[i] / double(pictures.size());
    }
    std::transform(picture.covered.begin(), picture.covered.end(), mean.covered.begin(), mean.covered.begin(),
                   std::logical_or<>());
  }
  return mean;
}

Reference referenceOf(Picture picture, bool exact, const std::vector<bool>& sure) {
  Reference reference{std::move(picture), exact, sure, {}, {}};
  const Picture& known = reference.picture;
  const std::size_t count = known.values.size();
  const auto counts = [&](std::size_t value) { return sure.empty() || sure[value / 3]; };
  const double eps = film::kRelMseFloor * std::abs(imageMean(known, sure));
  double values = 0.0;
  double covered = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    values += counts(i) ? 1.0 : 0.0;
    covered += counts(i) && known.covered[i / 3] ? known.values[i] * known.values[i] : 0.0;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const double scale = known.values[i] * known.values[i] + eps * eps;
    reference.relMseWeights.push_back(counts(i) && scale > 0.0 ? 1.0 / scale / values : 0.0);
    reference.rRmseWeights.push_back(counts(i) && known.covered[i / 3] && covered > 0.0 ? 1.0 / covered : 0.0);
  }
  return reference;
}

Errors errorsOf(const Replicates& pictures, const Reference& reference) {
  TYNDALL_CHECK(!pictures.empty());
  const auto measure = [&](const std::vector<double>& weights) {
    return reference.exact || pictures.size() < 2 ? weightedError(pictures, reference, weights)
                                                  : weightedVariance(pictures, weights);
  };
  const Figure squared = measure(reference.rRmseWeights);
  return {measure(reference.relMseWeights), {std::sqrt(squared.value), 0.5 * squared.logError}};
}

std::vector<double> errorMap(const Replicates& pictures, const Reference& reference) {
  std::vector<double> squares;
  if (reference.exact || pictures.size() < 2) {
    squares.assign(reference.picture.values.size(), 0.0);
    for (const Picture& picture : pictures) {
      for (std::size_t i = 0; i < squares.size(); ++i) {
        const double off = picture.values[i] - reference.picture.values[i];
        squares[i] += off * off / double(pictures.size());
      }
    }
  } else {
    squares = variances(pictures, meanOf(pictures).values);
  }
  std::vector<double> map(squares.size() / 3, 0.0);
  for (std::size_t i = 0; i < squares.size(); ++i) {
    map[i / 3] += squares[i] * reference.relMseWeights[i] * double(squares.size()) / 3.0;
  }
  std::ranges::transform(map, map.begin(), [](double square) { return std::sqrt(square); });
  return map;
}

Bias biasOf(const Replicates& pictures, const Reference& reference, const Replicates& against) {
  const auto [own, ownError] = meanOfMeans(pictures, reference.sure);
  const auto [other, otherError] = reference.exact ? std::pair(imageMean(reference.picture, reference.sure), 0.0)
                                                   : meanOfMeans(against, reference.sure);
  Bias bias;
  bias.mean = own / other - 1.0;
  bias.meanError = std::sqrt(ownError + otherError) / std::abs(other);
  const Picture mean = meanOf(pictures);
  const auto leftOver = [&](const std::vector<double>& weights, double& noise) {
    noise = noiseOfMean(pictures, weights) + (reference.exact ? 0.0 : noiseOfMean(against, weights));
    return squaredError(mean, reference.picture, weights) - noise;
  };
  double noise = 0.0;
  bias.rRmse = std::sqrt(std::max(leftOver(reference.rRmseWeights, noise), 0.0));
  bias.relMse = leftOver(reference.relMseWeights, noise);
  constexpr double kSure = 4.0;
  bias.found = std::abs(bias.mean) > kSure * bias.meanError || bias.relMse > 0.5 * noise;
  return bias;
}

} // namespace tyndall::bench
