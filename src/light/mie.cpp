// SPDX-License-Identifier: Apache-2.0
#include "light/mie.h"

#include "base/error.h"

#include <cmath>

namespace tyndall::light {

glm::vec4 mieParameters(double diameterMicrometres) {
  const double d = diameterMicrometres;
  if (!(d >= 5.0 && d <= 50.0)) {
    fail("mie phase function: a droplet diameter of {} micrometres is outside the fit; use 5 to 50, "
         "or henyey-greenstein for other particles", d);
  }
  return glm::vec4(glm::dvec4(std::exp(-0.0990567 / (d - 1.67154)),
                              std::exp(-2.20679 / (d + 3.91029) - 0.428934),
                              std::exp(3.62489 - 8.29288 / (d + 5.52825)),
                              std::exp(-0.599085 / (d - 0.641583) - 0.665888)));
}

} // namespace tyndall::light
