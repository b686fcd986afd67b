// SPDX-License-Identifier: Apache-2.0
#include "film/exr.h"

#include "film/exr_io.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>

#include <algorithm>

namespace tyndall::film {
namespace {

namespace fs = std::filesystem;

// A header may claim any size; deflate, the best of the common methods, packs at most 1 : 1032.
constexpr std::uint64_t kAlwaysAllowedBytes = std::uint64_t{64} << 20;
constexpr std::uint64_t kLargestPacking = 4096;

Imf::Slice sliceOf(Imf::PixelType type, const void* pixels, const Imath::Box2i& data) {
  return Imf::Slice::Make(type, pixels, data, 4);
}

/// What a file has, checked before anything is allocated.
struct Layout {
  Imath::Box2i data;     ///< all pixels of the file
  Imath::V2i origin;     ///< of the display window
  glm::uvec2 displaySize{0};
  Window window;         ///< data cut to the display window, relative to `origin`
};

std::uint32_t extentOf(int min, int max) { return std::uint32_t(std::int64_t(max) - min + 1); }

Layout layoutOf(const Imf::Header& header, const fs::path& path) {
  Layout layout;
  const Imath::Box2i& display = header.displayWindow();
  layout.data = header.dataWindow();
  layout.origin = display.min;
  layout.displaySize = {extentOf(display.min.x, display.max.x), extentOf(display.min.y, display.max.y)};
  const auto cut = [](std::int64_t value, std::int64_t origin, std::uint32_t size) {
    return std::uint32_t(std::clamp<std::int64_t>(value - origin, 0, size));
  };
  const Imath::Box2i& data = layout.data;
  layout.window.min = {cut(data.min.x, display.min.x, layout.displaySize.x),
                       cut(data.min.y, display.min.y, layout.displaySize.y)};
  layout.window.max = {cut(std::int64_t(data.max.x) + 1, display.min.x, layout.displaySize.x),
                       cut(std::int64_t(data.max.y) + 1, display.min.y, layout.displaySize.y)};
  if (layout.window.pixelCount() == 0) {
    fail("{}: the data window lies outside the display window, so there is no pixel; correct its windows",
         path.string());
  }
  return layout;
}

void checkChannels(const Imf::Header& header, const Layout& layout, const fs::path& path) {
  std::uint64_t channelCount = 0;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it, ++channelCount) {
    const Imf::Channel& channel = it.channel();
    if (channel.xSampling != 1 || channel.ySampling != 1) {
      fail("{}: channel {} is subsampled {}x{}; save the picture with full-resolution R, G, B", path.string(),
           it.name(), channel.xSampling, channel.ySampling);
    }
  }
  const Imath::Box2i& data = layout.data;
  const std::uint64_t pixelCount =
      std::uint64_t(extentOf(data.min.x, data.max.x)) * extentOf(data.min.y, data.max.y);
  // In steps that cannot overflow: pixels alone first.
  const std::uint64_t limit = std::max(kAlwaysAllowedBytes, kLargestPacking * std::uint64_t(fs::file_size(path)));
  if (pixelCount > limit || channelCount > limit / (4 * pixelCount)) {
    fail("{}: claims {} pixels of {} channels, more than a file of {} bytes can hold; it is damaged, write it again",
         path.string(), pixelCount, channelCount, fs::file_size(path));
  }
}

template <class T>
std::vector<T> cutToWindow(std::vector<T> all, const Layout& layout) {
  const std::size_t width = extentOf(layout.data.min.x, layout.data.max.x);
  const Window& window = layout.window;
  if (all.size() == window.pixelCount()) {
    return all;
  }
  const std::size_t skipX = std::size_t(std::int64_t(window.min.x) + layout.origin.x - layout.data.min.x);
  const std::size_t skipY = std::size_t(std::int64_t(window.min.y) + layout.origin.y - layout.data.min.y);
  std::vector<T> kept;
  kept.reserve(window.pixelCount());
  for (std::size_t y = 0; y < window.extent().y; ++y) {
    const auto row = all.begin() + std::ptrdiff_t((y + skipY) * width + skipX);
    kept.insert(kept.end(), row, row + window.extent().x);
  }
  return kept;
}

} // namespace

