// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/kernel.h"
#include "passes/light_cache/light_cache_io.h"

namespace tyndall::passes {

/// Fills columns of a light cache; light_cache_io.h is the contract.
class LightCachePass {
public:
  explicit LightCachePass(const gpu::Device& device);

  /// Builds `inputs.columnCount` columns and waits.
  void run(const interop::LightCacheInputs& inputs) const { kernel_.run(inputs, inputs.columnCount); }

private:
  gpu::Kernel kernel_;
};

} // namespace tyndall::passes
