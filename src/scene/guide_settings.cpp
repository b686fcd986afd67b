// SPDX-License-Identifier: Apache-2.0
#include "scene/guide_settings.h"

#include "scene/field_names.h"

namespace tyndall::scene {

namespace {

void setMcpg(GuideSettings& settings) {
  settings.cells.angle = 0.1; // cells must fill before a picture of some hundred samples is done
  settings.mostShare = 0.95;  // 1 / share compounds over the events of a path
}

void setScreenChains(GuideSettings& settings) {
  settings.fit = false;
  settings.loads = 6; // the pixel's own state and five of its neighbours
  settings.states = 1;
  settings.staticGrid = false;
  settings.learnShare = false;
  settings.weight = GuideWeight::Accepted;
  settings.watch = false;
  settings.priorRadius = 0.0; // the published prior does not know the distance
  settings.priorLeast = 0.2;
  settings.mostKappa = 1e6;
  settings.scatterShare = 0.15;
  settings.roundSamples = 8;
  settings.records = 1;
}

void setPaper(GuideSettings& settings) {
  // The published settings; a unit of the game that they were made in is taken for a thousandth of the diagonal.
  settings.fit = false;
  settings.score = GuideScore::Cache;
  settings.loads = 5;
  settings.states = 1;
  settings.normals = true;
  settings.learnShare = false;
  settings.watch = false;
  settings.weight = GuideWeight::Forgets;
  settings.cells = {.angle = 0.004, .finest = 0.01, .ratio = 1.7320508, .spread = 1.0};
  settings.radiance = {.angle = 0.01, .finest = 0.01, .ratio = 1.1224621, .spread = 0.0};
  settings.staticWidth = 25.3;
  settings.priorRadius = 0.5477226; // its square is 0.3
  settings.mostKappa = 1e6;
  settings.scatterShare = 0.15;
  settings.forgetBelow = 0.05;
  settings.forgetRate = 1.0;
  settings.window = 1;
  settings.distanceSigma = 1.0;
}

} // namespace

GuideSettings guideSettings(Integrator integrator) {
  GuideSettings settings;
  settings.preset = integrator;
  if (integrator == Integrator::McpgPaper) {
    setPaper(settings);
  } else if (integrator == Integrator::ScreenChains) {
    setScreenChains(settings);
  } else {
    setMcpg(settings);
  }
  return settings;
}

bool guidesDistances(const GuideSettings& settings) {
  return settings.distanceShare > 0.0 && settings.preset != Integrator::Path &&
         settings.preset != Integrator::ScreenChains;
}

const char* integratorName(Integrator integrator) {
  for (const auto& [name, value] : kIntegrators) {
    if (value == integrator) {
      return name.data();
    }
  }
  return "";
}

} // namespace tyndall::scene
