// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace tyndall::light {

/// Kelvin. A temperature grid whose maximum is below the first cannot be in kelvin that glow; its maximum is then taken
/// as the second.
inline constexpr double kColdestGlow = 500.0;
inline constexpr double kMappedMaximum = 2000.0;

/// Planck's law [W/(m2 sr m)] at a wavelength in metres; 0 for kelvin <= 0.
double planckRadiance(double wavelength, double kelvin);

/// CIE 1931 XYZ of a blackbody's radiance [W/(m2 sr)]: the integral of Planck's law times each colour-matching
/// function. Without the factor 683 lm/W: luminance 1 is what a light of radiance 1 at 555 nm has.
glm::dvec3 blackbodyXyz(double kelvin);

/// The same in linear Rec.709, all channels >= 0. Below about 1900 K the colour is outside the gamut: it is
/// desaturated towards grey at constant luminance until its lowest channel is 0, so that energy is kept.
glm::dvec3 blackbodyRadiance(double kelvin);

/// The table that shaders/light/blackbody.glsl reads, laid out as interop/blackbody.h says.
std::vector<glm::vec3> blackbodyTable();

} // namespace tyndall::light
