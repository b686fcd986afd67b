// SPDX-License-Identifier: Apache-2.0
#include "bench/cost.h"

#include <chrono>
#include <ctime>

namespace tyndall::bench {

Cost costOf(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t cpuStart = std::clock();
  work();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
          double(std::clock() - cpuStart) / CLOCKS_PER_SEC};
}

double secondsOf(const Cost& cost, const gpu::Device& device) {
  return device.info().type == "cpu" ? cost.cpu : cost.wall;
}

} // namespace tyndall::bench
