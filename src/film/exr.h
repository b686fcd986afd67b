// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/film.h"

#include <array>
#include <filesystem>

namespace tyndall::film {

/// Named channels over `window` of a picture of `displaySize`, x fastest, first row on top. Colour is linear Rec.709
/// (D65), premultiplied by A. A channel "layer.C" belongs to the layer "layer".
struct Image {
  glm::uvec2 displaySize{0};
  Window window;
  std::map<std::string, std::vector<float>> channels;
  std::map<std::string, std::vector<std::uint32_t>> uintChannels;
  Metadata metadata;
};

/// Scanline OpenEXR, ZIP, float and uint channels, metadata as string attributes `tyndall:<key>`. The file appears
/// whole or not at all. @throws Error if it cannot be written.
void writeExr(const std::filesystem::path& path, const Image& image);

/// Any flat OpenEXR: half and float channels become float, pixels outside the display window are cut off, a multi-part
/// file gives its first part, a mip-mapped one its largest level. Non-finite pixels stay as they are.
/// @throws Error, with the file's name and what to do, if the file is damaged, deep, or has subsampled channels.
Image readExr(const std::filesystem::path& path);

/// R, G and B, or Y three times where the image has luminance only. Points into `image`.
/// @throws Error, beginning with `name`, that lists the channels there are.
std::array<const std::vector<float>*, 3> colourChannels(const Image& image, const std::string& name);

/// The float channel, or null.
const std::vector<float>* findChannel(const Image& image, const std::string& channel);

} // namespace tyndall::film
