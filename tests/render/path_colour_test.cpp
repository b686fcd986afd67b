// SPDX-License-Identifier: Apache-2.0
// Extinction that differs by channel (docs/theory.md A15): each channel of a picture is that of a grey scene with the
// channel's own coefficients.
#include "support/path_scenes.h"

#include <gtest/gtest.h>

namespace tyndall::test {
namespace {

/// The scene as one of its channels sees it.
PathScene channelOf(PathScene test, int channel) {
  for (scene::Medium& medium : test.scene.media) {
    medium.sigmaT *= medium.extinctionColour[channel];
    medium.densityScale *= medium.extinctionColour[channel];
    medium.extinctionColour = glm::dvec3(1.0);
    medium.albedo = glm::dvec3(medium.albedo[channel]);
  }
  return test;
}

PathScene view() {
  PathScene test({8, 8});
  test.perspective({0.3, 0.4, 4.0}, {0.0, 0.0, 0.0}, 28.0);
  test.sun({0.4, -1.0, -0.3}, 1.0);
  return test;
}

/// A hundredfold contrast.
PathScene ball() {
  PathScene test = view();
  scene::Medium& medium = test.sphere({0.0, 0.0, 0.0}, 1.0, 3.0);
  medium.albedo = {0.95, 0.9, 0.8};
  medium.extinctionColour = {1.0, 0.1, 0.01};
  medium.phase = henyeyGreenstein(0.3);
  return test;
}

/// A grid that one channel does not see, and a glowing box across it that dims the others in another order.
PathScene gridAndBox() {
  PathScene test = view();
  test.constant(0.2);
  scene::Medium& grid = test.grid(puffGrid(), 3.0);
  grid.albedo = {0.9, 0.8, 0.9};
  grid.extinctionColour = {1.0, 0.3, 0.0};
  scene::Medium& box = test.box({-0.8, -0.5, -0.6}, {0.9, 0.2, 0.7}, 1.5);
  box.albedo = {0.9, 0.7, 0.8};
  box.extinctionColour = {0.1, 0.4, 1.0};
  box.emission = scene::Emission{};
  box.emission->scale = 0.1;
  return test;
}

void expectChannelsApart(const PathScene& test, const char* name, bool plant) {
  const MomentOptions options = byPaths({.replicates = 24, .samples = 32});
  const Moments colours = renderMoments(test.scene, test.volumes, options);
  Moments bad;
  if (plant) {
    bad = renderMoments(test.scene, test.volumes, withBug(options, interop::kBugHeroWeight));
  }
  bool seen = false;
  for (int channel = 0; channel < 3; ++channel) {
    const PathScene grey = channelOf(test, channel);
    const MomentOptions other = byPaths({.replicates = 24, .samples = 32, .firstSeed = 1001});
    const Moments reference = renderMoments(grey.scene, grey.volumes, other);
    EXPECT_AGREES(channelTest(colours, channel, reference, 0)) << name << " channel " << channel;
    EXPECT_DIFFERS(channelTest(colours, (channel + 1) % 3, reference, 0)) << name; // planted: another channel
    seen = seen || (plant && !channelTest(bad, channel, reference, 0).agrees());
  }
  EXPECT_EQ(seen, plant) << name;
}

/// One standard error is some 0.5 %.
TEST(Chromatic, ChannelsAreThoseOfGreyScenes) {
  PathScene once = gridAndBox();
  once.depth(1);
  expectChannelsApart(once, "one event", false);
  expectChannelsApart(gridAndBox(), "grid and box", true);
  expectChannelsApart(ball(), "ball", true);
}

} // namespace
} // namespace tyndall::test
