// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "volume/brick_grid.h"

namespace tyndall::volume {

/// Integral of the density along worldOrigin + t * worldDirection over t in [tMin, tMax], times |worldDirection|: the
/// optical depth at a density scale of 1 per world unit. Exact up to rounding: within a cell of eight voxels a trilinear field is a cubic polynomial along a line, and
/// two-point Gauss-Legendre quadrature integrates cubics exactly. Infinite bounds are fine; 0 for an empty grid.
double exactOpticalDepth(const BrickGrid& grid, const glm::dvec3& worldOrigin, const glm::dvec3& worldDirection,
                         double tMin, double tMax);

/// Median of exactOpticalDepth over those of `lines` lines through the volume that meet any density: a fixed set of
/// parallel bundles along the axes and diagonals of the world. 0 if none does.
double medianOpticalDepth(const BrickGrid& grid, unsigned lines);

} // namespace tyndall::volume
