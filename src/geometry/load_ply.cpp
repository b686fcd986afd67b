// SPDX-License-Identifier: Apache-2.0
// PLY [Turk 1994]: vertices and polygons, ASCII and binary. Read without a library, since those that read it believe
// the counts of the header.
#include "base/error.h"
#include "geometry/load_parts.h"
#include "geometry/load_ply_header.h"

#include <algorithm>
#include <cmath>

namespace tyndall::geometry {
namespace {

float asFloat(double value) {
  return static_cast<float>(value); // beyond its range: infinite, left out as such
}

class PlyReader {
public:
  PlyReader(const PlyHeader& header, std::string_view body, Model& model, Mended& mended)
      : header_(header), values_(body, header.encoding), model_(model), mended_(mended) {}

  Mesh read() {
    for (const PlyElement& element : header_.elements) {
      checkCount(element);
      if (element.name == "vertex") {
        readVertices(element);
      } else if (element.name == "face") {
        readFaces(element);
      } else {
        skip(element);
        passedOver_.push_back(fmt::format("{} ({})", element.name, element.count));
      }
    }
    if (!passedOver_.empty()) {
      model_.warnings.push_back(fmt::format("Passed over: {}.", joinNames(passedOver_)));
    }
    if (tooFew_ > 0) {
      model_.warnings.push_back(fmt::format("{} faces with less than 3 corners were left out.", tooFew_));
    }
    if (faces_ == 0) {
      fail("it holds {} points and no faces, and Tyndall draws surfaces only; export it with its faces",
           mesh_.positions.size());
    }
    mesh_.materials.assign(mesh_.triangles.size(), kNone);
    return std::move(mesh_);
  }

private:
  /// Bytes that each property takes at least; a digit and a space in ASCII, where the last has no space after it.
  void checkCount(const PlyElement& element) const {
    std::uint64_t smallest = 0;
    for (const PlyProperty& property : element.properties) {
      smallest +=
          header_.encoding == PlyEncoding::Ascii ? 2 : sizeOf(property.isList ? property.countType : property.type);
    }
    if (smallest > 0 && element.count > (values_.left() + 1) / smallest) {
      fail("its header announces {} of \"{}\", more than its {} bytes can hold: it is cut off or damaged; export it "
           "again",
           element.count, element.name, values_.left());
    }
  }

  /// The length of a list. At least a byte (in ASCII two) for each value must follow.
  std::uint64_t lengthOf(const PlyProperty& list) {
    const double length = values_.next(list.countType);
    const double most = static_cast<double>(values_.left() + 1) /
                        (header_.encoding == PlyEncoding::Ascii ? 2.0 : static_cast<double>(sizeOf(list.type)));
    if (!(length >= 0.0 && length <= most) || length != std::floor(length)) {
      fail("it has a list of {} values, which the file cannot hold: it is damaged; export it again", length);
    }
    return static_cast<std::uint64_t>(length);
  }

  void skip(const PlyProperty& property) {
    const std::uint64_t count = property.isList ? lengthOf(property) : 1;
    for (std::uint64_t i = 0; i < count; ++i) {
      values_.next(property.type);
    }
  }

  void skip(const PlyElement& element) {
    if (element.properties.empty()) {
      return;
    }
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        skip(property);
      }
    }
  }

