// SPDX-License-Identifier: Apache-2.0
// Logged writes to the chain store, and the store as bytes.
#include "base/error.h"
#include "guide/store_file.h"
#include "guide_fixture.h"
#include "support/probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace tyndall::test {
namespace {

constexpr guide::StoreSize kSize{.cells = 64, .staticCells = 16, .states = 4, .radiance = 32};
constexpr guide::WindowLayout kLayout{.size = kSize, .window = 4};
constexpr std::uint32_t kPerPixel = 8;

/// Updates of every kind, most of them for the same few cells.
struct Log {
  std::vector<interop::GuideUpdate> updates;
  std::vector<std::uint32_t> counts;
};

Log randomLog(unsigned seed, std::size_t pixels) {
  std::mt19937 random(seed);
  const auto below = [&](std::uint32_t end) { return static_cast<std::uint32_t>(random() % end); };
  const auto number = [&] { return std::uniform_real_distribution<float>(0.1f, 2.0f)(random); };
  const auto placeOf = [&](std::uint32_t kind) {
    const std::uint32_t all = kSize.cells + kSize.staticCells;
    switch (kind) {
    case interop::kUpdateSample:
    case interop::kUpdateMiss:
      return below(all * kSize.states);
    case interop::kUpdateShare:
      return below(all);
    case interop::kUpdateRadiance:
      return below(kSize.radiance / kLayout.window) * kLayout.window;
    default:
      return below(all / kLayout.window) * kLayout.window;
    }
  };
  Log log;
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    log.counts.push_back(below(kPerPixel + 1));
    for (std::uint32_t i = 0; i < kPerPixel; ++i) {
      interop::GuideUpdate update{};
      update.kind = below(interop::kUpdateKinds);
      update.place = placeOf(update.kind);
      update.fingerprint = 1 + below(12);
      update.point = glm::vec3(number(), number(), number());
      update.state.target = glm::vec3(number(), number(), number());
      update.state.weight = number();
      update.state.spread = number();
      update.state.evidence = float(below(2));
      log.updates.push_back(update);
    }
  }
  return log;
}

/// What a store holds after a log that is carried out in an order.
guide::StoreContent carriedOut(const Log& log, const guide::LogOrder& order) {
  interop::Guide guide{};
  guide.window = kLayout.window;
  guide.leastRate = 0.01f;
  guide.forgetRate = 0.5f;
  guide.radianceLimit = 8.0f;
  guide.mostKappa = 100.0f;
  guide.priorLeast = 1e-4f;
  guide.newbornShare = 0.1f;
  return carryOut(kSize, {.kGuideStates = kSize.states, .kGuideCache = true, .kGuideFit = true}, guide, log.updates,
                  order);
}

bool same(const guide::StoreContent& a, const guide::StoreContent& b) {
  return a.size == b.size && a.round == b.round && a.cells == b.cells && a.states == b.states &&
         a.radiance == b.radiance;
}

/// Windows share nothing: side by side they come to what one thread makes of all of them, in an order of windows that
/// is any. Another order within windows is seen.
TEST(GuideLog, WindowsAreIndependent) {
  const Log log = randomLog(1, 500);
  const guide::LogOrder order = guide::logOrder(log.updates, log.counts, kPerPixel, kLayout);
  const guide::StoreContent byWindows = carriedOut(log, order);
  guide::LogOrder reversed;
  for (std::size_t window = order.first.size() - 1; window-- > 0;) {
    reversed.places.insert(reversed.places.end(), order.places.begin() + order.first[window],
                           order.places.begin() + order.first[window + 1]);
  }
  reversed.first = {0, static_cast<std::uint32_t>(order.places.size())};
  EXPECT_TRUE(same(carriedOut(log, reversed), byWindows));
  guide::LogOrder wrong = order;
  std::reverse(wrong.places.begin() + order.first[0], wrong.places.begin() + order.first[1]);
  EXPECT_FALSE(same(carriedOut(log, wrong), byWindows)) << "the planted order was not seen";
}

/// Every update once; in a window by kind, so that samples meet the states that drew them, then by pixel.
TEST(GuideLog, OrderIsByWindowKindAndPlace) {
  const Log log = randomLog(2, 300);
  const guide::LogOrder order = guide::logOrder(log.updates, log.counts, kPerPixel, kLayout);
  std::vector<std::uint32_t> expected;
  for (std::uint32_t pixel = 0; pixel < log.counts.size(); ++pixel) {
    for (std::uint32_t i = 0; i < log.counts[pixel]; ++i) {
      expected.push_back(pixel * kPerPixel + i);
    }
  }
  std::vector<std::uint32_t> sorted = order.places;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(sorted, expected);
  EXPECT_EQ(order.first.size() - 1, std::size_t((kSize.cells + kSize.staticCells + kSize.radiance) / kLayout.window));
  for (std::size_t window = 0; window + 1 < order.first.size(); ++window) {
    for (std::uint32_t i = order.first[window] + 1; i < order.first[window + 1]; ++i) {
      const std::uint32_t before = log.updates[order.places[i - 1]].kind;
      const std::uint32_t kind = log.updates[order.places[i]].kind;
      EXPECT_TRUE(before < kind || (before == kind && order.places[i - 1] < order.places[i]));
    }
  }
}

/// Bit for bit, in bytes for what is taken alone; what is cut short is refused.
TEST(GuideStoreFile, HoldsWhatIsTaken) {
  Log log = randomLog(3, 8);
  for (interop::GuideUpdate& update : log.updates) {
    if (update.kind < interop::kUpdateChain) { // nothing is written into cells that nobody has taken
      update.kind = interop::kUpdateChain;
      update.place = update.place % kSize.cells / kLayout.window * kLayout.window;
    }
  }
  guide::StoreContent content = carriedOut(log, guide::logOrder(log.updates, log.counts, kPerPixel, kLayout));
  content.round = 77;
  const std::vector<std::byte> bytes = guide::packStore(content);
  EXPECT_TRUE(same(guide::unpackStore(bytes), content));
  EXPECT_LT(bytes.size(), content.cells.size() + content.states.size() + content.radiance.size());
  for (std::size_t length = 0; length < bytes.size(); length += 13) {
    EXPECT_THROW(guide::unpackStore(std::span(bytes).first(length)), Error) << length;
  }
  guide::Store larger(probeDevice(), {.cells = 128, .staticCells = 16, .states = 4, .radiance = 32});
  EXPECT_THROW(larger.restore(content), Error);
}

} // namespace
} // namespace tyndall::test
