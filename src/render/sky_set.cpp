// SPDX-License-Identifier: Apache-2.0
#include "render/sky_set.h"

#include "math/colour.h"
#include "phase/list.h"
#include "render/light_cache_lattice.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace tyndall::render {
namespace {

constexpr float kShare = 0.25f;
/// A lobe of this mean cosine halves within half a cell, 22 degrees.
constexpr float kPeaked = 0.6f;
/// Brightest texel over the mean radiance of a map, above which the set would meet the bright spot by luck.
constexpr double kContrast = 30.0;

bool spotted(const light::EnvironmentTable& table) {
  const double mean = table.power / (4.0 * std::numbers::pi);
  return std::any_of(table.texels.begin(), table.texels.end(),
                     [&](const glm::vec3& texel) { return luminance(glm::dvec3(texel)) > kContrast * mean; });
}

} // namespace

bool peaked(const interop::Phase& phase) {
  switch (static_cast<PhaseId>(phase.id)) {
  case PhaseId::Isotropic:
  case PhaseId::Rayleigh:
    return false;
  case PhaseId::HenyeyGreenstein:
  case PhaseId::Draine:
    return std::abs(phase.parameters[0]) > kPeaked;
  case PhaseId::TwoLobe:
    return std::max(std::abs(phase.parameters[0]), std::abs(phase.parameters[1])) > kPeaked;
  case PhaseId::Mie:
    break;
  }
  return true;
}

std::vector<glm::vec3> skyDirections(std::uint32_t seed, std::uint32_t batch) {
  std::seed_seq mixed{seed, batch};
  std::mt19937 random(mixed);
  constexpr double kScale = 1.0 / 4294967296.0;
  std::vector<glm::vec3> directions;
  for (std::uint32_t y = 0; y < interop::kSkyEdge; ++y) {
    for (std::uint32_t x = 0; x < interop::kSkyEdge; ++x) {
      const double u = (x + (double(random()) + 0.5) * kScale) / interop::kSkyEdge;
      const double v = (y + (double(random()) + 0.5) * kScale) / interop::kSkyEdge;
      directions.emplace_back(octahedralDirection(2.0 * glm::dvec2(u, v) - 1.0));
    }
  }
  return directions;
}

SkyShares skyShares(const gpu_scene::GpuScene& scene) {
  const std::vector<interop::Medium>& media = scene.media().media;
  const std::vector<light::EnvironmentTable>& maps = scene.environmentTables();
  const bool spot = std::any_of(maps.begin(), maps.end(), spotted);
  const bool narrow = std::any_of(media.begin(), media.end(), [](const interop::Medium& m) { return peaked(m.phase); });
  return {spot ? kShare : 0.0f, narrow ? kShare : 0.0f};
}

} // namespace tyndall::render
