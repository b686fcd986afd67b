// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <filesystem>
#include <vector>

namespace tyndall::volume {

/// Dense fields over the voxels [indexMin, indexMin + size), x fastest. A field may be missing (empty).
struct GeneratedVolume {
  glm::ivec3 size{0};
  glm::ivec3 indexMin{0};
  double voxelSize = 1.0;                ///< metres; voxel centres at index * voxelSize
  std::vector<float> density;            ///< 0 to 1, dimensionless
  std::vector<float> temperature;        ///< kelvin, 0 outside the flame
  std::vector<glm::vec3> velocity;       ///< metres per second

  std::size_t voxelCount() const { return std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z); }
};

/// A rising smoke plume, about 2 m tall, standing on y = 0: density and velocity.
GeneratedVolume makePlume();
/// A cumulus with a flat base at y = 0, about 2 km across: density, constant in its core.
GeneratedVolume makeCloud();
/// A flame, about 1 m tall, standing on y = 0: density (soot), temperature and velocity.
GeneratedVolume makeFlame();

/// Writes the fields that are there as half-stored OpenVDB grids "density", "temperature" and "velocity"; zeros are
/// left out and constant 8^3 blocks become tiles. The same volume gives the same grids.
/// @throws Error if the file cannot be written.
void writeVolume(const std::filesystem::path& path, const GeneratedVolume& volume);

/// Radius of the ball that writeBall makes, as a share of its index space's edge.
inline constexpr double kBallRadius = 0.1;

/// Mean density of the ball along a diameter: 1 in its centre, 1/2 at its rim, quadratic between.
inline constexpr double kBallMeanDensity = 5.0 / 6.0;

/// Writes a grid "density" in [0, edge)^3 of index space, which is a cube of edge 1 about the origin of the world: a ball
/// in its middle, without tiles, so that 0.42 % of the voxels are stored whatever the edge. Needs no dense field.
/// @throws Error if the file cannot be written.
void writeBall(const std::filesystem::path& path, int edge);

} // namespace tyndall::volume
