// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

namespace tyndall {

/// Luminance of linear Rec.709 (D65).
inline double luminance(const glm::dvec3& rgb) { return glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722)); }

/// Linear Rec.709 from CIE 1931 XYZ (IEC 61966-2-1 primaries, D65). May be negative outside the gamut.
glm::dvec3 rec709FromXyz(const glm::dvec3& xyz);

/// sRGB transfer function (IEC 61966-2-1), [0, 1] -> [0, 1].
double srgbFromLinear(double linear);

} // namespace tyndall
