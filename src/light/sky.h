// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace tyndall::light {

/// A clear sky as a lat-long map: top row +y, middle column -z.
struct SkyMap {
  glm::uvec2 size{0};
  std::vector<glm::vec3> radiance;      ///< [W/(m2 sr)], size.x * size.y; without the sun's disc
  glm::dvec3 sunTransmittance{0.0};     ///< fraction of the sun's irradiance that reaches the viewer, per channel
};

/// The sky of air, haze and ozone with fixed profiles over a spherical earth, and a Lambertian ground lit by sun and
/// sky and seen through the air. The viewer stands 200 m above the ground. Computed at the wavelengths of
/// SkySpectrum; channels are linear Rec.709 with white = the sun above the atmosphere, negative ones set to 0.
/// Single scattering is integrated along each row's rays; all later orders together are the isotropic approximation
/// of [Hillaire20] (sky_multiple.h). Its limits, against path tracing with the true phase functions for suns at 2 to
/// 60 degrees: at turbidity 2 and 3 each channel of the irradiance on level ground is 12 % too low (low sun, blue) to
/// 18 % too high (high sun, red), the zenith up to 40 % too bright in red, and the horizon across a low sun up to a
/// third too dark in blue. At turbidity 6 a low sun's sky lacks a fifth of its irradiance, and half of the horizon's
/// blue. Distant ground is lit by the sky as seen from the viewer. No polarisation, refraction, night sky or clouds.
/// @param sunDirection the way the sun's light travels; need not be unit. Its irradiance above the atmosphere is 1 in
/// each channel. The sun may be below the horizon.
/// @param turbidity 1 (pure air) to 10 (haze). @param groundAlbedo 0 to 1. @param size >= 1 x 2.
SkyMap makeSky(const glm::dvec3& sunDirection, double turbidity, const glm::dvec3& groundAlbedo,
               const glm::uvec2& size);

} // namespace tyndall::light
