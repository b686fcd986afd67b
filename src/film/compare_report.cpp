// SPDX-License-Identifier: Apache-2.0
#include "film/compare.h"
#include "film/statistics.h"

#include <fmt/format.h>

#include <cmath>

namespace tyndall::film {
namespace {

constexpr std::array<const char*, 3> kColourNames{"R", "G", "B"};

} // namespace

std::vector<std::string> failures(const Comparison& comparison, const CompareOptions& options) {
  std::vector<std::string> list;
  if (comparison.pixels == 0) {
    list.push_back("no pixel is finite in both pictures");
  }
  if (comparison.nonFiniteImage + comparison.nonFiniteReference > 0) {
    list.push_back(fmt::format("non-finite pixels: {} in the image, {} in the reference", comparison.nonFiniteImage,
                               comparison.nonFiniteReference));
  }
  if (options.maxRrmse && !(comparison.rRmse <= *options.maxRrmse)) {
    list.push_back(fmt::format("rRMSE {:.4g} exceeds {:.4g}", comparison.rRmse, *options.maxRrmse));
  }
  for (int channel = 0; channel < 3; ++channel) {
    const double relative = std::abs(comparison.bias[channel].relative);
    if (options.maxBias && !(relative <= *options.maxBias)) {
      list.push_back(fmt::format("bias of {} is {:.4g}, more than {:.4g}", kColourNames[channel], relative,
                                 *options.maxBias));
    }
  }
  // Two families, the picture's means and the tiles, share the false-alarm rate.
  const double threshold = sidakThreshold(options.familyRate, 2.0);
  if (comparison.channelFamilyP < threshold) {
    list.push_back(fmt::format("the mean differs beyond chance (p = {:.2g})", comparison.channelFamilyP));
  }
  if (comparison.tiles && comparison.tiles->familyP < threshold) {
    list.push_back(fmt::format("the tile at ({}, {}) differs beyond chance (z = {:.1f}, p = {:.2g})",
                               comparison.tiles->worstTile.x, comparison.tiles->worstTile.y, comparison.tiles->worstZ,
                               comparison.tiles->familyP));
  }
  return list;
}

std::string formatTable(const Comparison& comparison) {
  std::string text;
  const auto line = [&](const char* name, const std::string& value) { text += fmt::format("{:<18}{}\n", name, value); };
  line("pixels", fmt::format("{} ({} covered)", comparison.pixels, comparison.coveredPixels));
  line("non-finite", fmt::format("{} in the image, {} in the reference", comparison.nonFiniteImage,
                                 comparison.nonFiniteReference));
  line("MSE", fmt::format("{:.6g}", comparison.mse));
  line("relMSE", fmt::format("{:.6g}", comparison.relMse));
  line("rRMSE", fmt::format("{:.4f} %", 100.0 * comparison.rRmse));
  line("max difference", fmt::format("{:.6g}", comparison.maxDifference));
  for (int channel = 0; channel < 3; ++channel) {
    const ChannelBias& bias = comparison.bias[channel];
    std::string value = fmt::format("{:+.6g} ({:+.4f} %)", bias.meanImage - bias.meanReference, 100.0 * bias.relative);
    if (bias.standardError) {
      value += fmt::format(", standard error {:.3g}, z = {:+.2f}, p = {:.3g}", *bias.standardError, bias.z, bias.p);
    }
    line(fmt::format("bias {}", kColourNames[channel]).c_str(), value);
  }
  if (comparison.tiles) {
    const TileTest& tiles = *comparison.tiles;
    line("tiles", fmt::format("worst z = {:+.2f} at ({}, {}) in {}, family p = {:.3g} over {} tests", tiles.worstZ,
                              tiles.worstTile.x, tiles.worstTile.y, kColourNames[tiles.worstChannel], tiles.familyP,
                              tiles.tests));
  }
  return text;
}

} // namespace tyndall::film
