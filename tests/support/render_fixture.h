// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/film.h"
#include "verify/verdict.h"

#include <string>
#include <vector>

/// Pictures as statistics under GoogleTest, on the process's one device.
namespace tyndall::test {

using namespace verify;

/// How much longer than in the fast suite tests may take: the environment's TYNDALL_TEST_EFFORT, 1 without it.
/// Multiplies the replicates of renderMoments, so that errors shrink by its root.
std::uint32_t effort();

/// `options` for every method: as they are for the tracking, with a quarter of the replicates (8 at least) for the
/// march, whose pictures vary far less.
std::vector<MomentOptions> eachMethod(const MomentOptions& options = {});
/// The same with both trackers of the tracking: weighted walk and delta tracking.
std::vector<MomentOptions> eachTracker(const MomentOptions& options = {});
MomentOptions withBug(MomentOptions options, std::uint32_t bug);
/// "march", "tracking" or "delta tracking".
std::string nameOf(const MomentOptions& options);
inline bool marches(const MomentOptions& options) { return options.estimator.method == render::Method::March; }

/// The moments of verify::renderMoments, with effort() times the replicates. Validation messages, samples that are not
/// finite and lookups above their majorant are test failures, the latter two only without a planted bug.
Moments renderMoments(const scene::Scene& scene, const gpu_scene::VolumeSet& volumes = {},
                      const MomentOptions& options = {});

} // namespace tyndall::test

#define EXPECT_AGREES(verdict) EXPECT_TRUE((verdict).agrees()) << (verdict).text()
#define EXPECT_DIFFERS(verdict) EXPECT_FALSE((verdict).agrees()) << "the planted bug was not seen: " << (verdict).text()
