// SPDX-License-Identifier: Apache-2.0
#include "film/tone.h"

#include "math/colour.h"

#include <algorithm>
#include <cmath>

namespace tyndall::film {
namespace {

constexpr double kMiddleGrey = 0.18;
constexpr double kWhite = 16.0;               // scene-linear value that reaches display white: 6.5 stops over grey
constexpr double kHalfWhitened = 16.0;        // brightest channel at which a colour is mixed half with white
constexpr double kClippedShare = 0.004;       // kept below the 0.5 % that a picture may clip
constexpr double kLitShareOfBrightest = 1e-3; // dimmer pixels are background to the exposure
constexpr double kExposureMargin = 1e-6;      // stops; keeps the brightest kept pixel from rounding above 1

// With y = g x and W = g kWhite, f = y (1 + y / W^2) / (1 + y); f(grey) = grey is linear in g because
// y^2 / W^2 = (grey / kWhite)^2.
constexpr double kFilmicGain =
    (1.0 - kMiddleGrey / (kWhite * kWhite)) / (1.0 - kMiddleGrey);

double largest(const glm::dvec3& colour) { return std::max({colour.r, colour.g, colour.b}); }

bool finite(const glm::dvec3& colour) {
  return std::isfinite(colour.r) && std::isfinite(colour.g) && std::isfinite(colour.b);
}

} // namespace

double filmic(double linear) {
  const double y = kFilmicGain * linear;
  const double white = kFilmicGain * kWhite;
  return y * (1.0 + y / (white * white)) / (1.0 + y);
}

glm::dvec3 displayColour(const glm::dvec3& linear, View view) {
  const glm::dvec3 colour = glm::max(linear, glm::dvec3(0.0));
  const double peak = largest(colour);
  if (view == View::Standard || peak == 0.0) {
    return colour;
  }
  if (!std::isfinite(peak)) {
    return glm::dvec3(peak);
  }
  const double whiteness = peak * peak / (peak * peak + kHalfWhitened * kHalfWhitened);
  return filmic(peak) * glm::mix(colour / peak, glm::dvec3(1.0), whiteness);
}

CompositedPixels::CompositedPixels(const Image& image, const std::string& name) : colour_(colourChannels(image, name)) {
  background_ = {findChannel(image, "background.R"), findChannel(image, "background.G"),
                 findChannel(image, "background.B")};
}

glm::dvec3 CompositedPixels::operator[](std::size_t pixel) const {
  glm::dvec3 colour;
  for (int channel = 0; channel < 3; ++channel) {
    const std::vector<float>* background = background_[channel];
    colour[channel] = double((*colour_[channel])[pixel]) + (background == nullptr ? 0.0 : double((*background)[pixel]));
  }
  return colour;
}

double autoExposure(const Image& image) {
  const CompositedPixels pixels(image, "picture");
  std::vector<double> peaks;
  std::vector<double> luminances;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const glm::dvec3 colour = pixels[i];
    if (finite(colour)) {
      peaks.push_back(largest(colour));
      luminances.push_back(luminance(colour));
    }
  }
  if (peaks.empty()) {
    return 0.0;
  }
  // At most this many pixels lie above the chosen peak.
  const auto above = static_cast<std::ptrdiff_t>(kClippedShare * double(peaks.size()));
  const auto kept = peaks.end() - 1 - above;
  std::nth_element(peaks.begin(), kept, peaks.end());
  const double peak = *kept > 0.0 ? *kept : *std::max_element(kept, peaks.end());
  if (!(peak > 0.0)) {
    return 0.0;
  }
  double logSum = 0.0;
  std::size_t lit = 0;
  for (const double value : luminances) {
    if (value > kLitShareOfBrightest * peak) {
      logSum += std::log2(value);
      ++lit;
    }
  }
  const double toWhite = -std::log2(peak) - kExposureMargin;
  const double toGrey = lit > 0 ? std::log2(kMiddleGrey) - logSum / double(lit) : toWhite;
  return std::min(toWhite, toGrey);
}

} // namespace tyndall::film
