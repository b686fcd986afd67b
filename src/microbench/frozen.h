// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/kernel.h"

#include <cstdint>
#include <span>
#include <vector>

namespace tyndall::microbench {

/// The module as a build would give it in which every specialization constant were a plain one: constants folded,
/// branches that cannot be taken and functions that nothing calls removed, names stripped. Nothing is inlined.
/// Empty where the program was built without SPIRV-Tools' optimiser.
std::vector<std::uint32_t> frozenModule(std::span<const std::uint32_t> module, std::span<const gpu::SpecEntry> spec);

} // namespace tyndall::microbench
