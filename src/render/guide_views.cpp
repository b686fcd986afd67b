// SPDX-License-Identifier: Apache-2.0
#include "render/guide_views.h"

#include "base/error.h"

#include <algorithm>
#include <iterator>

namespace tyndall::render {
namespace {

/// x | y << 16, row by row.
std::vector<std::uint32_t> pixelsOf(const film::Window& window) {
  std::vector<std::uint32_t> pixels;
  for (std::uint32_t y = window.min.y; y < window.max.y; ++y) {
    for (std::uint32_t x = window.min.x; x < window.max.x; ++x) {
      pixels.push_back(x | y << 16);
    }
  }
  return pixels;
}

std::vector<interop::GuideView> lookAt(Estimator& estimator, const std::vector<std::uint32_t>& pixels) {
  std::vector<interop::GuideView> views;
  while (views.size() < pixels.size()) {
    const std::size_t count = std::min<std::size_t>(estimator.chunkPixels(), pixels.size() - views.size());
    const auto chunk = estimator.viewGuide({pixels.data() + views.size(), count});
    views.insert(views.end(), chunk.begin(), chunk.end());
  }
  return views;
}

/// A byte of the fingerprint, which is a hash; above 0, for a cell that is there.
float colourOf(const interop::GuideView& view, int channel) {
  return view.fingerprint == 0 ? 0.0f : float((view.fingerprint >> (8 * channel) & 0xffu) + 1) / 256.0f;
}

} // namespace

std::map<std::string, std::vector<float>> guideViews(Estimator& estimator, const film::Film& film) {
  TYNDALL_CHECK(estimator.guiding() != nullptr);
  const std::vector<interop::GuideView> views = lookAt(estimator, pixelsOf(film.window()));
  std::map<std::string, std::vector<float>> channels;
  const auto add = [&](const std::string& name, auto valueOf) {
    std::ranges::transform(views, std::back_inserter(channels["guide." + name]),
                           [&](const interop::GuideView& view) { return static_cast<float>(valueOf(view)); });
  };
  for (int i = 0; i < 3; ++i) {
    add(std::string("cell.") + "RGB"[i], [&](const auto& view) { return colourOf(view, i); });
    add(std::string("direction.") + "XYZ"[i], [&](const auto& view) { return view.direction[i]; });
  }
  add("level", [](const auto& view) { return view.level; });
  add("states", [](const auto& view) { return view.states; });
  add("weight", [](const auto& view) { return view.weight; });
  add("cosine", [](const auto& view) { return view.cosine; });
  add("N", [](const auto& view) { return view.evidence; });
  add("share", [](const auto& view) { return view.share; });
  return channels;
}

} // namespace tyndall::render
