// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "interop/emitters.h"
#include "math/bounds.h"

#include <span>
#include <vector>

/// The tree by which a vertex chooses one of many emitters (shaders/light/tree.glsl walks it).
namespace tyndall::light {

/// What the tree must know of one emitter.
struct LightBounds {
  Bounds3 box;                    ///< holds all of it, centred world space; may have no extent
  glm::dvec3 axis{0.0, 0.0, 1.0}; ///< unit
  double cosNormals = -1.0;       ///< of the angle about the axis that holds all its normals; -1: all directions
  double cosEmission = 0.0;       ///< of the angle about a normal within which it shines
  double power = 0.0;             ///< luminance [W]: 4 pi times its greatest radiant intensity, so that
                                  ///< power / (4 pi d^2) is what arrives head-on. > 0
};

/// Bounds of an emitter as it stands; an emission texture is the caller's to put into `power`.
/// A volume's `radiance` is taken for its emission coefficient [W/(m3 sr)].
/// @throws Error for an emitter without area, volume, cone or light: the caller leaves such out.
LightBounds lightBounds(const interop::Emitter& emitter);

struct LightTree {
  std::vector<interop::LightTreeNode> nodes; ///< depth first, node 0 is the root; 2 n - 1 for n emitters, one per leaf
  std::uint32_t depth = 0;                   ///< of the deepest leaf, <= kLightTreeDepth
};

/// Builds the tree top down by the surface area orientation heuristic and writes every emitter's `trail`.
/// The same arguments give the same tree.
/// @param bounds one for each emitter. No emitters: no nodes.
/// @throws Error for bounds with power <= 0, an empty box or numbers that are not finite.
/// @see [Conty18] "Importance sampling of many lights with adaptive tree splitting"
LightTree buildLightTree(std::span<interop::Emitter> emitters, std::span<const LightBounds> bounds);

} // namespace tyndall::light
