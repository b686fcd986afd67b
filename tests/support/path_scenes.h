// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/render_fixture.h"
#include "support/render_scenes.h"

#include <string>

/// What tests of the pass `path` share.
namespace tyndall::test {

/// `options` by the pass `path`.
MomentOptions byPaths(MomentOptions options = {});
/// The same by light samples alone, by directions alone and by both.
std::vector<MomentOptions> eachTechnique(const MomentOptions& options = {});
/// "light", "direction" or "both", and how light is selected.
std::string techniqueOf(const MomentOptions& options);

} // namespace tyndall::test
