// SPDX-License-Identifier: Apache-2.0
#include "support/fixtures.h"

#include <glm/gtc/matrix_transform.hpp>
#include <openvdb/io/File.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointConversion.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <unistd.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <random>

namespace tyndall::test {
namespace {

namespace fs = std::filesystem;
using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::FloatGrid;
using openvdb::math::Transform;

using Grids = openvdb::GridPtrVec;

template <class GridT> typename GridT::Ptr named(const char* name, typename GridT::ValueType background) {
  typename GridT::Ptr grid = GridT::create(background);
  grid->setName(name);
  return grid;
}

/// A soft ball of radius 9 voxels about `centre`, as most fixtures hold.
template <class GridT> typename GridT::Ptr ball(const char* name, const Coord& centre = Coord(0), double peak = 1.0) {
  auto grid = named<GridT>(name, typename GridT::ValueType(0));
  auto accessor = grid->getAccessor();
  for (auto it = CoordBBox(Coord(-9), Coord(9)).begin(); it; ++it) {
    const double value = peak * (1.0 - (*it).asVec3d().length() / 9.5);
    if (value > 0.0) {
      accessor.setValue(centre + *it, typename GridT::ValueType(value));
    }
  }
  return grid;
}

openvdb::Mat4R toOpenVdb(const glm::dmat4& m) {
  openvdb::Mat4R result;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      result(column, row) = m[column][row]; // row vectors there, column vectors here
    }
  }
  return result;
}

void writeGrids(const fs::path& path, const Grids& grids) {
  openvdb::io::File file(path.string());
  file.write(grids);
}

FloatGrid::Ptr ramp(int axis, const glm::dmat4& worldFromIndex) {
  auto grid = named<FloatGrid>("density", 0.0f);
  auto accessor = grid->getAccessor();
  for (auto it = CoordBBox(Coord(0), Coord(kRampVoxels - 1)).begin(); it; ++it) {
    accessor.setValue(*it, kRampBase + kRampSlope * float((*it)[axis]));
  }
  grid->setTransform(Transform::createLinearTransform(toOpenVdb(worldFromIndex)));
  return grid;
}

FloatGrid::Ptr withTiles() {
  auto grid = ball<FloatGrid>("density", Coord(40, 40, 40));
  grid->fill(CoordBBox(Coord(0), Coord(31)), 0.5f);          // 8^3 tiles
  grid->fill(CoordBBox(Coord(128), Coord(255)), 0.25f);      // a 128^3 tile
  grid->tree().addTile(1, Coord(8, 40, 0), 0.75f, false);    // an inactive tile that is not background
  return grid;
}

FloatGrid::Ptr withBadValues() {
  auto grid = ball<FloatGrid>("density");
  auto accessor = grid->getAccessor();
  accessor.setValue(Coord(0, 0, 0), std::numeric_limits<float>::quiet_NaN());
  accessor.setValue(Coord(1, 0, 0), std::numeric_limits<float>::infinity());
  accessor.setValue(Coord(2, 0, 0), -std::numeric_limits<float>::infinity());
  for (int i = 0; i < 5; ++i) {
    accessor.setValue(Coord(0, 1 + i, 0), -0.5f);
  }
  return grid;
}

FloatGrid::Ptr frustum() {
  auto grid = named<FloatGrid>("density", 0.0f);
  grid->fill(CoordBBox(Coord(2, 2, 2), Coord(29, 29, 29)), 0.5f);
  const openvdb::BBoxd box(openvdb::Vec3d(0.0), openvdb::Vec3d(31.0));
  // Twice as wide at the far end; voxels 0.1 wide at the near plane, where a depth of 60 of them is 6 units.
  grid->setTransform(Transform::createFrustumTransform(box, 0.5, 60.0, 0.1));
  return grid;
}

Grids pointsOnly() {
  const std::vector<openvdb::Vec3R> positions{{0, 0, 0}, {1, 2, 3}, {4, 4, 4}};
  const openvdb::points::PointAttributeVector<openvdb::Vec3R> wrapper(positions);
  const Transform::Ptr transform = Transform::createLinearTransform(0.5);
  const auto index = openvdb::tools::createPointIndexGrid<openvdb::tools::PointIndexGrid>(wrapper, *transform);
  auto grid = openvdb::points::createPointDataGrid<openvdb::points::NullCodec, openvdb::points::PointDataGrid>(
      *index, wrapper, *transform);
  grid->setName("points");
  return {grid};
}

