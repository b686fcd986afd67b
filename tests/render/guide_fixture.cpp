// SPDX-License-Identifier: Apache-2.0
#include "guide_fixture.h"

#include "support/probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace tyndall::test {
namespace {

constexpr double kStoreBytes = 64e6;
/// Of the picture, for the error of its noise.
constexpr std::size_t kParts = 16;

template <class T>
std::vector<T> read(const std::vector<std::byte>& bytes) {
  std::vector<T> result(bytes.size() / sizeof(T));
  std::memcpy(result.data(), bytes.data(), bytes.size());
  return result;
}

template <class T>
std::vector<std::byte> written(const std::vector<T>& values) {
  std::vector<std::byte> bytes(values.size() * sizeof(T));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// Numbers without sense.
class Garbage {
public:
  explicit Garbage(unsigned seed) : random_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  std::uint32_t bits() { return static_cast<std::uint32_t>(random_()); }
  /// Positive, over 20 decades; one in ten is none, infinite, negative or 0.
  float positive() {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kOdd[] = {std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity, -1.0f, 0.0f};
    return uniform(0.0, 1.0) < 0.1 ? kOdd[bits() % std::size(kOdd)] : float(std::pow(10.0, uniform(-10.0, 10.0)));
  }
  /// Likewise; one in twenty is near the largest float, so that its product with a narrow lobe's density is beyond it.
  float weight() { return uniform(0.0, 1.0) < 0.05 ? float(std::pow(10.0, uniform(30.0, 38.5))) : positive(); }
  /// Near the scene, or as far away as may be.
  float coordinate() { return float(uniform(-3.0, 3.0)) * (uniform(0.0, 1.0) < 0.1 ? positive() : 1.0f); }

  interop::ChainState state() {
    interop::ChainState made{};
    made.target = glm::vec3(coordinate(), coordinate(), coordinate());
    made.weight = weight();
    made.spread = uniform(0.0, 1.0) < 0.5 ? float(uniform(0.0, 2.0)) : positive();
    made.evidence = positive();
    made.time = positive();
    made.velocityXY = bits();
    made.velocityZCount = bits(); // the count is any
    return made;
  }

private:
  std::mt19937 random_;
};

} // namespace

StorePtr makeStore(const guide::StoreSize& size) { return std::make_shared<guide::Store>(probeDevice(), size); }

StorePtr makeStore(const scene::GuideSettings& settings, const PathScene& test) {
  return makeStore(guide::storeSize(settings, test.scene.film.size, kStoreBytes));
}

MomentOptions guidedBy(const StorePtr& store, const scene::GuideSettings& settings, MomentOptions options) {
  options = byPaths(options);
  options.estimator.guide = render::GuidePlan{.settings = settings, .store = store};
  options.estimator.guide->settings.watch = false; // what is tested must not switch itself off
  return options;
}

MomentOptions withoutLightSamples(MomentOptions options) {
  options.estimator.techniques = interop::kTechniqueDirection;
  return options;
}

Moments render(const PathScene& test, const MomentOptions& options) {
  return renderMoments(test.scene, test.volumes, options);
}

void learn(const PathScene& test, const StorePtr& store, const scene::GuideSettings& settings, bool lightSamples,
           std::uint32_t rounds) {
  scene::GuideSettings learning = settings;
  learning.learn = true;
  MomentOptions options = guidedBy(store, learning, {.replicates = rounds, .samples = 16, .firstSeed = 900001});
  options.estimator.techniques |= interop::kTechniqueLight | interop::kTechniqueDirection;
  render(test, lightSamples ? options : withoutLightSamples(options));
}

std::vector<interop::ChainState> statesOf(const guide::Store& store) {
  const guide::StoreContent content = store.content();
  std::vector<interop::ChainState> states = read<interop::ChainState>(content.states);
  for (const interop::ScreenChain& chain : read<interop::ScreenChain>(content.screen)) {
    states.push_back(chain.state);
  }
  std::erase_if(states, [](const interop::ChainState& state) { return !(state.weight > 0.0f); });
  return states;
}

guide::StoreContent carryOut(const guide::StoreSize& size, passes::GuideApplySpec spec, interop::Guide guide,
                             std::span<const interop::GuideUpdate> log, const guide::LogOrder& order) {
  guide::Store store(probeDevice(), size);
  store.nextRound();
  const gpu::Buffer<interop::GuideUpdate> updates(probeDevice(), log);
  const gpu::Buffer<interop::GuideCounters> counters(probeDevice(), 1, gpu::Memory::Host);
  const gpu::Buffer<std::uint32_t> places(probeDevice(), std::span(order.places));
  const gpu::Buffer<std::uint32_t> first(probeDevice(), std::span(order.first));
  store.describe(guide);
  guide.log = updates.ptr();
  guide.counters = counters.ptr();
  const gpu::Buffer<interop::Guide> header(probeDevice(), std::span(&guide, 1));
  spec.kGuideOrdered = true;
  const passes::GuideApplyPass pass(probeDevice(), spec);
  pass.run({.guide = header.ptr(),
            .places = places.ptr(),
            .first = first.ptr(),
            .count = static_cast<std::uint32_t>(order.first.size() - 1),
            .kinds = ~0u});
  return store.content();
}

void fillWithGarbage(guide::Store& store, unsigned seed) {
  Garbage garbage(seed);
  guide::StoreContent content = store.content();
  std::vector<interop::GuideCell> cells = read<interop::GuideCell>(content.cells);
  std::vector<interop::ChainState> states = read<interop::ChainState>(content.states);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].fingerprint == 0) {
      continue;
    }
    cells[i].scatterGain = garbage.positive();
    cells[i].guideGain = garbage.positive();
    cells[i].samples = garbage.bits() >> garbage.bits() % 32; // as many as may be, or too few to be read
    for (std::size_t j = 0; j < content.size.states; ++j) {
      states[i * content.size.states + j] = garbage.state();
    }
  }
  std::vector<interop::ScreenChain> screen = read<interop::ScreenChain>(content.screen);
  for (interop::ScreenChain& chain : screen) { // where pixels saw their vertices is kept: others read no state
    chain.state = garbage.state();
    chain.score = garbage.weight();
    chain.round = garbage.bits();
    chain.normal *= garbage.uniform(0.0, 1.0) < 0.1 ? garbage.positive() : 1.0f;
  }
  std::vector<interop::DistanceState> distances = read<interop::DistanceState>(content.distances);
  for (interop::DistanceState& state : distances) {
    const float within = float(garbage.uniform(0.0, 8.0)); // others serve no ray
    state = {garbage.weight(), garbage.uniform(0.0, 1.0) < 0.1 ? garbage.positive() : within, garbage.positive(),
             garbage.positive()};
  }
  std::vector<interop::DistanceShare> shares = read<interop::DistanceShare>(content.distanceShares);
  for (interop::DistanceShare& share : shares) {
    share = {garbage.positive(), garbage.positive(), garbage.bits() >> garbage.bits() % 32};
  }
  content.distances = written(distances);
  content.distanceShares = written(shares);
  content.screen = written(screen);
  content.cells = written(cells);
  content.states = written(states);
  store.restore(content);
}

