// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "base/file.h"
#include "volume/generate.h"

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>

namespace tyndall::volume {
namespace {

using Leaf = openvdb::FloatTree::LeafNodeType;
constexpr int kLeafEdge = int(Leaf::DIM);

struct Ball {
  double centre; ///< on each axis, in index space
  double radius;

  /// 0 outside.
  float density(const openvdb::Coord& index) const {
    const glm::dvec3 place = (glm::dvec3(index.x(), index.y(), index.z()) - centre) / radius;
    const double squared = glm::dot(place, place);
    return squared < 1.0 ? float(1.0 - 0.5 * squared) : 0.0f;
  }
};

/// @return whether the leaf has a voxel in the ball.
bool fill(Leaf& leaf, const Ball& ball) {
  for (openvdb::Index i = 0; i < Leaf::SIZE; ++i) {
    const float density = ball.density(leaf.offsetToGlobalCoord(i));
    if (density > 0.0f) {
      leaf.setValueOn(i, density);
    }
  }
  return !leaf.isEmpty();
}

openvdb::FloatGrid::Ptr makeBall(int edge) {
  const Ball ball{0.5 * (edge - 1), kBallRadius * edge};
  const openvdb::FloatGrid::Ptr grid = openvdb::FloatGrid::create(0.0f);
  const int first = int(ball.centre - ball.radius) / kLeafEdge * kLeafEdge;
  const int last = int(std::ceil(ball.centre + ball.radius));
  for (int x = first; x <= last; x += kLeafEdge) {
    for (int y = first; y <= last; y += kLeafEdge) {
      for (int z = first; z <= last; z += kLeafEdge) {
        auto leaf = std::make_unique<Leaf>(openvdb::Coord(x, y, z), 0.0f, false);
        if (fill(*leaf, ball)) {
          grid->tree().addLeaf(leaf.release());
        }
      }
    }
  }
  grid->setName("density");
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  grid->setSaveFloatAsHalf(true);
  const openvdb::math::Transform::Ptr transform = openvdb::math::Transform::createLinearTransform(1.0 / edge);
  transform->postTranslate(openvdb::Vec3d(-ball.centre / edge));
  grid->setTransform(transform);
  return grid;
}

} // namespace

void writeBall(const std::filesystem::path& path, int edge) {
  TYNDALL_CHECK(edge >= kLeafEdge);
  openvdb::initialize();
  writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
    try {
      openvdb::io::File file(temporary.string());
      file.setCompression(openvdb::io::COMPRESS_ACTIVE_MASK);
      file.write({makeBall(edge)});
    } catch (const openvdb::Exception& problem) {
      fail("{}: cannot be written: {}", path.string(), problem.what());
    }
  });
}

} // namespace tyndall::volume
