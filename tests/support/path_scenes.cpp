// SPDX-License-Identifier: Apache-2.0
#include "support/path_scenes.h"

namespace tyndall::test {

MomentOptions byPaths(MomentOptions options) {
  options.estimator.method = render::Method::Path;
  return options;
}

std::vector<MomentOptions> eachTechnique(const MomentOptions& options) {
  std::vector<MomentOptions> result;
  for (const std::uint32_t techniques : {interop::kTechniqueLight, interop::kTechniqueDirection,
                                         interop::kTechniqueLight | interop::kTechniqueDirection}) {
    result.push_back(byPaths(options));
    result.back().estimator.techniques = techniques;
  }
  return result;
}

std::string techniqueOf(const MomentOptions& options) {
  const char* const techniques[] = {"none", "light", "direction", "both"};
  const char* const selections[] = {"tree", "power", "uniform"};
  return std::string(techniques[options.estimator.techniques]) + ", selected by " +
         selections[options.estimator.lightSelection];
}

} // namespace tyndall::test
