// SPDX-License-Identifier: Apache-2.0
// OBJ by way of tinyobjloader, which reads lines and hands on what they say; indices are resolved and checked here.
#include "base/error.h"
#include "geometry/load_obj_parts.h"

#include <charconv>
#include <cmath>
#include <sstream>
#include <unordered_map>

namespace tyndall::geometry {
namespace {

/// Indices of a corner: position, uv, normal; -1 = none.
using Corner = std::array<std::int32_t, 3>;
constexpr std::int32_t kMissing = -2; ///< names what is not there

struct CornerHash {
  std::size_t operator()(const Corner& corner) const {
    std::uint64_t hash = 0;
    for (const std::int32_t index : corner) {
      hash = (hash ^ static_cast<std::uint32_t>(index)) * 0x9e3779b97f4a7c15U;
      hash ^= hash >> 29U;
    }
    return hash;
  }
};

/// What the file says, polygon by polygon.
struct ObjText {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> uvs;
  std::vector<Corner> corners;
  std::vector<std::uint32_t> sizes;        ///< corners of each polygon
  std::vector<std::int32_t> materials;     ///< of each polygon, -1 = none
  std::map<std::string, int> unknownNames; ///< materials that no library has
  std::int32_t material = -1;
};

/// 1 is the first, -1 the last one so far, 0 none [Wavefront 1992].
std::int32_t resolved(int index, std::size_t soFar) {
  if (index == 0) {
    return -1;
  }
  const std::int64_t place = index > 0 ? std::int64_t{index} - 1 : static_cast<std::int64_t>(soFar) + index;
  return place < 0 ? kMissing : static_cast<std::int32_t>(place);
}

tinyobj::callback_t callbacks() {
  tinyobj::callback_t to;
  to.vertex_cb = [](void* text, float x, float y, float z, float) {
    static_cast<ObjText*>(text)->positions.emplace_back(x, y, z);
  };
  to.normal_cb = [](void* text, float x, float y, float z) {
    static_cast<ObjText*>(text)->normals.emplace_back(x, y, z);
  };
  to.texcoord_cb = [](void* text, float u, float v, float) {
    static_cast<ObjText*>(text)->uvs.emplace_back(u, 1.0F - v); // OBJ: v = 0 at the bottom
  };
  to.index_cb = [](void* data, tinyobj::index_t* indices, int count) {
    auto& text = *static_cast<ObjText*>(data);
    for (int i = 0; i < count; ++i) {
      const std::int32_t position = resolved(indices[i].vertex_index, text.positions.size());
      text.corners.push_back({position == -1 ? kMissing : position,
                              resolved(indices[i].texcoord_index, text.uvs.size()),
                              resolved(indices[i].normal_index, text.normals.size())});
    }
    text.sizes.push_back(static_cast<std::uint32_t>(count));
    text.materials.push_back(text.material);
  };
  to.usemtl_cb = [](void* data, const char* name, int material) {
    auto& text = *static_cast<ObjText*>(data);
    text.material = material;
    if (material < 0) {
      ++text.unknownNames[name];
    }
  };
  return to;
}

/// UTF-8 whatever the byte order mark says, and lines joined where a backslash ends them.
std::string plainText(std::string bytes) {
  const bool bigEndian = bytes.starts_with("\xfe\xff");
  if (bigEndian || bytes.starts_with("\xff\xfe")) {
    std::string text;
    for (std::size_t i = 2; i + 1 < bytes.size(); i += 2) { // numbers and keywords are ASCII; names lose their accents
      const char low = bytes[i + (bigEndian ? 1 : 0)];
      const char high = bytes[i + (bigEndian ? 0 : 1)];
      text += high == 0 && static_cast<unsigned char>(low) < 128 ? low : '?';
    }
    bytes = std::move(text);
  } else if (bytes.starts_with("\xef\xbb\xbf")) {
    bytes.erase(0, 3);
  }
  for (std::size_t at = bytes.find('\\'); at != std::string::npos; at = bytes.find('\\', at + 1)) {
    const std::size_t end = bytes.find_first_not_of('\r', at + 1);
    if (end != std::string::npos && bytes[end] == '\n') {
      std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.begin() + static_cast<std::ptrdiff_t>(end) + 1,
                ' ');
    }
  }
  return bytes;
}

/// What the vertices' lines hold that tinyobjloader does not tell.
struct VertexLines {
  std::vector<std::size_t> unreadable; ///< numbers of the vertices that have no position
  bool coloured = false;
};

/// Position and colour are six numbers, seven with a weight [Wavefront 1992; the colour is a later custom].
bool hasColour(std::string_view line) {
  int words = 0;
  for (std::size_t at = line.find_first_not_of(" \t"); at != std::string_view::npos && line[at] != '#'; ++words) {
    at = line.find_first_not_of(" \t", std::min(line.find_first_of(" \t", at), line.size()));
  }
  return words >= 6;
}

/// Whether three finite numbers follow. tinyobjloader takes 0 for what it cannot read, NaN among it.
bool hasPosition(std::string_view line) {
  for (int i = 0; i < 3; ++i) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    line.remove_prefix(line.starts_with('+') ? 1 : 0);
    double value = 0.0;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
    if (end == line.data() || error == std::errc::invalid_argument || !std::isfinite(value)) {
      return false;
    }
    line.remove_prefix(std::min(line.find_first_of(" \t"), line.size()));
  }
  return true;
}

