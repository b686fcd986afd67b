// SPDX-License-Identifier: Apache-2.0
#include "bench/page_pictures.h"

#include "base/file.h"
#include "film/png.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace tyndall::bench {
namespace {

constexpr double kBlackError = 1e-3;
constexpr double kWhiteError = 1.0;

/// Bytes of a file that `write` makes and that does not stay.
template <class Write>
std::string bytesOf(const Write& write) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / fmt::format("tyndall-bench-{}.png", getpid());
  write(file);
  std::string bytes = readTextFile(file);
  std::filesystem::remove(file);
  return bytes;
}

/// Black, red, yellow, white over [0, 1].
glm::dvec3 heat(double share) { return glm::clamp(glm::dvec3(3.0 * share) - glm::dvec3(0.0, 1.0, 2.0), 0.0, 1.0); }

} // namespace

std::string pictureBytes(const std::filesystem::path& exr, double exposureStops, const std::string& view) {
  const film::Image image = film::readExr(exr);
  const film::PngOptions options{exposureStops, view == "filmic" ? film::View::Filmic : film::View::Standard};
  return bytesOf([&](const std::filesystem::path& file) { film::writePng(file, image, options); });
}

std::string errorMapBytes(const std::vector<double>& errors, const glm::uvec2& size, double seconds) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(3 * errors.size());
  for (const double error : errors) {
    const double afterOneSecond = std::max(error * std::sqrt(seconds), 1e-30);
    const double share = std::log(afterOneSecond / kBlackError) / std::log(kWhiteError / kBlackError);
    const glm::dvec3 colour = heat(std::clamp(share, 0.0, 1.0));
    for (int channel = 0; channel < 3; ++channel) {
      rgb.push_back(static_cast<std::uint8_t>(std::lround(255.0 * colour[channel])));
    }
  }
  return bytesOf([&](const std::filesystem::path& file) { film::writePngBytes(file, size, rgb); });
}

std::string base64(const std::string& bytes) {
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  result.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (k < count ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      result += k <= count ? kLetters[bits >> (18 - 6 * k) & 63u] : '=';
    }
  }
  return result;
}

} // namespace tyndall::bench
