// SPDX-License-Identifier: Apache-2.0
#include "app/picture_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace tyndall::app {
namespace {

constexpr const char* kTransparent = "picture.transparent";
constexpr const char* kBackground = "picture.opaqueBackground";
constexpr const char* kAovs = "picture.aovs";
constexpr const char* kExposure = "picture.exposure";
constexpr const char* kView = "picture.view";

/// The value, or the first of several that merging has joined with "; ".
std::string first(const film::Metadata& metadata, const char* key) {
  const auto found = metadata.find(key);
  return found == metadata.end() ? "" : found->second.substr(0, found->second.find(';'));
}

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> items;
  for (std::size_t begin = 0; begin < list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    items.push_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return items;
}

} // namespace

void noteSettings(const PictureSettings& settings, film::Metadata& metadata) {
  metadata[kTransparent] = settings.transparent ? "1" : "0";
  metadata[kBackground] = settings.opaqueBackground ? "1" : "0";
  metadata[kAovs] = fmt::format("{}", fmt::join(settings.aovs, ","));
  metadata[kExposure] = fmt::format("{}", settings.png.exposure);
  metadata[kView] = settings.png.view == film::View::Filmic ? "filmic" : "standard";
}

PictureSettings settingsOf(const film::Metadata& metadata) {
  PictureSettings settings;
  settings.transparent = first(metadata, kTransparent) == "1";
  settings.opaqueBackground = first(metadata, kBackground) == "1";
  settings.aovs = split(first(metadata, kAovs));
  settings.png.exposure = std::strtod(first(metadata, kExposure).c_str(), nullptr);
  settings.png.view = first(metadata, kView) == "filmic" ? film::View::Filmic : film::View::Standard;
  return settings;
}

PictureFiles writePicture(const std::filesystem::path& exr, const film::Film& film, const PictureSettings& settings,
                          const std::map<std::string, std::vector<float>>& layers) {
  film::Image image = film::makeImage(film, {settings.transparent, settings.opaqueBackground, settings.aovs});
  image.channels.insert(layers.begin(), layers.end());
  PictureFiles files{.exr = exr, .png = std::filesystem::path(exr).replace_extension(".png"), .report = {}};
  film::writeExr(files.exr, image);
  files.report = film::writePng(files.png, image, settings.png);
  return files;
}

} // namespace tyndall::app
