// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/volumes.h"
#include "scene/scene.h"
#include "support/ray_reference.h"
#include "verify/quadrature.h"

#include <array>
#include <limits>
#include <memory>
#include <vector>

/// Media and lights as the quadrature along rays sees them; only ray_reference.cpp has a use for it.
namespace tyndall::test {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kOpaque = 45.0; ///< optical depth beyond which nothing is seen: exp(-45) = 3e-20

struct LocalLight {
  bool point = false;
  glm::dvec3 place{0.0}; ///< position, or unit direction to the sun
  double strength = 0.0; ///< W/sr, or W/m2
};

/// A medium in its local space, which is index coordinates for a grid.
struct LocalMedium {
  const scene::Medium* values = nullptr;
  std::shared_ptr<const DecodedGrid> grid; ///< null: homogeneous
  glm::dmat4 localFromWorld{1.0};
  double sigma = 0.0; ///< extinction, or extinction per unit of density, 1 / scene unit
  double albedo = 0.0;
  Bounds3 box;                ///< local; empty for an unbounded medium
  double longest = kInfinity; ///< of pieces that light reaches through this medium, in local units

  /// Part of [0, tMax] where the medium can be, x >= y if there is none.
  glm::dvec2 span(const OracleRay& local, double tMax) const;
  /// Optical depth over t in [0, tMax], in scene units of t.
  double depth(const OracleRay& local, double tMax) const;
  /// Hull of the t in [0, end] where a light's ray to x(t) meets the box, x > y if none do; the medium must be bounded.
  /// Adds to `kinks` where the length of that ray inside box or sphere has one.
  glm::dvec2 shadow(const OracleRay& local, const LocalLight& light, double end, std::vector<double>& kinks) const;
};

/// What all rays share.
struct Stage {
  std::vector<LocalMedium> media;
  std::vector<LocalLight> lights;
  RayReferenceSettings settings;
  const GaussRule* rule = nullptr;
  std::array<std::vector<double>, 2> legendre; ///< the two highest polynomials that the rule resolves, at its nodes
};

/// @throws Error for lights other than points and suns of diameter 0.
Stage makeStage(const scene::Scene& scene, const gpu_scene::VolumeSet& volumes, const RayReferenceSettings& settings);

} // namespace tyndall::test
