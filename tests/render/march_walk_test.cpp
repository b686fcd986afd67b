// SPDX-License-Identifier: Apache-2.0
// Walks from cell to cell against regular tracking in double (A7), on every kind of ray on which walks go wrong.
#include "render/march_probe.h"
#include "support/ray_reference_grid.h"
#include "support/ray_sets.h"
#include "support/render_fixture.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall::test {
namespace {

using gpu_scene::PackedMedia;
using volume::BrickGrid;

constexpr double kDensityScale = 0.1; ///< so that no piece is cut for being dense
constexpr std::size_t kRaysPerKind = 16384;
const glm::ivec3 kSize(101, 75, 93);
const glm::ivec3 kFirst(-5, 3, -17);

/// A fraction in [0, 1) for a place.
double hashed(const glm::ivec3& place, std::uint32_t salt) {
  std::uint32_t h = salt * 0x9e3779b9u;
  for (const std::uint32_t part : {std::uint32_t(place.x), std::uint32_t(place.y), std::uint32_t(place.z)}) {
    h = (h ^ part) * 0x85ebca6bu;
    h ^= h >> 15;
  }
  return double((h * 0xc2b2ae35u) >> 8) / double(1u << 24);
}

/// Spikes in filled bricks among empty ones and empty coarse cells. Some filled bricks begin with a layer of zeros,
/// so that the bricks before them are empty; where others follow an empty brick, only their first layer fills it.
BrickGrid islands(const glm::dmat4& worldFromIndex) {
  return gridOf(kSize, kFirst, worldFromIndex, [](const glm::ivec3& index) {
    const glm::ivec3 brick = index >> 3;
    const glm::ivec3 inCoarse = index & 31;
    const bool firstLayer = inCoarse.x == 0 || inCoarse.y == 0 || inCoarse.z == 0;
    if (hashed(brick >> 2, 1) < 0.55 || hashed(brick, 2) < 0.4 || (firstLayer && hashed(brick >> 2, 3) < 0.8)) {
      return 0.0;
    }
    const double u = hashed(index, 4);
    return u < 0.02 ? 1.0 + 50.0 * u : (u < 0.1 ? 0.0 : 0.3 + 0.4 * u);
  });
}

/// What a ray may be granted.
struct RayScale {
  double maximum = 0.0;   ///< of the field in the cells that the ray crosses, and in those beside them
  double length = 0.0;    ///< in the field's bounds, world units
  double reach = 0.0;     ///< what floats must add up on the way, voxels
  double crossings = 0.0; ///< planes of cells between where it enters the bounds and where it leaves them
};

class RayScales {
public:
  explicit RayScales(const BrickGrid& grid) : grid_(grid), indexFromWorld_(glm::inverse(grid.worldFromIndex)) {
    const glm::ivec3 cells = kSize + 1;
    for (int i = 0; i < cells.x * cells.y * cells.z; ++i) {
      const glm::ivec3 cell = kFirst - 1 + glm::ivec3(i % cells.x, i / cells.x % cells.y, i / cells.x / cells.y);
      float most = 0.0f;
      for (int v = 0; v < 64; ++v) {
        most = std::max(most, grid.voxel(cell - 1 + glm::ivec3(v & 3, (v >> 2) & 3, v >> 4)));
      }
      maxima_.push_back(most);
    }
  }

  RayScale of(const OracleRay& world) const {
    // A float may see a ray inside the bounds that passes just outside them.
    constexpr double kMargin = 0.01;
    const Bounds3 bounds = grid_.indexBounds();
    const OracleRay ray = through(indexFromWorld_, world);
    const glm::dvec2 span = spanInBox(ray, {bounds.min - kMargin, bounds.max + kMargin}, kInfinity);
    RayScale scale;
    if (span.x >= span.y) {
      return scale;
    }
    scale.length = span.y - span.x;
    const glm::dvec3 way = glm::abs(ray.direction) * scale.length;
    scale.crossings = std::ceil(way.x) + std::ceil(way.y) + std::ceil(way.z);
    // Voxel space is a sum of products of what lies between the ray's origin and the scene's centre.
    const glm::dvec3 centre = grid_.worldBounds().centre();
    const glm::dvec3 away = glm::abs(world.origin - centre);
    const glm::dvec3 middle(indexFromWorld_ * glm::dvec4(centre, 1.0));
    glm::dvec3 terms = glm::abs(middle - glm::dvec3(grid_.firstVoxel));
    for (int axis = 0; axis < 3; ++axis) {
      terms += glm::abs(glm::dvec3(indexFromWorld_[axis])) * away[axis];
    }
    scale.reach = std::max({terms.x, terms.y, terms.z}) + glm::length(ray.direction) * span.y;
    const glm::ivec3 low(bounds.min);
    const glm::ivec3 high(bounds.max);
    walkCells(ray, low - 1, high + 1, 1, span, [&](const glm::ivec3& cell, double, double) {
      const glm::ivec3 c = glm::clamp(cell, low, high - 1) - low;
      const int at = c.x + (kSize.x + 1) * (c.y + (kSize.y + 1) * c.z);
      scale.maximum = std::max(scale.maximum, double(maxima_[std::size_t(at)]));
      return true;
    });
    return scale;
  }

private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const BrickGrid& grid_;
  glm::dmat4 indexFromWorld_;
  std::vector<float> maxima_; ///< per cell
};

/// What optical depth may be off by. Rounding moves a ray by `places` voxels, where the field is another by at most
/// sqrt(3) times its maximum per voxel; each step rounds once more what it adds to.
double depthTolerance(const RayScale& scale) {
  constexpr double kUnit = 0x1p-24;
  const double places = 2.0 * kUnit * scale.reach;
  return kDensityScale * scale.maximum * scale.length * (std::sqrt(3.0) * places + 4.0 * kUnit);
}

/// Rays that are wrong, of one kind and one way to walk them.
struct Findings {
  std::size_t lost = 0;   ///< optical depth beyond the tolerance
  std::size_t longer = 0; ///< more steps than planes to cross
  std::size_t cut = 0;
  double worst = 0.0; ///< error in tolerances
};

struct WalkCase {
  TestScene test;
  glm::dmat4 worldFromIndex;
  RayScales scales;

