// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/exr.h"

namespace tyndall::film {

/// How scene-linear colour becomes display-linear colour.
enum class View {
  Standard,  ///< as it is; what exceeds 1 is cut off
  Filmic     ///< highlights rolled off towards white, see filmic()
};

/// Linear display value of the brightest channel: extended Reinhard [Reinhard02] eq. (4), with the gain that keeps
/// middle grey: 0 -> 0, 0.18 -> 0.18, 16 -> 1, strictly rising.
double filmic(double linear);

/// Display-linear colour, not yet cut to [0, 1]; negative channels are taken as 0. Filmic applies filmic() to the
/// brightest channel, keeps the ratios of the others (so the hue), and mixes strong light towards white of the same
/// peak. Each channel rises with exposure.
glm::dvec3 displayColour(const glm::dvec3& linear, View view);

/// R, G, B over the layer `background` where the image has one. Scene-linear.
class CompositedPixels {
public:
  /// @throws Error, beginning with `name`, if there is no colour. Keeps references into `image`.
  CompositedPixels(const Image& image, const std::string& name);
  std::size_t size() const { return colour_[0]->size(); }
  glm::dvec3 operator[](std::size_t pixel) const;

private:
  std::array<const std::vector<float>*, 3> colour_{};
  std::array<const std::vector<float>*, 3> background_{};  ///< null: none
};

/// Stops that put the log-average of the lit part of the picture at middle grey, or less where more than 0.4 % of the
/// pixels would exceed 1. Non-finite and black pixels have no say; 0 for a picture without light.
double autoExposure(const Image& image);

} // namespace tyndall::film
