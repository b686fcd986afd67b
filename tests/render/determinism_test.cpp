// SPDX-License-Identifier: Apache-2.0
// One seed, one picture, bit for bit (docs/theory.md A12): whatever the dispatch size, step bound, crops, interruptions
// and threads.
#include "film/checkpoint.h"
#include "film/merge.h"
#include "render/film_fixture.h"
#include "support/path_scenes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

namespace tyndall::test {
namespace {

constexpr glm::uvec2 kSize{40, 24};

/// For paths: surfaces that reflect, refract, shine, have holes or hold a medium; and a lens.
void addSurfaces(PathScene& test) {
  test.depth(6);
  test.scene.camera.lensRadius = 0.02;
  test.scene.camera.focusDistance = 4.0;
  test.material("floor", MaterialId::Diffuse, 0.6);
  test.material("glass", MaterialId::Dielectric, 0.9);
  test.material("container", MaterialId::Null);
  geometry::Material& pane = test.material("pane", MaterialId::MetalRough, 0.7);
  pane.opacity = 0.5;
  pane.alpha = geometry::Alpha::Blend;
  test.lamp("lamp", 3.0);
  test.quad("floor", {-4.0, -1.2, 4.0}, {8.0, 0.0, 0.0}, {0.0, 0.0, -8.0});
  test.quad("pane", {-1.4, -0.8, 0.2}, {0.8, 0.0, -0.3}, {0.0, 0.9, 0.0});
  test.ball("glass", {-0.5, 0.5, 0.4}, 0.3);
  test.ball("lamp", {-0.9, 0.9, -0.5}, 0.2);
  test.crate("container", {0.2, -1.0, -0.2}, {1.0, -0.3, 0.7});
  test.fill(1.5, 0.9).extinctionColour = {1.0, 0.5, 0.1};
}

/// Homogeneous and grid media, emission, every kind of light.
TestScene everything(render::Method method) {
  PathScene test(kSize);
  test.scene.render.depth.reset();
  test.perspective({0.5, 0.7, 4.0}, {0.0, 0.0, 0.0}, 40.0);
  test.sphere({0.8, 0.0, 0.0}, 0.6, 0.7, 0.8);
  test.grid(spikyGrid({20, 24, 20}, 2, volume::Storage::Half, affineMaps().front().worldFromIndex), 2.0, 0.9).phase =
      henyeyGreenstein(0.4);
  test.scene.media.back().worldFromMedium = glm::dmat4(0.1);
  test.scene.media.back().worldFromMedium[3] = glm::dvec4(-0.5, -1.5, 0.7, 1.0);
  scene::Emission glow;
  glow.scale = 0.3;
  test.emissionGrid(constantGrid(9, glm::dvec3(0.0), glm::dvec3(10.0), 1.0), glow);
  test.point({0.3, 1.5, 0.8}, 2.0);
  test.sun({0.2, -1.0, 0.3}, 1.0, 3.0);
  test.constant(0.2);
  if (method == render::Method::Path) {
    addSurfaces(test);
  }
  return test;
}

constexpr render::Method kMethods[] = {render::Method::Tracking, render::Method::March, render::Method::Path};

render::RenderOptions options(render::Method method, std::uint32_t samples = 40) {
  render::RenderOptions result;
  result.estimator.method = method;
  result.stop.samples = samples;
  result.seed = 7;
  result.estimator.aovs = true;
  result.sceneHash = "hash";
  return result;
}

/// FNV-1a over all sums and counts.
std::uint64_t hashOf(const film::Film& film) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&](auto value) {
    const auto bytes = std::bit_cast<std::array<unsigned char, sizeof(value)>>(value);
    for (const unsigned char byte : bytes) {
      hash = (hash ^ byte) * 0x100000001b3u;
    }
  };
  for (const film::PixelState& pixel : film.pixels()) {
    for (int half = 0; half < 2; ++half) {
      for (int moment = 0; moment < film::kMomentCount; ++moment) {
        add(pixel.sum[half][moment]);
        add(pixel.sumOfSquares[half][moment]);
      }
      add(pixel.samples[half]);
      add(pixel.batches[half]);
    }
    for (const double extra : pixel.extra) {
      add(extra);
    }
  }
  return hash;
}

std::uint64_t referenceHash(render::Method method) {
  static std::map<render::Method, std::uint64_t> hashes;
  if (!hashes.contains(method)) {
    hashes[method] = hashOf(renderFilm(everything(method), options(method)));
  }
  return hashes[method];
}

