// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

namespace tyndall::light {

/// Parameters of shaders/phase/mie.glsl for water droplets: (g of Henyey-Greenstein, g of Draine, alpha of Draine,
/// weight of Draine). @param diameterMicrometres in [5, 50], the range of the fit.
/// @throws Error outside. @see [Jendersie23] the fit for large droplets
glm::vec4 mieParameters(double diameterMicrometres);

} // namespace tyndall::light
