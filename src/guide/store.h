// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/buffer.h"
#include "interop/guide.h"
#include "scene/guide_settings.h"

#include <cstdint>
#include <span>
#include <vector>

namespace tyndall::guide {

/// Numbers of cells. What they hold is for one number of states a cell.
struct StoreSize {
  std::uint32_t cells = 0;           ///< of the adaptive grid
  std::uint32_t staticCells = 0;     ///< 0: there is none
  std::uint32_t states = 1;          ///< of a cell
  std::uint32_t radiance = 0;        ///< cells of the radiance cache; 0: there is none
  std::uint32_t screen = 0;          ///< chains in screen space, one a pixel, instead of cells; 0: there are none
  std::uint32_t distanceColumns = 0; ///< vertices of the distance chains' grid in a row; 0: there are none
  std::uint32_t distanceRows = 0;
  std::uint32_t distanceStates = 0; ///< of a vertex
  std::size_t distanceVertices() const { return std::size_t(distanceColumns) * distanceRows; }
  bool operator==(const StoreSize&) const = default;
};

/// For a picture of a size in pixels, within `bytes`. @throws Error if chains in screen space, of directions or
/// distances, do not fit: how many there are is settled.
StoreSize storeSize(const scene::GuideSettings& settings, const glm::uvec2& picture, double bytes);
double storeBytes(const StoreSize& size);

/// What the store holds, as a value: can be saved and handed to another store of the same size.
struct StoreContent {
  StoreSize size;
  std::uint32_t round = 0;
  std::vector<std::byte> cells;
  std::vector<std::byte> states;
  std::vector<std::byte> radiance;
  std::vector<std::byte> screen;
  std::vector<std::byte> distances;
  std::vector<std::byte> distanceShares;
};

/// How full it is.
struct Occupancy {
  std::uint64_t cells = 0; ///< taken
  std::uint64_t staticCells = 0;
  std::uint64_t states = 0; ///< not empty; in screen space: pixels that have one
  std::uint64_t radiance = 0;
  std::uint64_t distances = 0; ///< distance chains
  std::uint64_t unsound = 0;   ///< states that are not finite: there must be none
};

/// The chains of a picture, or of a sequence: surfaces and media share them. Empty once made.
class Store {
public:
  Store(const gpu::Device& device, const StoreSize& size);

  const StoreSize& size() const { return size_; }
  double bytes() const { return storeBytes(size_); }
  std::uint32_t round() const { return round_; }
  void nextRound() { ++round_; }
  void clear();

  StoreContent content() const;
  /// @throws Error if it is of another size.
  void restore(const StoreContent& content);
  Occupancy occupancy() const;

  /// Distance chains alone: vertex by vertex, row by row from the top.
  std::vector<interop::DistanceState> distances() const;
  void setDistances(std::span<const interop::DistanceState> states);

  /// Puts the store's addresses and sizes in.
  void describe(interop::Guide& guide) const;

private:
  StoreSize size_;
  std::uint32_t round_ = 0;
  gpu::Buffer<interop::GuideCell> cells_;
  gpu::Buffer<interop::ChainState> states_;
  gpu::Buffer<interop::RadianceCell> radiance_;
  gpu::Buffer<interop::ScreenChain> screen_;
  gpu::Buffer<interop::DistanceState> distances_;
  gpu::Buffer<interop::DistanceShare> distanceShares_;
};

} // namespace tyndall::guide
