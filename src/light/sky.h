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

/// Single scattering by air and haze in an exponential atmosphere with ozone over a spherical earth, and a Lambertian
/// ground lit by sun and sky and seen through the air. The viewer stands 200 m above the ground.
/// @param sunDirection the way the sun's light travels; need not be unit. Its irradiance above the atmosphere is 1 in
/// each channel. The sun may be below the horizon.
/// @param turbidity 1 (pure air) to 10 (haze). @param size >= 1 x 2.
SkyMap makeSky(const glm::dvec3& sunDirection, double turbidity, const glm::dvec3& groundAlbedo,
               const glm::uvec2& size);

} // namespace tyndall::light