VertexLines vertexLinesOf(std::string_view text) {
  VertexLines lines;
  std::size_t vertex = 0;
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find_first_of("\r\n"));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (line.starts_with("v ") || line.starts_with("v\t")) {
      if (!hasPosition(line.substr(2))) {
        lines.unreadable.push_back(vertex);
      }
      lines.coloured = lines.coloured || hasColour(line.substr(2));
      ++vertex;
    }
  }
  return lines;
}

/// Polygons to triangles, corners to vertices.
class ObjMesh {
public:
  ObjMesh(const ObjText& text, Model& model, Mended& mended)
      : text_(text), model_(model), mended_(mended), untextured_(model) {}

  Mesh build() {
    std::size_t first = 0;
    for (std::size_t i = 0; i < text_.sizes.size(); ++i) {
      add(std::span(text_.corners).subspan(first, text_.sizes[i]), text_.materials[i]);
      first += text_.sizes[i];
    }
    if (!hasNormals_) {
      mesh_.normals.clear();
    }
    if (!hasUvs_) {
      mesh_.uvs.clear();
    }
    if (tooFew_ > 0) {
      model_.warnings.push_back(fmt::format("{} faces with less than 3 corners were left out.", tooFew_));
    }
    return std::move(mesh_);
  }

private:
  void add(std::span<const Corner> corners, std::int32_t material) {
    if (corners.size() < 3) {
      ++tooFew_;
      return;
    }
    points_.clear();
    bool complete = true;
    for (const Corner& corner : corners) {
      if (corner[0] < 0 || static_cast<std::size_t>(corner[0]) >= text_.positions.size()) {
        ++mended_.badIndices;
        return;
      }
      points_.emplace_back(text_.positions[static_cast<std::size_t>(corner[0])]);
      complete &= corner[1] >= 0;
    }
    mended_.fannedPolygons += !cutter_.cut(points_, cut_);
    if (mesh_.triangles.size() + cut_.size() > kMostTriangles) {
      fail("it holds more than {} triangles; split the file", kMostTriangles);
    }
    std::uint32_t used = material < 0 ? kNone : static_cast<std::uint32_t>(material);
    used = complete ? used : untextured_.of(used);
    for (const std::array<std::uint32_t, 3>& triangle : cut_) {
      const std::uint32_t a = vertex(corners[triangle[0]]); // one after the other: they number the vertices
      const std::uint32_t b = vertex(corners[triangle[1]]);
      const std::uint32_t c = vertex(corners[triangle[2]]);
      mesh_.triangles.emplace_back(a, b, c);
      mesh_.materials.push_back(used);
    }
  }

  std::uint32_t vertex(const Corner& corner) {
    const auto [place, isNew] = vertices_.try_emplace(corner, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (isNew) {
      mesh_.positions.push_back(text_.positions[static_cast<std::size_t>(corner[0])]);
      const bool hasUv = corner[1] >= 0 && static_cast<std::size_t>(corner[1]) < text_.uvs.size();
      const bool hasNormal = corner[2] >= 0 && static_cast<std::size_t>(corner[2]) < text_.normals.size();
      mesh_.uvs.push_back(hasUv ? text_.uvs[static_cast<std::size_t>(corner[1])] : glm::vec2(0.0F));
      mesh_.normals.push_back(hasNormal ? text_.normals[static_cast<std::size_t>(corner[2])] : glm::vec3(0.0F));
      mended_.badUvs += !hasUv && corner[1] != -1;
      mended_.badNormals += hasNormal ? mesh_.normals.back() == glm::vec3(0.0F) : corner[2] != -1;
      hasUvs_ |= hasUv;
      hasNormals_ |= hasNormal;
    }
    return place->second;
  }

  const ObjText& text_;
  Model& model_;
  Mended& mended_;
  Untextured untextured_;
  PolygonCutter cutter_;
  Mesh mesh_;
  std::unordered_map<Corner, std::uint32_t, CornerHash> vertices_;
  std::vector<glm::dvec3> points_;
  std::vector<std::array<std::uint32_t, 3>> cut_;
  std::size_t tooFew_ = 0;
  bool hasNormals_ = false;
  bool hasUvs_ = false;
};

} // namespace

Model loadObj(const std::filesystem::path& path, Mended& mended) {
  const std::string text = plainText(readBytes(path, std::uint64_t{1} << 34));
  const VertexLines vertexLines = vertexLinesOf(text);
  std::istringstream stream(text);
  Model model;
  ObjText said;
  MaterialLibraries libraries(path.parent_path());
  std::string warnings;
  std::string errors;
  if (!tinyobj::LoadObjWithCallback(stream, callbacks(), &said, &libraries, &warnings, &errors)) {
    fail("no OBJ that can be read ({}); export it again", errors);
  }
  for (const std::size_t vertex : vertexLines.unreadable) {
    if (vertex < said.positions.size()) {
      said.positions[vertex] = glm::vec3(std::numeric_limits<float>::quiet_NaN());
    }
  }
  if (said.sizes.empty()) {
    fail("it holds {} points and no faces, and Tyndall draws surfaces only; export it with its faces",
         said.positions.size());
  }
  libraries.convert(path.parent_path(), model);
  if (vertexLines.coloured) {
    model.warnings.push_back("Passed over: the vertices' colours.");
  }
  for (const auto& [name, uses] : said.unknownNames) {
    model.warnings.push_back(fmt::format("No library has the material \"{}\": the object's own is used.", name));
  }
  model.meshes.push_back(ObjMesh(said, model, mended).build());
  model.meshes.back().name = path.stem().string();
  model.nodes.push_back({});
  return model;
}

} // namespace tyndall::geometry
