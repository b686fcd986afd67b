// SPDX-License-Identifier: Apache-2.0
#include "geometry/load_ply_header.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <limits>

namespace tyndall::geometry {
namespace {

std::vector<std::string_view> wordsOf(std::string_view line) {
  std::vector<std::string_view> words;
  for (;;) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
    if (line.empty()) {
      return words;
    }
    words.push_back(line.substr(0, line.find_first_of(" \t\r")));
    line.remove_prefix(words.back().size());
  }
}

PlyType typeOf(std::string_view name) {
  struct Name {
    std::string_view first, second;
  };
  constexpr std::array<Name, 8> kNames{Name{"char", "int8"}, {"uchar", "uint8"},   {"short", "int16"},
                                       {"ushort", "uint16"}, {"int", "int32"},     {"uint", "uint32"},
                                       {"float", "float32"}, {"double", "float64"}};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (name == kNames[i].first || name == kNames[i].second) {
      return static_cast<PlyType>(i);
    }
  }
  fail("its header names the unknown type \"{}\"; export it again", name.substr(0, 40));
}

[[noreturn]] void failAtLine(std::string_view line) {
  fail("its header has the line \"{}\", which PLY does not know; export it again", line.substr(0, 60));
}

PlyProperty propertyOf(const std::vector<std::string_view>& words, std::string_view line) {
  if (words.size() == 5 && words[1] == "list") {
    const PlyType countType = typeOf(words[2]);
    if (countType == PlyType::Float || countType == PlyType::Double) {
      failAtLine(line);
    }
    return {std::string(words[4]), typeOf(words[3]), true, countType};
  }
  if (words.size() == 3) {
    return {std::string(words[2]), typeOf(words[1]), false, PlyType::Uint8};
  }
  failAtLine(line);
}

PlyElement elementOf(const std::vector<std::string_view>& words, std::string_view line) {
  PlyElement element;
  if (words.size() != 3) {
    failAtLine(line);
  }
  element.name = words[1];
  const auto [end, error] = std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
  if (error != std::errc() || end != words[2].data() + words[2].size()) {
    failAtLine(line);
  }
  return element;
}

PlyEncoding encodingOf(std::string_view name) {
  if (name == "ascii") {
    return PlyEncoding::Ascii;
  }
  if (name == "binary_little_endian") {
    return PlyEncoding::LittleEndian;
  }
  if (name == "binary_big_endian") {
    return PlyEncoding::BigEndian;
  }
  fail("its format is \"{}\", not ascii, binary_little_endian or binary_big_endian; export it again",
       name.substr(0, 40));
}

/// False at the line that ends the header.
bool readLine(std::string_view line, PlyHeader& header) {
  const std::vector<std::string_view> words = wordsOf(line);
  if (words.empty() || words[0] == "obj_info") {
    return true;
  }
  if (words[0] == "comment") {
    if (words.size() >= 3 && words[1] == "TextureFile") {
      header.textureFile = std::string(words[2].data(), words.back().data() + words.back().size());
    }
  } else if (words[0] == "format" && words.size() >= 2) {
    header.encoding = encodingOf(words[1]);
  } else if (words[0] == "element") {
    header.elements.push_back(elementOf(words, line));
  } else if (words[0] == "property" && !header.elements.empty()) {
    header.elements.back().properties.push_back(propertyOf(words, line));
  } else if (words[0] != "end_header") {
    failAtLine(line);
  }
  return words[0] != "end_header";
}

template <class T>
double numberFrom(const std::array<char, 8>& bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof(T));
  return static_cast<double>(value);
}

} // namespace

std::size_t PlyElement::find(std::initializer_list<std::string_view> names) const {
  const auto found = std::ranges::find_if(
      properties, [&](const PlyProperty& property) { return std::ranges::find(names, property.name) != names.end(); });
  return static_cast<std::size_t>(found - properties.begin());
}

std::size_t sizeOf(PlyType type) {
  constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

PlyHeader readPlyHeader(std::string_view file) {
  if (!file.starts_with("ply\n") && !file.starts_with("ply\r")) {
    fail("no PLY file: it does not start with \"ply\"; check the file");
  }
  PlyHeader header;
  std::size_t at = 0;
  for (bool first = true;; first = false) {
    const std::size_t end = file.find_first_of("\r\n", at);
    if (end == std::string_view::npos) {
      fail("its header does not end: the file is cut off; export it again");
    }
    const std::string_view line = file.substr(at, end - at);
    // A line ends with CR LF, LF or CR. After a CR that ends the header, LF could only be a binary value by chance.
    at = end + (file.substr(end).starts_with("\r\n") ? 2 : 1);
    if (!first && !readLine(line, header)) {
      header.bytes = at;
      return header;
    }
  }
}

double PlyValues::nextWord() {
  rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size()));
  if (rest_.empty()) {
    fail("it ends before all that its header announces: it is cut off; export it again");
  }
  std::string_view word = rest_.substr(0, rest_.find_first_of(" \t\r\n"));
  rest_.remove_prefix(word.size());
  word.remove_prefix(word.starts_with('+') ? 1 : 0);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::result_out_of_range) { // too small or too large: only the latter cannot be drawn
    const bool small = word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
    return small ? 0.0 : std::numeric_limits<double>::infinity();
  }
  if (error != std::errc() || end != word.data() + word.size()) {
    fail("it has \"{}\" where a number should be; export it again", word.substr(0, 40));
  }
  return value;
}

double PlyValues::next(PlyType type) {
  if (encoding_ == PlyEncoding::Ascii) {
    return nextWord();
  }
  const std::size_t size = sizeOf(type);
  if (size > rest_.size()) {
    fail("it ends before all that its header announces: it is cut off; export it again");
  }
  std::array<char, 8> bytes{};
  std::memcpy(bytes.data(), rest_.data(), size);
  rest_.remove_prefix(size);
  if (encoding_ == PlyEncoding::BigEndian) {
    std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
  }
  switch (type) {
  case PlyType::Int8:
    return numberFrom<std::int8_t>(bytes);
  case PlyType::Uint8:
    return numberFrom<std::uint8_t>(bytes);
  case PlyType::Int16:
    return numberFrom<std::int16_t>(bytes);
  case PlyType::Uint16:
    return numberFrom<std::uint16_t>(bytes);
  case PlyType::Int32:
    return numberFrom<std::int32_t>(bytes);
  case PlyType::Uint32:
    return numberFrom<std::uint32_t>(bytes);
  case PlyType::Float:
    return numberFrom<float>(bytes);
  case PlyType::Double:
    return numberFrom<double>(bytes);
  }
  return 0.0;
}

void PlyValues::skip(std::uint64_t bytes) {
  if (bytes > rest_.size()) {
    fail("it ends before all that its header announces: it is cut off; export it again");
  }
  rest_.remove_prefix(bytes);
}

} // namespace tyndall::geometry
