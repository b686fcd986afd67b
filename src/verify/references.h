// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verify/test_scene.h"

#include <vector>

/// Scenes whose radiance is known in closed form or by a table: A1, A2, A5, A6 of docs/theory.md.
namespace tyndall::verify {

/// A1: a point light of 1 W/sr at (h, 0, d) in fog from z = 0 to tMax, seen from the origin along +z. The radiance of
/// that ray at 12 digits, by quadrature.
struct AirlightRow {
  double sigmaT, albedo, g, d, h, tMax, radiance;
};
inline constexpr AirlightRow kAirlightRows[] = {
    {0.1, 0.9, 0.0, 5.0, 1.0, 20.0, 0.0103598185685},     {0.1, 0.9, 0.7, 5.0, 1.0, 20.0, 0.0153156256823},
    {0.1, 0.9, -0.5, 5.0, 1.0, 20.0, 0.0107792022829},    {1.0, 0.5, 0.3, 2.0, 0.1, 10.0, 0.165747502219},
    {1.0, 0.5, 0.3, 2.0, 0.001, 10.0, 18.9658564515},     {0.01, 1.0, 0.9, 100.0, 3.0, 1000.0, 0.00142365682824},
    {5.0, 0.99, 0.0, 0.5, 0.05, 4.0, 1.32831277621},      {0.0001, 1.0, 0.0, 10.0, 0.5, 100.0, 4.90580330352e-5},
    {0.25, 0.8, 0.85, 3.0, 2.0, 1000.0, 0.00148568044267}};
/// By default the footprint of every pixel is the axis itself: 1e-6 degrees.
TestScene airlight(const AirlightRow& row, double verticalFov = 1e-6);

/// A2: [-1, 1]^3 under a sun of 3 W/m2 that shines down, seen along -z. Its medium is still to be added.
TestScene litBox();
/// Mean over every pixel of a picture of the box where it is homogeneous.
std::vector<double> litBoxReference(const glm::uvec2& size, double sigmaT, double albedo, double irradiance);

/// A5: media of every kind and phase function, one inside the other, that absorb nothing.
void addWhiteMedia(PathScene& test);
/// A closed room around them whose walls shine with 1 and reflect one half: 2 everywhere.
PathScene whiteRoom();

/// A6: radiance that leaves an isotropic half-space at cosine `out`, lit by perpendicular irradiance 1 at cosine `in`;
/// channels have albedos of their own. By H functions, 8 digits.
struct HalfSpace {
  double out, in;
  glm::dvec3 albedo, radiance;
};
inline const HalfSpace kHalfSpaces[] = {{1.0, 1.0, {0.5, 0.8, 0.9}, {0.031147627, 0.081306073, 0.122572307}},
                                        {0.5, 1.0, {0.3, 0.9, 0.99}, {0.019683938, 0.137453331, 0.240084980}},
                                        {1.0, 0.5, {0.5, 0.8, 0.99}, {0.019710875, 0.047931184, 0.120042490}},
                                        {1.0, 1.0, {0.3, 0.9, 0.99}, {0.015156861, 0.122572307, 0.240863393}},
                                        {0.5, 1.0, {0.5, 0.8, 0.9}, {0.039421750, 0.095862368, 0.137453331}},
                                        {1.0, 0.5, {0.3, 0.9, 0.8}, {0.009841969, 0.068726665, 0.047931184}}};
/// 40 mean free paths deep and 2000 wide. As a grid its surface is a ramp of 5, which a half-space does not care for.
PathScene halfSpace(const HalfSpace& row, bool asGrid);

} // namespace tyndall::verify
