// SPDX-License-Identifier: Apache-2.0
#include "light/mie.h"

#include "base/error.h"

#include <gtest/gtest.h>

namespace tyndall::light {
namespace {

TEST(Mie, MeanCosineIsThatOfDroplets) {
  // Mie theory for water in visible light gives 0.83 to 0.88 over this range (Hess et al. 1998, OPAC, water clouds).
  for (double diameter = 5.0; diameter <= 50.0; diameter += 2.5) {
    const glm::dvec4 p(mieParameters(diameter));
    const double normalisation = 1.0 + p.z * (1.0 + 2.0 * p.y * p.y) / 3.0;
    const double draine = p.y * (1.0 + p.z * (3.0 + 2.0 * p.y * p.y) / 5.0) / normalisation;
    const double mean = (1.0 - p.w) * p.x + p.w * draine;
    EXPECT_GT(mean, 0.80) << diameter;
    EXPECT_LT(mean, 0.90) << diameter;
  }
}

TEST(Mie, RefusesDiametersOutsideTheFit) {
  EXPECT_NO_THROW(mieParameters(5.0));
  EXPECT_NO_THROW(mieParameters(50.0));
  for (const double diameter : {4.9, 50.1, 0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(mieParameters(diameter), Error) << diameter;
  }
}

} // namespace
} // namespace tyndall::light
