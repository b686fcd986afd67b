// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math/bounds.h"
#include "verify/oracle_radiance.h"

#include <array>
#include <cstdint>
#include <vector>

/// Rays on which walks through voxels go wrong.
namespace tyndall::test {

using namespace verify;

/// "Plane", "edge" and "corner" are those of the voxel cells: whole coordinates on one, two or three axes. "Exactly"
/// means in the floats themselves.
enum class RayKind {
  Random,           ///< from around the box towards points in it
  AxisInsideCells,  ///< along an axis, between planes
  AxisOnCellPlane,  ///< along an axis, exactly in a plane
  AxisOnBrickPlane, ///< along an axis, exactly in a plane between bricks (a multiple of 8)
  AxisOnEdge,       ///< along an axis, exactly on an edge
  GrazingFromPlane, ///< starts exactly on a plane and leaves it with a slope of 1e-3 to 1e-7
  GrazingInside,    ///< the same slopes from inside the box, or within 0.01 of a plane, the box's own among them
  ThroughCorners,   ///< passes exactly through corner after corner
  ThroughEdges,     ///< passes exactly through edge after edge
  FromCellPlane,    ///< starts exactly on a plane, any direction
  FromBrickFace,    ///< starts exactly on a face of a brick, a third of them on two or three
  FromBounds,       ///< starts exactly on the box's faces, a third of them on its edges and corners
  FromInside,       ///< starts inside the box
  Missing,          ///< starts beyond one of the box's faces and comes no nearer to it
  Diagonal,         ///< parallel to (1, 1, 1), (1, 1, 0) and their mirror images, from anywhere or from a corner
  Far,              ///< from 300 to 10,000 voxels away
};

inline constexpr std::array kRayKinds{
    RayKind::Random,       RayKind::AxisInsideCells,  RayKind::AxisOnCellPlane, RayKind::AxisOnBrickPlane,
    RayKind::AxisOnEdge,   RayKind::GrazingFromPlane, RayKind::GrazingInside,   RayKind::ThroughCorners,
    RayKind::ThroughEdges, RayKind::FromCellPlane,    RayKind::FromBrickFace,   RayKind::FromBounds,
    RayKind::FromInside,   RayKind::Missing,          RayKind::Diagonal,        RayKind::Far};

const char* rayKindName(RayKind kind);

/// The same rays twice. `exact` lies on the same lines as the floats do; its directions are of unit length in double,
/// so that t of the two differs by one part in 10^7 at most.
struct RaySet {
  RayKind kind = RayKind::Random;
  std::vector<glm::vec3> origins;    ///< for the device, in voxels
  std::vector<glm::vec3> directions; ///< unit length as far as float can
  std::vector<OracleRay> exact;      ///< for references
};

/// `count` rays at the box outside of which a grid's field is zero. Bricks begin at multiples of 8.
/// @param box of whole coordinates, at least 2 voxels wide and less than 1e6 from 0: grid.indexBounds(), or that less
/// firstVoxel for the device's voxel space. @throws Error if it is another.
/// @param seed the same rays for the same seed, others for another.
RaySet rays(RayKind kind, std::size_t count, std::uint32_t seed, const Bounds3& box);

} // namespace tyndall::test