Grids vectorsOnly() {
  auto grid = named<openvdb::Vec3SGrid>("vel", openvdb::Vec3s(0.0f));
  grid->fill(CoordBBox(Coord(0), Coord(15)), openvdb::Vec3s(0.0f, 1.0f, 0.0f));
  return {grid};
}

Grids levelSet(const char* name) {
  auto grid = openvdb::tools::createLevelSetSphere<FloatGrid>(4.0f, openvdb::Vec3f(0.5f, -1.0f, 2.0f), 0.2f);
  grid->setName(name);
  return {grid};
}

Grids activeZeros() {
  auto grid = ball<FloatGrid>("density");
  grid->fill(CoordBBox(Coord(-30), Coord(-24)), 0.0f);
  return {grid};
}

Grids background(float value) {
  auto grid = named<FloatGrid>("density", value);
  auto accessor = grid->getAccessor();
  for (auto it = CoordBBox(Coord(3), Coord(12)).begin(); it; ++it) {
    if (((*it).x() + (*it).y()) % 3 == 0) {
      accessor.setValue(*it, 2.0f);
    }
  }
  return {grid};
}

Grids oddNames() {
  Grids grids{ball<FloatGrid>("density", Coord(0), 0.5), ball<FloatGrid>("density", Coord(30, 0, 0), 1.0),
              ball<FloatGrid>(""), ball<FloatGrid>("smoke density/2 \xc3\xa9")};
  return grids;
}

Grids twoBoxes() {
  Grids grids{ball<FloatGrid>("heat", Coord(2, 20, 2), 800.0), ball<FloatGrid>("density")};
  return grids;
}

Grids sharedTree() {
  auto first = ball<FloatGrid>("density");
  FloatGrid::Ptr second = first->copyWithNewTree();
  second->setTree(first->treePtr());
  second->setName("moved");
  second->setTransform(Transform::createLinearTransform(0.5));
  return {first, second};
}

Grids mask() {
  auto grid = openvdb::MaskGrid::create(false);
  grid->setName("mask");
  grid->tree().fill(CoordBBox(Coord(0), Coord(10, 4, 20)), true);
  return {grid};
}

Grids oneVoxel() {
  auto grid = named<FloatGrid>("density", 0.0f);
  grid->tree().setValue(Coord(-1, 7, 8), 3.0f);
  return {grid};
}

Grids thin() {
  auto grid = named<FloatGrid>("density", 0.0f);
  grid->denseFill(CoordBBox(Coord(0, 5, 0), Coord(40, 5, 40)), 1.5f);
  return {grid};
}

Grids extremes() {
  auto grid = named<FloatGrid>("density", 0.0f);
  const float values[] = {1e38f, 3e38f, 1e-38f, std::numeric_limits<float>::denorm_min(), 1.0f};
  for (int i = 0; i < 5; ++i) {
    grid->tree().setValue(Coord(3 * i, i, 0), values[i]);
  }
  return {grid};
}

Grids farTile() {
  auto grid = named<FloatGrid>("density", 0.0f);
  grid->tree().addTile(3, Coord(0), 0.5f, true); // 4096^3 voxels in one value
  grid->tree().setValue(Coord(20000, 20000, 20000), 1.0f);
  return {grid};
}

Grids withHalf(Grids grids) {
  for (const auto& grid : grids) {
    grid->setSaveFloatAsHalf(true);
  }
  return grids;
}

Grids transformed(const FloatGrid::Ptr& grid, const glm::dmat4& worldFromIndex) {
  grid->setTransform(Transform::createLinearTransform(toOpenVdb(worldFromIndex)));
  return {grid};
}

