// SPDX-License-Identifier: Apache-2.0
#include "render/light_cache_plan.h"

#include "render/light_cache_lattice.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace tyndall::render {
namespace {

using interop::LightCache;

/// Memory makes none coarser than this. In dense media more than this optical depth between nodes makes a cache worse
/// than none; spacings that are asked for, and arrays that would be too long, are let through.
constexpr double kCoarsestSpacing = 8.0;
constexpr double kMostDepthPerNode = 3.0;
/// Optical depth of a voxel above which nodes lie half a voxel apart.
constexpr double kDenseVoxel = 1.0;
/// 2 GiB: byte offsets that 32 bits hold.
constexpr double kMostNodes = double(1u << 29);

/// Typical density where there is any: the median over bricks of their means.
double medianDensity(const volume::BrickGrid& grid) {
  std::vector<float> means;
  for (const volume::Range& range : grid.ranges) {
    if (range.max > 0.0f) {
      means.push_back(range.mean);
    }
  }
  if (means.empty()) {
    return 0.0;
  }
  const auto middle = means.begin() + std::ptrdiff_t(means.size() / 2);
  std::nth_element(means.begin(), middle, means.end());
  return double(*middle);
}

/// A request on its way to a plan.
struct Candidate {
  LightCachePlan plan;
  LightCacheTarget target;
  double coarsest = kCoarsestSpacing;

  bool canCoarsen() const { return 2.0 * plan.spacing <= coarsest; }
};

/// Lays the nodes `spacing` voxels apart.
void setSpacing(Candidate& candidate, double spacing) {
  LightCache lattice = lightCacheLattice(candidate.target, spacing);
  lattice.grid = candidate.plan.header.grid;
  lattice.sigmaT = candidate.plan.header.sigmaT;
  lattice.worldFromVoxel = candidate.plan.header.worldFromVoxel;
  candidate.plan.header = lattice;
  candidate.plan.spacing = spacing;
}

Candidate candidateFor(const LightCacheRequest& request, const interop::Grid& grid, double density) {
  const glm::dmat4 voxelFromWorld(glm::dmat4x3(grid.voxelFromWorld));
  const glm::dmat4 worldFromVoxel = glm::inverse(voxelFromWorld);
  Candidate candidate;
  candidate.target.bounds = {glm::dvec3(grid.boundsMin), glm::dvec3(grid.boundsMax)};
  candidate.target.light = glm::dvec3(voxelFromWorld * glm::dvec4(request.light, request.distant ? 0.0 : 1.0));
  candidate.target.distant = request.distant;
  candidate.plan.header.grid = request.grid;
  candidate.plan.header.sigmaT = static_cast<float>(request.sigmaT);
  candidate.plan.header.worldFromVoxel = glm::mat4x3(glm::dmat4x3(worldFromVoxel));
  const double voxelEdge = std::cbrt(std::abs(glm::determinant(glm::dmat3(worldFromVoxel))));
  const double voxelDepth = request.sigmaT * density * voxelEdge;
  const double spacing = request.spacing > 0.0 ? request.spacing : (voxelDepth > kDenseVoxel ? 0.5 : 1.0);
  candidate.coarsest = std::min(kCoarsestSpacing, kMostDepthPerNode / std::max(voxelDepth, 1e-30));
  setSpacing(candidate, spacing);
  while (double(candidate.plan.nodes()) > kMostNodes) {
    setSpacing(candidate, 2.0 * candidate.plan.spacing);
  }
  return candidate;
}

double totalBytes(const std::vector<Candidate>& candidates) {
  return std::accumulate(candidates.begin(), candidates.end(), 0.0,
                         [](double sum, const Candidate& candidate) { return sum + candidate.plan.bytes(); });
}

/// Doubles spacings, last request first and round again, until all fit or none may grow.
void coarsen(std::vector<Candidate>& candidates, double budgetBytes) {
  bool changed = true;
  while (changed && totalBytes(candidates) > budgetBytes) {
    changed = false;
    for (auto it = candidates.rbegin(); it != candidates.rend() && totalBytes(candidates) > budgetBytes; ++it) {
      if (it->canCoarsen()) {
        setSpacing(*it, 2.0 * it->plan.spacing);
        changed = true;
      }
    }
  }
}

} // namespace

std::vector<LightCachePlan> planLightCaches(std::span<const LightCacheRequest> requests,
                                            const gpu_scene::PackedMedia& media, const gpu_scene::VolumeSet& volumes,
                                            double budgetBytes) {
  std::vector<Candidate> candidates;
  std::map<std::size_t, double> densities; // by grid
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const gpu_scene::PackedMedia::Placement& placement = media.placements.at(requests[i].grid);
    const auto [density, fresh] = densities.try_emplace(placement.grid, 0.0);
    if (fresh) {
      density->second = medianDensity(volumes.grids[placement.grid]);
    }
    candidates.push_back(candidateFor(requests[i], placement.header, density->second));
    candidates.back().plan.request = i;
  }
  coarsen(candidates, budgetBytes);
  std::vector<LightCachePlan> plans;
  double bytes = 0.0;
  for (const Candidate& candidate : candidates) {
    if (bytes + candidate.plan.bytes() <= budgetBytes) {
      bytes += candidate.plan.bytes();
      plans.push_back(candidate.plan);
    }
  }
  return plans;
}

} // namespace tyndall::render
