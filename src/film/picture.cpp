// SPDX-License-Identifier: Apache-2.0
#include "film/picture.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace tyndall::film {
namespace {

constexpr std::array<const char*, 3> kColours{"R", "G", "B"};

/// A channel from a function of the pixel's index.
template <class ValueOf>
std::vector<float> channelOf(const Film& film, ValueOf valueOf) {
  std::vector<float> pixels(film.pixels().size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    pixels[i] = static_cast<float>(valueOf(i));
  }
  return pixels;
}

void addStandardError(Image& image, const Film& film) {
  for (int channel = R; channel <= B; ++channel) {
    image.channels[fmt::format("stderr.{}", kColours[channel])] =
        channelOf(film, [&](std::size_t i) { return std::sqrt(film.varianceOfMean(i, channel)); });
  }
}

void addTransmittance(Image& image, const Film& film) {
  image.channels["transmittance.Y"] = channelOf(film, [&](std::size_t i) { return film.mean(i, T); });
}

void addDepth(Image& image, const Film& film) {
  image.channels["depth.Z"] = channelOf(film, [&](std::size_t i) {
    const double opacity = film.extraMean(i, Opacity);
    return opacity > 0.0 ? film.extraMean(i, Depth) / opacity : double(kFarDepth);
  });
}

void addSamples(Image& image, const Film& film) {
  std::vector<std::uint32_t> counts;
  for (std::size_t i = 0; i < film.pixels().size(); ++i) {
    counts.push_back(film.samples(i));
  }
  image.uintChannels["samples.Y"] = std::move(counts);
}

/// Three extras from `first` on as a colour layer.
void addColourLayer(Image& image, const Film& film, const std::string& layer, int first) {
  for (int channel = 0; channel < 3; ++channel) {
    image.channels[fmt::format("{}.{}", layer, kColours[channel])] =
        channelOf(film, [&](std::size_t i) { return film.extraMean(i, first + channel); });
  }
}

void addAlbedo(Image& image, const Film& film) { addColourLayer(image, film, "albedo", AlbedoR); }

struct Aov {
  std::string name;
  void (*add)(Image& image, const Film& film);
};

const std::vector<Aov>& aovTable() {
  static const std::vector<Aov> table{{"stderr", addStandardError},
                                      {"transmittance", addTransmittance},
                                      {"depth", addDepth},
                                      {"samples", addSamples},
                                      {"albedo", addAlbedo}};
  return table;
}

const Aov& aovNamed(const std::string& name) {
  const auto it = std::ranges::find(aovTable(), name, &Aov::name);
  if (it == aovTable().end()) {
    const std::string nearest = nearestName(name, aovNames());
    fail("--aov {}: unknown layer{}; there are {}", name,
         nearest.empty() ? "" : fmt::format(", did you mean {}", nearest), joinNames(aovNames()));
  }
  return *it;
}

} // namespace

const std::vector<std::string>& aovNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    std::ranges::transform(aovTable(), std::back_inserter(list), &Aov::name);
    return list;
  }();
  return names;
}

Image makeImage(const Film& film, const PictureOptions& options) {
  Image image{film.imageSize(), film.window(), {}, {}, film.metadata};
  for (int channel = R; channel <= B; ++channel) {
    image.channels[kColours[channel]] = channelOf(film, [&](std::size_t i) { return film.mean(i, channel); });
  }
  const bool opaque = options.opaqueBackground && !options.transparent;
  image.channels["A"] = channelOf(film, [&](std::size_t i) { return opaque ? 1.0 : 1.0 - film.mean(i, T); });
  if (options.transparent) {
    addColourLayer(image, film, "background", BackgroundR);
  }
  for (const std::string& name : options.aovs) {
    aovNamed(name).add(image, film);
  }
  return image;
}

} // namespace tyndall::film
