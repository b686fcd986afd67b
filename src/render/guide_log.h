// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "guide/log_order.h"
#include "guide/store.h"
#include "passes/guide_apply/guide_apply_pass.h"
#include "passes/path/path_pass.h"

#include <utility>

namespace tyndall::render {

/// Updates of the store that a sample of a pixel makes at most.
std::uint32_t mostUpdates(const scene::GuideSettings& settings);

/// Device bytes of the log for dispatches of `pixels`.
double guideLogBytes(const scene::GuideSettings& settings, bool ordered, std::uint32_t pixels);

/// Writes of guided paths, held back while a few samples of each pixel of a dispatch are taken. Ordered, they are
/// carried out in an order that does not depend on threads: each sample of a pixel sees the same store whatever ran
/// beside it.
class GuideLog {
public:
  /// @param size of the store. @param spec of the pass that writes.
  GuideLog(const gpu::Device& device, const scene::GuideSettings& settings, const guide::StoreSize& size,
           const passes::PathSpec& spec, std::uint32_t pixels);

  /// Puts its addresses and sizes in.
  void describe(interop::Guide& guide) const;
  /// Empty, for the next samples of `pixels` pixels.
  void begin(std::size_t pixels);
  /// Carries all out. @param guide what describe() has filled in.
  void carryOut(interop::Ptr<interop::Guide> guide);
  /// Updates that there was no room for since the last call.
  std::uint64_t takeLost() { return std::exchange(lost_, 0); }

private:
  void carryOutInOrder(interop::Ptr<interop::Guide> guide);

  guide::WindowLayout layout_;
  bool ordered_;
  bool keepsSamples_; ///< states are changed where they were read, before others take their places
  std::uint32_t perPixel_;
  std::size_t pixels_ = 0;
  std::uint64_t lost_ = 0;
  gpu::Buffer<interop::GuideUpdate> log_;
  gpu::Buffer<std::uint32_t> counts_;
  gpu::Buffer<std::uint32_t> places_;
  gpu::Buffer<std::uint32_t> first_;
  passes::GuideApplyPass apply_;
};

} // namespace tyndall::render
