// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/auto_scene.h"

namespace tyndall::scene {

/// One frame's medium as a camera ray sees it.
struct VisibleVolume {
  const volume::BrickGrid* density = nullptr;     ///< null: none
  const volume::BrickGrid* temperature = nullptr; ///< null: none
  glm::dmat4 worldFromMedium{1.0};
  double densityScale = 1.0;
  std::vector<double> glow;                       ///< glowTable(); empty without temperature
};

/// Luminance of a blackbody at `kelvinScale` * value, for values evenly spaced from 0 to `maximum`.
std::vector<double> glowTable(double kelvinScale, double maximum);

/// The luminance that the temperature grid adds to a ray from `origin` at an emission scale of 1, dimmed by the density
/// before it; by samples a voxel apart. `direction` is unit.
double glowAlong(const VisibleVolume& volume, const glm::dvec3& origin, const glm::dvec3& direction);

struct FramingInput {
  std::vector<VisibleVolume> frames;
  glm::dvec3 toCamera{0.0, 0.0, 1.0};  ///< unit, from the subject
  glm::uvec2 size{640, 480};
};

/// Share of the picture's shorter side that the subject's longer extent is to take.
inline constexpr double kFramedShare = 0.8;

/// A perspective camera in direction `toCamera` whose picture shows what can be seen of all frames in its middle:
/// where opacity is above 5 % or the glow above 5 % of the strongest one. nullopt if there is nothing to see.
std::optional<Camera> frameSubject(const FramingInput& input);

} // namespace tyndall::scene