void writeExr(const fs::path& path, const Image& image) {
  Imf::Header header = makeHeader(image.displaySize, image.window, image.metadata);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer frame;
  for (const auto& [name, pixels] : image.channels) {
    TYNDALL_CHECK(pixels.size() == image.window.pixelCount());
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    frame.insert(name, sliceOf(Imf::FLOAT, pixels.data(), header.dataWindow()));
  }
  for (const auto& [name, pixels] : image.uintChannels) {
    TYNDALL_CHECK(pixels.size() == image.window.pixelCount());
    header.channels().insert(name, Imf::Channel(Imf::UINT));
    frame.insert(name, sliceOf(Imf::UINT, pixels.data(), header.dataWindow()));
  }
  writeExrAtomically(path, [&](std::ofstream& stream, const std::string& name) {
    Imf::StdOFStream output(stream, name.c_str());
    Imf::OutputFile file(output, header);
    file.setFrameBuffer(frame);
    file.writePixels(int(image.window.extent().y));
  });
}

Image readExr(const fs::path& path) {
  checkIsExr(path);
  return readingExr(path, [&] {
    Imf::InputFile file(path.string().c_str());
    const Layout layout = layoutOf(file.header(), path);
    checkChannels(file.header(), layout, path);
    Image image{layout.displaySize, layout.window, {}, {}, readMetadata(file.header())};
    const std::size_t count = std::size_t(extentOf(layout.data.min.x, layout.data.max.x)) *
                              extentOf(layout.data.min.y, layout.data.max.y);
    Imf::FrameBuffer frame;
    const Imf::ChannelList& channels = file.header().channels();
    for (auto it = channels.begin(); it != channels.end(); ++it) {
      const bool isUint = it.channel().type == Imf::UINT;
      void* pixels = nullptr;
      if (isUint) {
        pixels = image.uintChannels.emplace(it.name(), std::vector<std::uint32_t>(count)).first->second.data();
      } else {
        pixels = image.channels.emplace(it.name(), std::vector<float>(count)).first->second.data();
      }
      frame.insert(it.name(), sliceOf(isUint ? Imf::UINT : Imf::FLOAT, pixels, layout.data));
    }
    file.setFrameBuffer(frame);
    file.readPixels(layout.data.min.y, layout.data.max.y);
    for (auto& [name, pixels] : image.channels) {
      pixels = cutToWindow(std::move(pixels), layout);
    }
    for (auto& [name, pixels] : image.uintChannels) {
      pixels = cutToWindow(std::move(pixels), layout);
    }
    return image;
  });
}

const std::vector<float>* findChannel(const Image& image, const std::string& channel) {
  const auto it = image.channels.find(channel);
  return it == image.channels.end() ? nullptr : &it->second;
}

std::array<const std::vector<float>*, 3> colourChannels(const Image& image, const std::string& name) {
  const std::array<const std::vector<float>*, 3> colour{findChannel(image, "R"), findChannel(image, "G"),
                                                        findChannel(image, "B")};
  if (colour[0] != nullptr && colour[1] != nullptr && colour[2] != nullptr) {
    return colour;
  }
  if (const std::vector<float>* luminance = findChannel(image, "Y"); luminance != nullptr) {
    return {luminance, luminance, luminance};
  }
  std::vector<std::string> names;
  for (const auto& [channel, pixels] : image.channels) {
    names.push_back(channel);
  }
  for (const auto& [channel, pixels] : image.uintChannels) {
    names.push_back(channel + " (integer)");
  }
  fail("{}: has no float channels R, G, B (nor Y); it has {}; name a picture", name,
       names.empty() ? "none" : joinNames(names));
}

} // namespace tyndall::film
