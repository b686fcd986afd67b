// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "light/atmosphere.h"

#include <vector>

namespace tyndall::light {

/// Mean radiance of all light scattered or reflected at least once, over the sun's altitude and the height, as in
/// [Hillaire20] "A Scalable and Production Ready Sky and Atmosphere Rendering Technique" section 5.5: the light of
/// the first event, scattered isotropically, times the geometric series of the later ones, each of which is taken to
/// find the same light all around. Times the local scattering coefficient it is the source of all orders from the
/// second on. Unlike there, the series includes the ground's reflection.
class MultipleScattering {
public:
  /// @param groundAlbedo 0 to 1 per wavelength.
  MultipleScattering(const Atmosphere& atmosphere, const SkySpectrum& groundAlbedo);

  /// Radiance for a sun of irradiance 1 above the atmosphere [1/sr]. @param muSun cosine of the sun's zenith angle.
  SkySpectrum at(double radius, double muSun) const;

private:
  struct Ray;

  const Atmosphere& atmosphere_;
  SkySpectrum groundAlbedo_;
  std::vector<SkySpectrum> table_; ///< the sun's altitude fastest

  void fillHeight(unsigned row);
  std::vector<Ray> raysFrom(double radius) const;
  SkySpectrum returned(const Ray& ray) const;
  SkySpectrum firstEvent(const Ray& ray, double radius, double muSun) const;
};

} // namespace tyndall::light
