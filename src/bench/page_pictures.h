// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <filesystem>
#include <string>
#include <vector>

/// Pictures as bytes of PNG files, for pages that stand alone.
namespace tyndall::bench {

/// The colours of an EXR. @param view "filmic" or another, which is standard.
std::string pictureBytes(const std::filesystem::path& exr, double exposureStops, const std::string& view);

/// Relative error of each pixel after one CPU second, so that maps of different efforts compare: from black (0.1 %)
/// over red and yellow to white (100 %), logarithmic.
/// @param errors of pictures that took `seconds`
std::string errorMapBytes(const std::vector<double>& errors, const glm::uvec2& size, double seconds);

/// Base64 [RFC 4648], section 4.
std::string base64(const std::string& bytes);

} // namespace tyndall::bench
