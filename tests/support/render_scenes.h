// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verify/test_scene.h"

/// Scenes, references and verdicts are those of `tyndall verify`; here is what tests alone need.
namespace tyndall::test {

using namespace verify;

/// Random voxels: a few spikes among small values and empty regions. The same for the same seed.
volume::BrickGrid spikyGrid(const glm::ivec3& size, unsigned seed, volume::Storage storage,
                            const glm::dmat4& worldFromIndex);

} // namespace tyndall::test
