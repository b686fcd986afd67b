// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace tyndall::microbench {

/// One setting of the guide, changed alone.
struct Variation {
  const char* path;  ///< in the scene file
  const char* value; ///< JSON
};

/// Of integrator `mcpg`: to both sides of what it has, where there are two.
std::span<const Variation> guideVariations();

} // namespace tyndall::microbench