Noise noiseOf(const Moments& moments, int channel) {
  std::vector<double> variances;
  for (const auto& pixel : moments.pixels) {
    variances.push_back(pixel[static_cast<std::size_t>(channel)].variance);
  }
  std::shuffle(variances.begin(), variances.end(), std::mt19937(1));
  std::vector<double> parts;
  const std::size_t each = variances.size() / kParts;
  for (std::size_t part = 0; part < kParts; ++part) {
    double sum = 0.0;
    for (std::size_t i = 0; i < each; ++i) {
      sum += variances[part * each + i];
    }
    parts.push_back(sum / double(each));
  }
  const film::SampleSummary summary = film::summarise(parts);
  return {summary.mean, std::sqrt(summary.variance / summary.count)};
}

Ratio ratioOf(const Noise& a, const Noise& b) {
  const double t = film::studentTQuantile(1.0 - 0.5 * kFamilyRate, kParts - 1.0);
  const double error = std::hypot(a.error / a.mean, b.error / b.mean); // of the logarithm
  const double value = a.mean / b.mean;
  return {value, value * std::exp(-t * error), value * std::exp(t * error)};
}

std::string Ratio::text() const { return fmt::format("{:.3g} in [{:.3g}, {:.3g}]", value, low, high); }

} // namespace tyndall::test
