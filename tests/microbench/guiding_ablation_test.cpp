// SPDX-License-Identifier: Apache-2.0
#include "microbench/guiding_ablation.h"
#include "interop/guide.h"
#include "scene/load.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace tyndall::microbench {
namespace {

constexpr const char* kScene = R"({
  "render": { "integrator": "mcpg" },
  "lights": [{ "type": "sun", "direction": [0, -1, 0], "irradiance": 3 }],
  "objects": [{ "type": "sphere", "centre": [0, 0, 0], "radius": 1 }]
})";

scene::LoadResult sceneWith(const std::vector<scene::Override>& overrides) {
  const scene::LoadResult result = scene::parseScene(kScene, "test.json", "", overrides);
  for (const scene::Problem& problem : result.problems) {
    ADD_FAILURE() << problem.message;
  }
  return result;
}

TEST(Ablation, EveryVariationIsAllowedAndNoTwoAreTheSameNorTheDefault) {
  std::set<std::string> scenes{sceneWith({}).canonical};
  for (const Variation& variation : guideVariations()) {
    const scene::LoadResult result = sceneWith({{variation.path, variation.value}});
    const bool isNew = scenes.insert(result.canonical).second;
    EXPECT_TRUE(isNew) << variation.path << '=' << variation.value << " changes nothing";
    EXPECT_LE(result.scene.guide.loads * result.scene.guide.states, interop::kMostLobes) << variation.path;
  }
}

} // namespace
} // namespace tyndall::microbench
