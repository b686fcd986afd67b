// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"

#include <functional>

namespace tyndall::bench {

/// Wall and process time [s]. On a CPU device and a busy machine the second one is the repeatable figure.
struct Cost {
  double wall = 0.0;
  double cpu = 0.0;
};
Cost costOf(const std::function<void()>& work);

/// What a figure's seconds are: process time on a CPU device, else wall time.
double secondsOf(const Cost& cost, const gpu::Device& device);

} // namespace tyndall::bench