  explicit WalkCase(const glm::dmat4& map)
      : test(sceneOf(map)), worldFromIndex(map), scales(test.volumes.grids.front()) {}
  static TestScene sceneOf(const glm::dmat4& map) {
    TestScene test;
    test.grid(islands(map), kDensityScale);
    return test;
  }
  const BrickGrid& grid() const { return test.volumes.grids.front(); }

  MarchRays rays(const MarchProbe& probe, RayKind kind, std::size_t count) const {
    std::vector<OracleRay> world = test::rays(kind, count, 7, grid().indexBounds()).exact;
    for (OracleRay& ray : world) {
      ray = through(worldFromIndex, ray);
    }
    return probe.rays(world);
  }
};

/// Exact floats: planes lie at whole numbers and halves. Made once.
const WalkCase& plainCase() {
  static const WalkCase walk(glm::dmat4(1.0));
  return walk;
}

Findings judge(const WalkCase& walk, const MarchRays& rays, const std::vector<interop::MarchProbeResult>& results,
               bool march) {
  const std::vector<double> exact = opticalDepths(walk.grid(), walk.worldFromIndex, rays.exact);
  std::vector<Findings> single(results.size());
  tbb::parallel_for(std::size_t(0), results.size(), [&](std::size_t i) {
    const RayScale scale = walk.scales.of(rays.exact[i]);
    const interop::MarchProbeResult& result = results[i];
    // A transmittance is a product with two roundings a step, exp and the product's own.
    const double product = march ? 3.0 * 0x1p-24 * result.steps : 0.0;
    const double depth = march ? -std::log(double(result.transmittance)) : double(result.depth);
    const double error = std::abs(depth - kDensityScale * exact[i]);
    const double tolerance = depthTolerance(scale) + product;
    single[i].worst = error == 0.0 ? 0.0 : error / tolerance;
    single[i].lost = single[i].worst <= 1.0 ? 0 : 1;
    // Either side of a plane may be taken at both ends, and the way in is a step of a march. A ray in a plane may find
    // itself before that plane again wherever a brick is skipped, and crosses it once more.
    single[i].longer = double(result.steps) > 1.125 * scale.crossings + 9.0 ? 1 : 0;
    single[i].cut = result.cut;
  });
  Findings all;
  for (const Findings& one : single) {
    all.lost += one.lost;
    all.longer += one.longer;
    all.cut += one.cut;
    all.worst = std::max(all.worst, one.worst);
  }
  return all;
}

Findings marched(const WalkCase& walk, const MarchProbe& probe, RayKind kind, std::size_t count) {
  const MarchRays rays = walk.rays(probe, kind, count);
  return judge(walk, rays, probe.march(rays), true);
}

Findings walked(const WalkCase& walk, const MarchProbe& probe, RayKind kind, std::size_t count, std::uint32_t mode) {
  const MarchRays rays = walk.rays(probe, kind, count);
  return judge(walk, rays, probe.walk(rays, mode), false);
}

void expectSound(const Findings& found, const char* what) {
  EXPECT_EQ(found.lost, 0u) << what << ": the worst error is " << found.worst << " times what floats are granted";
  EXPECT_EQ(found.longer, 0u) << what;
  EXPECT_EQ(found.cut, 0u) << what;
}

void checkEveryKind(const WalkCase& walk, std::size_t count) {
  const MarchProbe probe(walk.test);
  for (const RayKind kind : kRayKinds) {
    SCOPED_TRACE(rayKindName(kind));
    expectSound(walked(walk, probe, kind, count, interop::kProbeDepth), "walk");
    expectSound(marched(walk, probe, kind, count), "march");
  }
}

TEST(MarchWalks, AreExactOnEveryKindOfRay) { checkEveryKind(plainCase(), kRaysPerKind * effort()); }

TEST(MarchWalks, AreExactThroughAMapThatRounds) {
  checkEveryKind(WalkCase(affineMaps().back().worldFromIndex), kRaysPerKind / 4 * effort());
}

/// Bricks that the islands are for.
struct Emptiness {
  std::size_t bricks = 0;   ///< empty, in coarse cells that are not
  std::size_t coarse = 0;   ///< empty coarse cells
  std::size_t farFaces = 0; ///< bricks whose own voxels are 0 and whose far neighbours' first ones are not
};

bool ownVoxelsAreZero(const BrickGrid& grid, std::size_t brick) {
  const auto b = static_cast<int>(brick);
  const glm::ivec3 place(b % grid.brickCount.x, b / grid.brickCount.x % grid.brickCount.y,
                         b / grid.brickCount.x / grid.brickCount.y);
  for (int v = 0; v < volume::kBrickVoxels; ++v) {
    if (grid.voxel(grid.firstVoxel + 8 * place + glm::ivec3(v & 7, (v >> 3) & 7, v >> 6)) != 0.0f) {
      return false;
    }
  }
  return true;
}

Emptiness emptinessOf(const BrickGrid& grid) {
  Emptiness result;
  result.coarse = std::size_t(std::count(grid.coarseMax.begin(), grid.coarseMax.end(), 0.0f));
  for (std::size_t b = 0; b < grid.bricks.size(); ++b) {
    result.bricks += grid.ranges[b].max == 0.0f ? 1 : 0;
    result.farFaces += grid.ranges[b].max > 0.0f && ownVoxelsAreZero(grid, b) ? 1 : 0;
  }
  return result;
}

TEST(MarchWalks, MeetEveryKindOfEmptiness) {
  const Emptiness found = emptinessOf(plainCase().grid());
  EXPECT_GE(found.coarse, 5u);
  EXPECT_GT(found.bricks, 64u * found.coarse / 2u); // and not only in empty coarse cells
  EXPECT_GT(found.farFaces, 50u);
}

/// A bug in how the grid is packed must cost rays something.
void expectSeen(const char* what, const MarchProbe::Plant& plant) {
  const WalkCase& walk = plainCase();
  const MarchProbe probe(walk.test, interop::kBugNone, plant);
  EXPECT_GT(marched(walk, probe, RayKind::Random, 2000).lost, 3u) << what;
}

TEST(MarchWalks, SkippedRegionsAreSeen) {
  const BrickGrid& grid = plainCase().grid();
  expectSeen("bricks are judged by their own voxels", [&](PackedMedia& media) {
    std::vector<float>& maxima = media.placements.front().maxima;
    for (std::size_t b = 0; b < maxima.size(); ++b) {
      maxima[b] = ownVoxelsAreZero(grid, b) ? 0.0f : maxima[b];
    }
  });
  expectSeen("coarse cells are judged by one brick", [](PackedMedia& media) {
    std::vector<float>& maxima = media.placements.front().coarseMaxima;
    std::fill(maxima.begin(), maxima.end(), 0.0f);
  });
  expectSeen("one brick is missing", [](PackedMedia& media) {
    std::vector<float>& maxima = media.placements.front().maxima;
    *std::max_element(maxima.begin() + std::ptrdiff_t(maxima.size() / 2), maxima.end()) = 0.0f;
  });
  expectSeen("the bounds end a voxel early",
             [](PackedMedia& media) { media.placements.front().header.boundsMax -= 1.0f; });
}

TEST(MarchWalks, LookupsBesideTheirPlaceAreSeen) {
  const WalkCase& walk = plainCase();
  const MarchProbe probe(walk.test, interop::kBugHalfVoxel);
  EXPECT_GT(marched(walk, probe, RayKind::Random, 2000).lost, 1000u);
}

/// A walk that finds its cells by position stalls on planes, or takes a cell twice, on the kinds of rays made for it.
TEST(MarchWalks, WalksWithoutProgressAreSeen) {
  const WalkCase& walk = plainCase();
  const MarchProbe probe(walk.test);
  for (const RayKind kind : {RayKind::GrazingFromPlane, RayKind::ThroughCorners, RayKind::FromBrickFace}) {
    const Findings found = walked(walk, probe, kind, 2000, interop::kProbeStateless);
    EXPECT_GT(found.longer, 10u) << rayKindName(kind);
    EXPECT_GT(found.lost, 10u) << rayKindName(kind);
  }
}

} // namespace
} // namespace tyndall::test
