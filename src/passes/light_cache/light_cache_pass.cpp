// SPDX-License-Identifier: Apache-2.0
#include "passes/light_cache/light_cache_pass.h"

#include "kernels/light_cache.h"

namespace tyndall::passes {

LightCachePass::LightCachePass(const gpu::Device& device) : kernel_(device, k_light_cache_spirv, {}) {}

} // namespace tyndall::passes
