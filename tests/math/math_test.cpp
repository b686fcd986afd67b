// SPDX-License-Identifier: Apache-2.0
#include "math/bounds.h"
#include "math/colour.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace tyndall {
namespace {

TEST(Bounds, EmptyUntilExtended) {
  Bounds3 bounds;
  EXPECT_TRUE(bounds.empty());
  bounds.extend(Bounds3{});
  EXPECT_TRUE(bounds.empty());
  bounds.extend(glm::dvec3(1.0, 2.0, 3.0));
  EXPECT_FALSE(bounds.empty());
  EXPECT_EQ(bounds.size(), glm::dvec3(0.0));
}

TEST(Bounds, TransformedBoxHoldsEveryCorner) {
  const Bounds3 box{glm::dvec3(-1.0, 0.0, 2.0), glm::dvec3(1.0, 3.0, 4.0)};
  const glm::dmat4 map =
      glm::rotate(glm::translate(glm::dmat4(1.0), {5.0, 6.0, 7.0}), 0.7, glm::normalize(glm::dvec3(1.0, 2.0, 3.0)));
  const Bounds3 around = transformed(map, box);
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner(map * glm::dvec4(box.corner(i), 1.0));
    EXPECT_TRUE(glm::all(glm::lessThanEqual(around.min, corner)) &&
                glm::all(glm::greaterThanEqual(around.max, corner)));
  }
  EXPECT_TRUE(transformed(map, Bounds3{}).empty());
}

TEST(Colour, WhiteOfD65IsNeutral) {
  const glm::dvec3 white = rec709FromXyz({0.95047, 1.0, 1.08883});
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(white[i], 1.0, 1e-4);
  }
  EXPECT_NEAR(luminance(glm::dvec3(1.0)), 1.0, 1e-12);
}

TEST(Colour, SrgbCurveIsContinuousAndFixed) {
  EXPECT_EQ(srgbFromLinear(0.0), 0.0);
  EXPECT_NEAR(srgbFromLinear(1.0), 1.0, 1e-12);
  EXPECT_NEAR(srgbFromLinear(0.0031308), srgbFromLinear(0.0031309), 1e-5);
  EXPECT_NEAR(srgbFromLinear(0.2140), 0.5, 1e-3); // mid grey of the standard
}

} // namespace
} // namespace tyndall