std::map<std::string, std::function<Grids()>> recipes() {
  std::map<std::string, std::function<Grids()>> list{
      {"plain", [] { return Grids{ball<FloatGrid>("density")}; }},
      {"half", [] { return withHalf({ball<FloatGrid>("density")}); }},
      {"double", [] { return Grids{ball<openvdb::DoubleGrid>("density")}; }},
      {"int32", [] { return Grids{ball<openvdb::Int32Grid>("count", Coord(0), 50.0)}; }},
      {"int64", [] { return Grids{ball<openvdb::Int64Grid>("count", Coord(0), 50.0)}; }},
      {"bool", [] { return Grids{ball<openvdb::BoolGrid>("inside", Coord(0), 5.0)}; }},
      {"mask", mask},
      {"tiles", [] { return Grids{withTiles()}; }},
      {"active_zeros", activeZeros},
      {"across_zero", [] { return Grids{ball<FloatGrid>("density", Coord(-3, 2, -5))}; }},
      {"level_set", [] { return levelSet("surface"); }},
      {"empty_grids", [] { return Grids{named<FloatGrid>("density", 0.0f), named<FloatGrid>("heat", 0.0f)}; }},
      {"no_grids", [] { return Grids{}; }},
      {"vec3_only", vectorsOnly},
      {"points_only", pointsOnly},
      {"two_boxes", twoBoxes},
      {"odd_names", oddNames},
      {"shared_tree", sharedTree},
      {"bad_values", [] { return Grids{withBadValues()}; }},
      {"background_one", [] { return background(1.0f); }},
      {"background_negative", [] { return background(-1.0f); }},
      {"one_voxel", oneVoxel},
      {"thin", thin},
      {"extremes", extremes},
      {"far_tile", farTile},
      {"frustum", [] { return Grids{frustum()}; }},
      {"large_offset", [] { return Grids{ball<FloatGrid>("density", Coord(1000000, -1000000, 1000000))}; }},
  };
  for (const NamedTransform& transform : affineTransforms()) {
    list["ball_" + transform.name] = [=] { return transformed(ball<FloatGrid>("density"), transform.worldFromIndex); };
    for (int axis = 0; axis < 3; ++axis) {
      list[std::string("ramp_") + "xyz"[axis] + "_" + transform.name] = [=] {
        return Grids{ramp(axis, transform.worldFromIndex)};
      };
    }
  }
  return list;
}

std::string bytesOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void writeBytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
}

} // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "tyndall_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw std::runtime_error("cannot make a temporary folder");
  }
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::vector<NamedTransform> affineTransforms() {
  const glm::dmat4 one(1.0);
  const glm::dmat4 rotated = glm::rotate(one, 0.7, glm::normalize(glm::dvec3(1.0, 2.0, -0.5)));
  glm::dmat4 sheared(1.0);
  sheared[1][0] = 0.4;
  sheared[2][1] = -0.3;
  const glm::dmat4 scaled = glm::scale(one, glm::dvec3(0.5, 2.0, 0.125));
  const glm::dmat4 moved = glm::translate(one, glm::dvec3(3.25, -7.5, 100.125));
  return {{"identity", one},   {"translated", moved}, {"rotated", rotated},
          {"sheared", sheared}, {"nonuniform", scaled}, {"mirrored", glm::scale(one, glm::dvec3(-1.0, 1.0, 1.0))},
          {"combined", moved * rotated * sheared * scaled}};
}

std::vector<std::string> writeFixtures(const fs::path& folder) {
  openvdb::initialize();
  std::vector<std::string> names;
  for (const auto& [name, recipe] : recipes()) {
    names.push_back(name + ".vdb");
    writeGrids(folder / names.back(), recipe());
  }
  names.push_back("streamed.vdb"); // no offsets in its directory
  std::ofstream stream(folder / names.back(), std::ios::binary);
  openvdb::io::Stream(stream).write(twoBoxes());
  return names;
}

std::vector<std::string> writeMalformed(const fs::path& folder) {
  openvdb::initialize();
  writeGrids(folder / "whole.vdb", {ball<FloatGrid>("density"), withTiles()});
  const std::string whole = bytesOf(folder / "whole.vdb");
  fs::remove(folder / "whole.vdb");
  std::vector<std::string> names;
  const auto add = [&](const std::string& name, const std::string& bytes) {
    names.push_back(name + ".vdb");
    writeBytes(folder / names.back(), bytes);
  };
  add("zero_bytes", "");
  add("text", "this is not a volume\n");
  add("nano", "NanoVDB0 and then something else");
  for (const std::size_t length : {4u, 8u, 20u, 60u, 100u, 150u, 300u, 600u}) {
    add("cut_" + std::to_string(length), whole.substr(0, length));
  }
  for (int tenth = 1; tenth < 10; ++tenth) {
    add("cut_tenth_" + std::to_string(tenth), whole.substr(0, whole.size() * std::size_t(tenth) / 10));
  }
  add("cut_last_byte", whole.substr(0, whole.size() - 1));
  std::mt19937 random(7);
  for (int i = 0; i < 60; ++i) { // a short run of noise somewhere behind the magic number
    std::string garbled = whole;
    const std::size_t at = 8 + random() % (i < 30 ? 1000u : unsigned(whole.size()) - 64u);
    for (std::size_t k = 0; k < 1 + random() % 24; ++k) {
      garbled[at + k] = char(random());
    }
    add("garbled_" + std::to_string(i), garbled);
  }
  return names;
}

} // namespace tyndall::test
