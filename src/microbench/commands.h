// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"
#include "volume/brick_grid.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace tyndall::microbench {

struct Options {
  std::string volume;       ///< a .vdb
  std::uint32_t size = 256; ///< picture edge, pixels
  std::uint32_t repeats = 8;
  double opticalDepth = 5.0; ///< median over lines through the volume
  double cacheBytes = 256e6; ///< for light caches
  int largestEdge = 256;     ///< caches: of the synthetic volumes, voxels
  std::string device;
  std::string json; ///< empty: none is written
};

/// What a command works on.
struct Session {
  const Options& options;
  const gpu::Device& device;
  const volume::BrickGrid& grid; ///< of the volume, not empty; rays: none
};

/// Each prints its report and returns it as JSON.

/// Lookups, shadow rays and samples per second of tracking; lookups per camera path beside those of one global
/// majorant; the bare lookup kernel as the ceiling.
nlohmann::ordered_json trackingReport(const Session& session);
/// Variance times time of march, tracking and preview: thin, normal and dense under a sun; a point light in fog.
nlohmann::ordered_json estimatorsReport(const Session& session);
/// Memory and build time of light caches over the grid's size; variance times time under small budgets.
nlohmann::ordered_json cachesReport(const Session& session);
/// Share of active lanes in the march, and its cells per second beside those of a bare walk.
nlohmann::ordered_json lanesReport(const Session& session);
/// Rays per second through surfaces of our own making, beside Embree's where it is installed.
nlohmann::ordered_json raysReport(const Session& session);
/// Variance times time of choosing one of 10 to 10,000 lights by the tree, by power and evenly; ns per choice.
nlohmann::ordered_json lightsReport(const Session& session);
/// Samples and rays per second of pass `path`, beside the bare ray cast and the bare lookup.
nlohmann::ordered_json pathsReport(const Session& session);

} // namespace tyndall::microbench
