// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tyndall::geometry {

enum class PlyType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float, Double };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float;
  bool isList = false;
  PlyType countType = PlyType::Uint8; ///< of a list's length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// The place of a property, by any of its names; properties.size() = not there.
  std::size_t find(std::initializer_list<std::string_view> names) const;
};

enum class PlyEncoding { Ascii, LittleEndian, BigEndian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::Ascii;
  std::vector<PlyElement> elements;
  std::string textureFile; ///< "comment TextureFile NAME", as MeshLab writes it
  std::size_t bytes = 0;   ///< up to and with the line "end_header"
};

/// @throws Error with the line that it does not understand.
PlyHeader readPlyHeader(std::string_view file);

std::size_t sizeOf(PlyType type);

/// The values of a file's body, one after the other.
class PlyValues {
public:
  PlyValues(std::string_view body, PlyEncoding encoding) : rest_(body), encoding_(encoding) {}
  /// @throws Error at the end of the file, or where there is no number.
  double next(PlyType type);
  void skip(std::uint64_t bytes); ///< binary only
  std::size_t left() const { return rest_.size(); }

private:
  double nextWord();

  std::string_view rest_;
  PlyEncoding encoding_;
};

} // namespace tyndall::geometry
