// SPDX-License-Identifier: Apache-2.0
// The choice of one emitter among many, on the device.
#include "shaders/light_tree_scenes.h"
#include "support/statistics.h"

// Needs <cstdint> before it.
#include "kernels/light_tree_probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace tyndall::test {
namespace {

using interop::TreeChoice;
using interop::TreeReceiver;

enum Mode : std::uint32_t { Choices, Probabilities, ChoicesAlone };
constexpr std::uint32_t kSelections[] = {interop::kSelectTree, interop::kSelectPower, interop::kSelectUniform};

/// `perReceiver` choices for each receiver, or the probability of each emitter.
std::vector<TreeChoice> ask(const EmitterScene& scene, const std::vector<TreeReceiver>& receivers, Mode mode,
                            std::size_t perReceiver, std::uint32_t selection = interop::kSelectTree) {
  const EmittersOnDevice emitters(scene);
  const auto in = ProbeRunner::upload(receivers);
  const auto count = static_cast<std::uint32_t>(receivers.size() * perReceiver);
  const auto out = ProbeRunner::results<TreeChoice>(count);
  const ProbeRunner probe(k_light_tree_probe_spirv, {{0, mode}, {1, selection}});
  probe.run(interop::TreeProbe{emitters.ptr(), in.ptr(), out.ptr(), static_cast<std::uint32_t>(perReceiver), count},
            count);
  return ProbeRunner::download(out);
}

std::vector<TreeChoice> probabilities(const EmitterScene& scene, const std::vector<TreeReceiver>& receivers,
                                      std::uint32_t selection = interop::kSelectTree) {
  return ask(scene, receivers, Probabilities, scene.emitters.size(), selection);
}

/// Largest distance from 1 of the sum over emitters, over the receivers; infinity for a probability outside [0, 1].
double worstSum(const EmitterScene& scene, const std::vector<TreeReceiver>& receivers, std::uint32_t selection) {
  const std::vector<TreeChoice> all = probabilities(scene, receivers, selection);
  double worst = 0.0;
  for (std::size_t r = 0; r < receivers.size(); ++r) {
    double sum = 0.0;
    for (std::size_t i = 0; i < scene.emitters.size(); ++i) {
      const float pdf = all[r * scene.emitters.size() + i].again;
      sum += pdf >= 0.0f && pdf <= 1.0f ? static_cast<double>(pdf) : std::numeric_limits<double>::infinity();
    }
    worst = std::max(worst, std::abs(sum - 1.0));
  }
  return worst;
}

TEST(LightTreeOnDevice, ProbabilitiesSumToOne) {
  for (const EmitterScene& scene : emitterScenes()) {
    for (const std::uint32_t selection : kSelections) {
      // Float rounding, at each of at most 32 levels.
      EXPECT_LT(worstSum(scene, receiversIn(scene, 300, 1), selection), 5e-6)
          << scene.name << ", selection " << selection;
    }
  }
  EmitterScene spoilt = makeEmitterScene("spoilt", mixedEmitters(40, 3));
  spoilt.emitters[13].trail ^= 1u;
  EXPECT_GT(worstSum(spoilt, receiversIn(spoilt, 300, 1), interop::kSelectTree), 5e-6);
}

/// Smallest p-value, over the receivers, of the emitters that are chosen against the probabilities that `expected`
/// gives.
double choicesPValue(const EmitterScene& scene, const EmitterScene& expected,
                     const std::vector<TreeReceiver>& receivers, std::uint32_t selection,
                     std::uint32_t expectedSelection) {
  constexpr std::size_t kDraws = 1u << 15;
  const std::size_t emitters = scene.emitters.size();
  const std::vector<TreeChoice> asked = probabilities(expected, receivers, expectedSelection);
  const std::vector<TreeChoice> drawn = ask(scene, receivers, ChoicesAlone, kDraws, selection);
  double smallest = 1.0;
  for (std::size_t r = 0; r < receivers.size(); ++r) {
    std::vector<double> pdfs;
    for (std::size_t i = 0; i < emitters; ++i) {
      pdfs.push_back(static_cast<double>(asked[r * emitters + i].again));
    }
    std::vector<std::uint64_t> counts(emitters);
    for (std::size_t i = 0; i < kDraws; ++i) {
      ++counts.at(drawn[r * kDraws + i].emitter);
    }
    smallest = std::min(smallest, chiSquaredPValue(counts, pdfs));
  }
  return smallest;
}

TEST(LightTreeOnDevice, ChoosesByTheProbabilities) {
  for (const EmitterScene& scene : emitterScenes()) {
    const std::vector<TreeReceiver> receivers = receiversIn(scene, 6, 2);
    for (const std::uint32_t selection : kSelections) {
      EXPECT_GT(choicesPValue(scene, scene, receivers, selection, selection), kMinPValue) << scene.name << selection;
    }
  }
  const EmitterScene scene = makeEmitterScene("mixed", mixedEmitters(300, 3));
  const std::vector<TreeReceiver> middle{{glm::vec3(0.0f), glm::vec3(0.0f), 0}};
  EXPECT_LT(choicesPValue(scene, scene, middle, interop::kSelectTree, interop::kSelectPower), kMinPValue);
  EmitterScene stronger = scene; // one child of the root by three tenths
  stronger.nodes[scene.nodes[0].child].power *= 1.3f;
  EXPECT_LT(choicesPValue(stronger, scene, middle, interop::kSelectPower, interop::kSelectPower), kMinPValue);
}

/// Largest relative difference between what a choice and the way back along the trail say.
double worstDisagreement(const std::vector<TreeChoice>& choices) {
  double worst = 0.0;
  for (const TreeChoice& choice : choices) {
    worst = std::max(worst, std::abs(double(choice.again) / double(choice.pdf) - 1.0));
  }
  return worst;
}

TEST(LightTreeOnDevice, ChoiceAndTrailAgree) {
  for (const EmitterScene& scene : emitterScenes()) {
    for (const std::uint32_t selection : kSelections) {
      EXPECT_LE(worstDisagreement(ask(scene, receiversIn(scene, 300, 3), Choices, 64, selection)), 1e-6) << scene.name;
    }
  }
  EmitterScene spoilt = makeEmitterScene("spoilt", mixedEmitters(40, 3));
  spoilt.emitters[13].trail ^= 1u;
  EXPECT_GT(worstDisagreement(ask(spoilt, receiversIn(spoilt, 300, 3), Choices, 64)), 1e-6);
}

/// Pairs of receivers and emitters that shine on them but have no probability.
std::size_t forgotten(const EmitterScene& scene, const std::vector<TreeReceiver>& receivers) {
  const std::vector<TreeChoice> all = probabilities(scene, receivers);
  std::size_t count = 0;
  for (std::size_t r = 0; r < receivers.size(); ++r) {
    for (std::size_t i = 0; i < scene.emitters.size(); ++i) {
      const bool possible = all[r * scene.emitters.size() + i].again > 0.0f;
      count += contributes(scene.emitters[i], receivers[r]) && !possible ? 1 : 0;
    }
  }
  return count;
}

TEST(LightTreeOnDevice, LeavesOutNoLightThatCounts) {
  for (const EmitterScene& scene : emitterScenes()) {
    EXPECT_EQ(forgotten(scene, receiversIn(scene, 1000, 4)), 0u) << scene.name;
  }
  const EmitterScene sound = makeEmitterScene("spoilt", mixedEmitters(300, 3));
  const std::vector<TreeReceiver> receivers = receiversIn(sound, 1000, 4);
  EmitterScene narrow = sound;
  EmitterScene small = sound;
  for (std::size_t i = 0; i < sound.nodes.size(); ++i) {
    narrow.nodes[i].cosEmission += 0.01f;
    const glm::vec3 shrink = 0.2f * (sound.nodes[i].boundsMax - sound.nodes[i].boundsMin);
    small.nodes[i].boundsMin += shrink;
    small.nodes[i].boundsMax -= shrink;
  }
  EXPECT_GT(forgotten(narrow, receivers), 0u);
  EXPECT_GT(forgotten(small, receivers), 0u);
}

TEST(LightTreeOnDevice, LeavesOutMostOfWhatCannotCount) {
  // Else bounds of no use at all would pass. A floor under a ceiling that faces away, and a floor that faces away.
  const EmitterScene ceiling = emitterScenes()[5];
  ASSERT_EQ(ceiling.name, "ceiling");
  std::vector<interop::Emitter> emitters = ceiling.emitters;
  emitters.push_back(makeEmitter(interop::kEmitterPoint, glm::vec3(4.0f, 1e3f, 4.0f), 1e-9f));
  const EmitterScene scene = makeEmitterScene("one counts", emitters);
  const glm::vec3 up(0.0f, 1.0f, 0.0f);
  // The triangles shine down (cross(x, z) = -y), so above them the faint point alone counts.
  for (const TreeReceiver& receiver : {TreeReceiver{glm::vec3(4.0f, 30.0f, 4.0f), up, 0},
                                       TreeReceiver{glm::vec3(4.0f, 30.0f, 4.0f), glm::vec3(0.0f), 0},
                                       TreeReceiver{glm::vec3(4.0f, 30.0f, 4.0f), up, 1}}) {
    const std::vector<TreeChoice> all = probabilities(scene, {receiver});
    EXPECT_EQ(all.back().again, 1.0f);
  }
  const std::vector<TreeChoice> below = probabilities(scene, {{glm::vec3(4.0f, -30.0f, 4.0f), up, 0}});
  EXPECT_LT(below.back().again, 1e-3f);
}

std::vector<double> probabilitiesAt(const EmitterScene& scene, const TreeReceiver& receiver) {
  std::vector<double> pdfs;
  for (const TreeChoice& each : probabilities(scene, {receiver})) {
    pdfs.push_back(static_cast<double>(each.again));
  }
  return pdfs;
}

TEST(LightTreeOnDevice, ReachesAHundredThousand) {
  const EmitterScene scene = makeEmitterScene("many", equalPoints(100000, 1.0f, 5));
  const TreeReceiver receiver{glm::vec3(60.0f, 20.0f, 10.0f), glm::vec3(0.0f), 0}; // sees them all much alike
  const std::vector<double> pdfs = probabilitiesAt(scene, receiver);
  EXPECT_NEAR(std::accumulate(pdfs.begin(), pdfs.end(), 0.0), 1.0, 1e-5);
  std::vector<std::uint64_t> counts(pdfs.size());
  for (const TreeChoice& choice : ask(scene, {receiver}, ChoicesAlone, 2500000)) {
    ++counts.at(choice.emitter);
  }
  // Each is expected at least 20 times, so that one is missed with a probability of at most 1e5 exp(-20).
  EXPECT_GT(*std::min_element(pdfs.begin(), pdfs.end()), 8e-6);
  EXPECT_EQ(std::count(counts.begin(), counts.end(), 0u), 0);
  EXPECT_GT(chiSquaredPValue(counts, pdfs), kMinPValue);
  EmitterScene other = scene; // the checker: one child of the root by a fifth
  other.nodes[scene.nodes[0].child].power *= 1.2f;
  EXPECT_LT(chiSquaredPValue(counts, probabilitiesAt(other, receiver)), kMinPValue);
}

/// Mean over the receivers of the relative variance of a one-light estimate of the fluence, nothing in the way.
double fluenceVariance(const EmitterScene& scene, const std::vector<TreeReceiver>& receivers, std::uint32_t selection) {
  const std::vector<TreeChoice> all = probabilities(scene, receivers, selection);
  double sum = 0.0;
  for (std::size_t r = 0; r < receivers.size(); ++r) {
    double mean = 0.0;
    double square = 0.0;
    for (std::size_t i = 0; i < scene.emitters.size(); ++i) {
      const glm::dvec3 offset = glm::dvec3(scene.emitters[i].position) - glm::dvec3(receivers[r].point);
      const double value = static_cast<double>(scene.emitters[i].radiance.x) / glm::dot(offset, offset);
      mean += value;
      square += value * value / static_cast<double>(all[r * scene.emitters.size() + i].again);
    }
    sum += square / (mean * mean) - 1.0;
  }
  return sum / static_cast<double>(receivers.size());
}

TEST(LightTreeOnDevice, HasLessVarianceThanPowerAlone) {
  EmitterScene scene = makeEmitterScene("scattered", equalPoints(10000, 10.0f, 6));
  std::vector<TreeReceiver> receivers;
  for (const interop::Emitter& place : equalPoints(60, 10.0f, 8)) {
    receivers.push_back({place.position, glm::vec3(0.0f), 0});
  }
  const double tree = fluenceVariance(scene, receivers, interop::kSelectTree);
  const double power = fluenceVariance(scene, receivers, interop::kSelectPower);
  RecordProperty("tree", std::to_string(tree));
  RecordProperty("power", std::to_string(power));
  EXPECT_LT(tree, 0.1 * power) << tree << " against " << power;
  // The checker: with boxes that say nothing, the tree is no better than power.
  for (interop::LightTreeNode& node : scene.nodes) {
    node.boundsMin = glm::vec3(-10.0f);
    node.boundsMax = glm::vec3(10.0f);
  }
  EXPECT_GT(fluenceVariance(scene, receivers, interop::kSelectTree), 0.1 * power);
}

} // namespace
} // namespace tyndall::test
