// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tyndall::bench {

/// What the device reaches with nothing else to do. Per wall second, as render seconds are.
struct BareRates {
  double lookups = 0.0; ///< of densities, along camera rays through a cloud
  double rays = 0.0;    ///< cast against a box: half of them to the closest hit, half to any

  /// Of `seconds`, those that so many lookups and rays would take at these rates.
  double share(double lookupCount, double rayCount, double seconds) const {
    return (lookupCount / lookups + rayCount / rays) / seconds;
  }
};

} // namespace tyndall::bench
