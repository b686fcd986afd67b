// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "geometry/load_parts.h"

#include <stb/stb_image.h>

#include <cstdlib>
#include <cstring>
#include <memory>

namespace tyndall::geometry {
namespace {

constexpr std::uint64_t kMostTexels = std::uint64_t{1} << 28;
/// PNG's compression makes at most 1032 bytes of one, of 8 texels each; more is claimed by damaged files only.
constexpr std::uint64_t kMostTexelsPerByte = 8256;

/// The formats that meshes come with; stb's other readers are left out, since damaged files have broken them.
bool isKnownFormat(std::string_view bytes, bool tga) {
  using namespace std::string_view_literals;
  return bytes.starts_with("\x89PNG"sv) || bytes.starts_with("\xff\xd8\xff"sv) || bytes.starts_with("BM"sv) || tga;
}

std::string lowerExtension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return extension;
}

} // namespace

Texture decodeImage(std::string_view bytes, bool tga) {
  if (!isKnownFormat(bytes, tga)) {
    fail("it is no PNG, JPEG, BMP or TGA picture");
  }
  if (bytes.size() > (std::size_t{1} << 30)) {
    fail("it is larger than 1 GiB");
  }
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0;
  int height = 0;
  int channels = 0;
  if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0) {
    fail("it is damaged ({})", stbi_failure_reason());
  }
  const std::int64_t rows = std::abs(std::int64_t{height}); // negative: a BMP with its top row first
  if (width <= 0 || rows == 0) {
    fail("it is damaged ({} x {} texels)", width, rows);
  }
  const std::uint64_t texels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(rows);
  if (texels > kMostTexels || texels > kMostTexelsPerByte * bytes.size()) {
    fail("{} x {} texels are too many for its {} bytes or for Tyndall ({} at most)", width, rows, size, kMostTexels);
  }
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
      stbi_load_from_memory(data, size, &width, &height, &channels, 4), &stbi_image_free);
  if (pixels == nullptr) {
    fail("it is damaged ({})", stbi_failure_reason());
  }
  Texture texture;
  texture.size = {static_cast<unsigned>(width), static_cast<unsigned>(height)};
  texture.texels.resize(texels);
  std::memcpy(texture.texels.data(), pixels.get(), texels * 4); // bytes R, G, B, A: R lowest on little-endian hosts
  return texture;
}

std::uint32_t ImageFiles::load(const std::string& name, bool srgb, Wrap wrap) {
  const std::string key = fmt::format("{}{}{}", static_cast<int>(srgb), static_cast<int>(wrap), name);
  if (const auto known = known_.find(key); known != known_.end()) {
    return known->second;
  }
  std::uint32_t& index = known_[key] = kNone;
  std::string relative = name;
  for (char& c : relative) {
    c = c == '\\' ? '/' : c; // written on Windows
  }
  std::filesystem::path path = folder_ / relative;
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) { // exporters leave the paths of their own machine
    path = folder_ / std::filesystem::path(relative).filename();
  }
  try {
    Texture texture = decodeImage(readBytes(path, std::uint64_t{1} << 30), lowerExtension(path) == ".tga");
    texture.name = name;
    texture.srgb = srgb;
    texture.wrapU = texture.wrapV = wrap;
    index = static_cast<std::uint32_t>(model_.textures.size());
    model_.textures.push_back(std::move(texture));
  } catch (const Error& problem) {
    model_.warnings.push_back(fmt::format("The image \"{}\" is not used: {}.", name, problem.what()));
  }
  return index;
}

} // namespace tyndall::geometry
