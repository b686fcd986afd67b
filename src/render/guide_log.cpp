// SPDX-License-Identifier: Apache-2.0
#include "render/guide_log.h"

#include <algorithm>

namespace tyndall::render {
namespace {

/// Without an order, for each pixel: most vertices find nothing, and what does not fit teaches nothing. A full log of
/// 262,144 pixels is then one dispatch on every device: 65,535 groups are guaranteed.
constexpr std::uint32_t kPlaces = 15;

constexpr std::uint32_t kAllKinds = 0xffffffffu;
constexpr std::uint32_t kOfDrawnStates = 1u << interop::kUpdateSample | 1u << interop::kUpdateMiss;

std::size_t places(const scene::GuideSettings& settings, bool ordered, std::uint32_t pixels) {
  return std::size_t(pixels) * (ordered ? mostUpdates(settings) : kPlaces);
}

} // namespace

/// A vertex writes its cell's gains, what the drawing state makes of the sample, the accepted state into each grid, and
/// what it has to say to the cache; a miss takes weight away only where nothing is accepted. Where states are fitted,
/// it writes the sample into each grid.
std::uint32_t mostUpdates(const scene::GuideSettings& settings) {
  const std::uint32_t share = settings.learnShare && !settings.fit ? 1 : 0;
  const std::uint32_t sample = settings.weight == scene::GuideWeight::Mean && !settings.fit ? 1 : 0;
  const std::uint32_t grids = settings.staticGrid ? 2 : 1;
  const std::uint32_t radiance = settings.score == scene::GuideScore::Cache ? 1 : 0;
  return settings.records * (share + sample + grids + radiance);
}

double guideLogBytes(const scene::GuideSettings& settings, bool ordered, std::uint32_t pixels) {
  const double updates = double(places(settings, ordered, pixels));
  const double order = ordered ? (2.0 * updates + double(pixels)) * sizeof(std::uint32_t) : 0.0;
  return updates * sizeof(interop::GuideUpdate) + order;
}

GuideLog::GuideLog(const gpu::Device& device, const scene::GuideSettings& settings, const guide::StoreSize& size,
                   const passes::PathSpec& spec, std::uint32_t pixels)
    : layout_{size, settings.window}, ordered_(spec.kGuideOrdered), keepsSamples_(!settings.fit),
      perPixel_(mostUpdates(settings)),
      log_(device, places(settings, ordered_, pixels), ordered_ ? gpu::Memory::Host : gpu::Memory::Device),
      counts_(device, ordered_ ? pixels : 1, gpu::Memory::Host),
      places_(device, ordered_ ? log_.size() : 0, gpu::Memory::Host),
      first_(device, ordered_ ? log_.size() + 1 : 0, gpu::Memory::Host),
      apply_(device, {.kGuideStates = settings.states,
                      .kGuideCache = spec.kGuideCache,
                      .kGuideMotion = spec.kGuideMotion,
                      .kGuideFit = spec.kGuideFit,
                      .kGuideOrdered = ordered_}) {}

void GuideLog::describe(interop::Guide& guide) const {
  guide.log = log_.ptr();
  guide.logCounts = counts_.ptr();
  guide.logSize = ordered_ ? perPixel_ : static_cast<std::uint32_t>(log_.size());
}

void GuideLog::begin(std::size_t pixels) {
  pixels_ = pixels;
  std::ranges::fill(counts_.mapped(), 0u);
}

void GuideLog::carryOut(interop::Ptr<interop::Guide> guide) {
  if (ordered_) {
    carryOutInOrder(guide);
    return;
  }
  interop::GuideApplyInputs inputs{};
  inputs.guide = guide;
  inputs.count = std::min(counts_.mapped()[0], static_cast<std::uint32_t>(log_.size()));
  lost_ += counts_.mapped()[0] - inputs.count;
  inputs.kinds = kAllKinds;
  if (keepsSamples_) {
    inputs.kinds = kOfDrawnStates;
    apply_.run(inputs);
    inputs.kinds = ~kOfDrawnStates;
  }
  apply_.run(inputs);
}

void GuideLog::carryOutInOrder(interop::Ptr<interop::Guide> guide) {
  const guide::LogOrder order =
      guide::logOrder(log_.mapped(), counts_.mapped().subspan(0, pixels_), perPixel_, layout_);
  if (order.places.empty()) {
    return;
  }
  places_.write(order.places);
  first_.write(order.first);
  apply_.run({.guide = guide,
              .places = places_.ptr(),
              .first = first_.ptr(),
              .count = static_cast<std::uint32_t>(order.first.size() - 1),
              .kinds = kAllKinds});
}

} // namespace tyndall::render
