// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/kernel.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace tyndall::gpu {

/// The module with the values of its specialization constants written in, and without the code that they switch off. A
/// driver would do the same, in its own time: on a CPU device that is most of a start.
/// @throws Error if SPIRV-Tools' optimiser, which does it, does not take the module.
std::vector<std::uint32_t> specialise(std::span<const std::uint32_t> words, std::span<const SpecEntry> spec);

/// The same, from a file in `folder` if the work has been done before; else it is kept there. What cannot be read or
/// written costs time and nothing else.
/// @param folder empty: nothing is kept
std::vector<std::uint32_t> specialiseOnce(std::span<const std::uint32_t> words, std::span<const SpecEntry> spec,
                                          const std::filesystem::path& folder);

/// Modules that a folder keeps at most; the ones that were written first give way.
inline constexpr std::size_t kKeptModules = 200;

} // namespace tyndall::gpu