/// Each test for each method.
class Determinism : public testing::TestWithParam<render::Method> {
protected:
  static TestScene everything() { return test::everything(GetParam()); }
  static render::RenderOptions options() { return test::options(GetParam()); }
  static std::uint64_t referenceHash() { return test::referenceHash(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(, Determinism, testing::ValuesIn(kMethods),
                         [](const auto& one) { return std::string(render::methodName(one.param)); });

TEST_P(Determinism, DispatchSizeHasNoSay) {
  for (const std::uint32_t chunk : {100u, 16384u}) { // many with a rest, and one
    render::RenderOptions chunked = options();
    chunked.estimator.chunkPixels = chunk;
    EXPECT_EQ(hashOf(renderFilm(everything(), chunked)), referenceHash()) << chunk;
  }
  render::RenderOptions other = options();
  other.seed = 8; // the checker sees a change
  EXPECT_NE(hashOf(renderFilm(everything(), other)), referenceHash());
}

/// The march has no such bound.
TEST(StepBound, HasNoSay) {
  for (const render::Method method : {render::Method::Tracking, render::Method::Path}) {
    for (const std::uint32_t bound : {32u, 1u << 20}) {
      render::RenderOptions bounded = options(method);
      bounded.estimator.stepBound = bound;
      render::RenderReport report;
      EXPECT_EQ(hashOf(renderFilm(everything(method), bounded, &report)), referenceHash(method))
          << render::methodName(method) << " " << bound;
      if (bound < 1000) {
        EXPECT_GT(report.totals.resumed, 0u) << render::methodName(method) << " " << bound;
      }
    }
  }
}

TEST_P(Determinism, CropsMergeToTheWhole) {
  const film::Film whole = renderFilm(everything(), options());
  std::vector<std::pair<std::string, film::Film>> parts;
  for (const film::Window& window :
       {film::Window{{0, 0}, {17, 24}}, film::Window{{17, 0}, {40, 11}}, film::Window{{17, 11}, {40, 24}}}) {
    render::RenderOptions cropped = options();
    cropped.crop = window;
    parts.emplace_back(fmt::format("part {}", parts.size()), renderFilm(everything(), cropped));
  }
  EXPECT_EQ(hashOf(film::merge(parts)), hashOf(whole));
}

TEST_P(Determinism, ResumedIsUninterrupted) {
  const auto file = std::filesystem::temp_directory_path() / fmt::format("tyndall-resume-{}.exr", ::getpid());
  std::filesystem::remove(file);
  std::atomic<bool> stop = false;
  render::RenderOptions first = options();
  first.estimator.chunkPixels = 100; // interrupted in the middle of a batch
  first.checkpoint = file;
  first.interrupted = &stop;
  int chunks = 0;
  first.progress = [&](const render::Progress&) { stop = ++chunks == 13; };
  render::RenderReport report;
  renderFilm(everything(), first, &report);
  EXPECT_EQ(report.stoppedBy, "interrupt");
  render::RenderOptions second = options();
  second.checkpoint = file;
  second.resume = true;
  EXPECT_EQ(hashOf(renderFilm(everything(), second, &report)), referenceHash());
  EXPECT_LT(report.totals.samples, 40u * kSize.x * kSize.y);
  std::filesystem::remove(file);
}

/// Prints the hash, for the next test's children.
TEST_P(Determinism, HashOfTheReference) {
  std::printf("film-hash %016llx\n", static_cast<unsigned long long>(referenceHash()));
}

std::string hashInChild(render::Method method, int threads) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe");
  const std::string command = fmt::format("LP_NUM_THREADS={} '{}' --gtest_filter=Determinism.HashOfTheReference/{}",
                                          threads, program, render::methodName(method));
  FILE* pipe = ::popen(command.c_str(), "r");
  std::string result;
  std::array<char, 256> line{};
  while (std::fgets(line.data(), line.size(), pipe) != nullptr) {
    if (const std::string text = line.data(); text.rfind("film-hash ", 0) == 0) {
      result = text.substr(10, 16);
    }
  }
  ::pclose(pipe);
  return result;
}

/// On a CPU device; elsewhere the variable means nothing and both are the same run.
TEST_P(Determinism, ThreadsHaveNoSay) {
  const std::string expected = fmt::format("{:016x}", referenceHash());
  EXPECT_EQ(hashInChild(GetParam(), 1), expected);
  EXPECT_EQ(hashInChild(GetParam(), 2), expected);
}

} // namespace
} // namespace tyndall::test
