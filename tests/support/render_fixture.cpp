// SPDX-License-Identifier: Apache-2.0
#include "support/render_fixture.h"

#include "support/probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace tyndall::test {
namespace {

void reportMessages() {
  static std::size_t reported = 0;
  const std::vector<std::string>& messages = probeDevice().messages();
  for (; reported < messages.size(); ++reported) {
    ADD_FAILURE() << "validation: " << messages[reported];
  }
}

} // namespace

std::uint32_t effort() {
  const char* text = std::getenv("TYNDALL_TEST_EFFORT");
  return text == nullptr ? 1u : std::max(1u, static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10)));
}

std::vector<MomentOptions> eachMethod(const MomentOptions& options) {
  MomentOptions march = options;
  march.estimator.method = render::Method::March;
  march.replicates = std::max(8u, options.replicates / 4);
  return {options, march};
}

std::vector<MomentOptions> eachTracker(const MomentOptions& options) {
  std::vector<MomentOptions> result = eachMethod(options);
  MomentOptions delta = options;
  delta.estimator.deltaTracking = true;
  result.push_back(delta);
  return result;
}

MomentOptions withBug(MomentOptions options, std::uint32_t bug) {
  options.estimator.plantedBug = bug;
  return options;
}

std::string nameOf(const MomentOptions& options) {
  return options.estimator.deltaTracking ? "delta tracking" : render::methodName(options.estimator.method);
}

Moments renderMoments(const scene::Scene& scene, const gpu_scene::VolumeSet& volumes, const MomentOptions& options) {
  MomentOptions longer = options;
  longer.replicates *= effort();
  const Moments result = verify::renderMoments(probeDevice(), scene, volumes, longer);
  reportMessages();
  if (options.estimator.plantedBug == interop::kBugNone) {
    EXPECT_EQ(result.totals.nonFinite, 0u);
    EXPECT_EQ(result.totals.majorantExceeded, 0u);
    EXPECT_EQ(result.totals.cut, 0u);
  }
  return result;
}

} // namespace tyndall::test
