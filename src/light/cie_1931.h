// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <array>

namespace tyndall::light {

inline constexpr double kCieFirstNanometres = 360.0;
inline constexpr double kCieStepNanometres = 5.0;

/// CIE 1931 2-degree colour-matching functions (xbar, ybar, zbar) from 360 to 830 nm in steps of 5 nm.
/// @see CIE 018:2019 "The Basis of Physical Photometry", ISO/CIE 11664-1:2019 table 1
extern const std::array<glm::dvec3, 95> kCie1931;

} // namespace tyndall::light
