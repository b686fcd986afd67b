// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "guide/log_order.h"
#include "passes/guide_apply/guide_apply_pass.h"
#include "support/path_scenes.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

/// Guided paths as statistics: stores made for a picture, read and overwritten, and the noise of pictures.
namespace tyndall::test {

using StorePtr = std::shared_ptr<guide::Store>;

/// An empty store for pictures of `test`.
StorePtr makeStore(const scene::GuideSettings& settings, const PathScene& test);
StorePtr makeStore(const guide::StoreSize& size);

/// `options` by paths that the store guides.
MomentOptions guidedBy(const StorePtr& store, const scene::GuideSettings& settings, MomentOptions options = {});
/// The same without light samples: lights are found by directions alone.
MomentOptions withoutLightSamples(MomentOptions options);

Moments render(const PathScene& test, const MomentOptions& options);
/// Renders for the store's sake.
void learn(const PathScene& test, const StorePtr& store, const scene::GuideSettings& settings,
           bool lightSamples = false, std::uint32_t rounds = 8);

/// The store's states that are not empty.
std::vector<interop::ChainState> statesOf(const guide::Store& store);

/// What an empty store of a size holds after a log that is carried out in an order. @param guide constants of learning.
guide::StoreContent carryOut(const guide::StoreSize& size, passes::GuideApplySpec spec, interop::Guide guide,
                             std::span<const interop::GuideUpdate> log, const guide::LogOrder& order);

/// Overwrites every state of the cells that are taken, and what the cells have learnt, with numbers without sense:
/// targets anywhere, weights over 20 decades, some that are infinite, none or near the largest float.
void fillWithGarbage(guide::Store& store, unsigned seed);

/// Mean over the pixels of the variance of one replicate, with a standard error from its spread over parts of the
/// picture that are drawn at random.
struct Noise {
  double mean = 0.0;
  double error = 0.0;
};
Noise noiseOf(const Moments& moments, int channel = 0);

/// a / b, with the interval that holds it at a rate of 1e-4, both sides together.
struct Ratio {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
  std::string text() const;
};
Ratio ratioOf(const Noise& a, const Noise& b);

} // namespace tyndall::test