  void readVertices(const PlyElement& element) {
    const std::size_t none = element.properties.size();
    const std::array<std::size_t, 8> places{element.find({"x"}),
                                            element.find({"y"}),
                                            element.find({"z"}),
                                            element.find({"nx"}),
                                            element.find({"ny"}),
                                            element.find({"nz"}),
                                            element.find({"s", "u", "texture_u"}),
                                            element.find({"t", "v", "texture_v"})};
    if (std::ranges::find(places.begin(), places.begin() + 3, none) != places.begin() + 3) {
      fail("its vertices have no x, y and z; export it again");
    }
    if (element.count >= kNone) {
      fail("its {} vertices are more than Tyndall takes; split the file", element.count);
    }
    const bool hasNormals = places[3] != none && places[4] != none && places[5] != none;
    const bool hasUvs = places[6] != none && places[7] != none;
    std::vector<double> row(none + 1, 0.0); // the last: of properties that are not there
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (std::size_t p = 0; p < none; ++p) {
        if (element.properties[p].isList) {
          skip(element.properties[p]);
        } else {
          row[p] = values_.next(element.properties[p].type);
        }
      }
      mesh_.positions.emplace_back(asFloat(row[places[0]]), asFloat(row[places[1]]), asFloat(row[places[2]]));
      if (hasNormals) {
        mesh_.normals.emplace_back(asFloat(row[places[3]]), asFloat(row[places[4]]), asFloat(row[places[5]]));
        mended_.badNormals += mesh_.normals.back() == glm::vec3(0.0F);
      }
      if (hasUvs) { // v = 0 at the bottom
        mesh_.uvs.emplace_back(asFloat(row[places[6]]), asFloat(1.0 - row[places[7]]));
      }
    }
    if (element.find({"red", "diffuse_red", "r"}) != none) {
      passedOver_.emplace_back("the vertices' colours");
    }
  }

  void readFaces(const PlyElement& element) {
    const std::size_t indices = element.find({"vertex_indices", "vertex_index"});
    if (indices == element.properties.size() || !element.properties[indices].isList) {
      fail("its faces have no list vertex_indices; export it again");
    }
    if (element.find({"texcoord"}) != element.properties.size()) {
      passedOver_.emplace_back("the faces' texture coordinates");
    }
    std::vector<double> corners;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        if (p != indices) {
          skip(element.properties[p]);
          continue;
        }
        const std::uint64_t count = lengthOf(element.properties[p]);
        corners.clear();
        for (std::uint64_t c = 0; c < count; ++c) {
          corners.push_back(values_.next(element.properties[p].type));
        }
      }
      addPolygon(corners);
    }
    faces_ += element.count;
  }

  void addPolygon(const std::vector<double>& corners) {
    points_.clear();
    if (corners.size() < 3) {
      ++tooFew_;
      return;
    }
    for (const double corner : corners) {
      if (!(corner >= 0.0 && corner < static_cast<double>(mesh_.positions.size()))) {
        ++mended_.badIndices;
        return;
      }
      points_.emplace_back(mesh_.positions[static_cast<std::size_t>(corner)]);
    }
    mended_.fannedPolygons += !cutter_.cut(points_, cut_);
    if (mesh_.triangles.size() + cut_.size() > kMostTriangles) {
      fail("it holds more than {} triangles; split the file", kMostTriangles);
    }
    for (const std::array<std::uint32_t, 3>& t : cut_) {
      mesh_.triangles.emplace_back(static_cast<std::uint32_t>(corners[t[0]]), static_cast<std::uint32_t>(corners[t[1]]),
                                   static_cast<std::uint32_t>(corners[t[2]]));
    }
  }

  const PlyHeader& header_;
  PlyValues values_;
  Model& model_;
  Mended& mended_;
  PolygonCutter cutter_;
  Mesh mesh_;
  std::vector<std::string> passedOver_;
  std::vector<glm::dvec3> points_;
  std::vector<std::array<std::uint32_t, 3>> cut_;
  std::uint64_t faces_ = 0;
  std::size_t tooFew_ = 0;
};

} // namespace

Model loadPly(const std::filesystem::path& path, Mended& mended) {
  const std::string file = readBytes(path);
  const PlyHeader header = readPlyHeader(file);
  Model model;
  Mesh mesh = PlyReader(header, std::string_view(file).substr(header.bytes), model, mended).read();
  mesh.name = path.stem().string();
  if (!header.textureFile.empty() && !mesh.uvs.empty()) {
    Material material;
    material.name = header.textureFile;
    material.colour = glm::dvec3(1.0);
    material.colourTexture.texture = ImageFiles(path.parent_path(), model).load(header.textureFile, true, Wrap::Repeat);
    if (material.colourTexture.texture != kNone) {
      model.materials.push_back(material);
      mesh.materials.assign(mesh.triangles.size(), 0);
    }
  }
  model.meshes.push_back(std::move(mesh));
  model.nodes.push_back({});
  return model;
}

} // namespace tyndall::geometry
