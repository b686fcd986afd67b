// SPDX-License-Identifier: Apache-2.0
#include "support/render_scenes.h"

#include <random>

namespace tyndall::test {

volume::BrickGrid spikyGrid(const glm::ivec3& size, unsigned seed, volume::Storage storage,
                            const glm::dmat4& worldFromIndex) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto value = [&](const glm::ivec3& index) {
    const double u = uniform(random);
    const double v = uniform(random);
    const glm::ivec3 inside = index & 7;
    const bool border = inside.x == 0 || inside.y == 0 || inside.z == 0;
    // Spikes where a brick's support has its last layer: one brick's own voxels, two bricks' lookups.
    if (u < (border ? 0.05 : 0.005)) {
      return 1.0 + v;
    }
    return ((index.x >> 3) + (index.y >> 3) + (index.z >> 3)) % 2 == 0 ? 0.0 : 0.05 * v;
  };
  return gridOf(size, glm::ivec3(-5, 3, -17), worldFromIndex, value, storage);
}

} // namespace tyndall::test
