// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/measure.h"
#include "bench/skip.h"
#include "gpu/device.h"

namespace tyndall::bench {

/// Renders scenes of its own without and with each feature that they do not need, in this process.
/// @param repeats timed rounds, each with a seed of its own, at least 4. @param device without cached shaders, which
/// would hide what compiling takes
SkipTable measureSkip(const gpu::Device& device, std::uint32_t repeats, const Say& say);

} // namespace tyndall::bench
