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

} // namespace tyndall::volume
