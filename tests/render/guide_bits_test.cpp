// SPDX-License-Identifier: Apache-2.0
// Deterministic guiding: one seed, one picture and one store, bit for bit, whatever threads, step bound and
// interruptions.
#include "base/file.h"
#include "guide_fixture.h"
#include "render/film_fixture.h"
#include "support/fixtures.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

namespace tyndall::test {
namespace {

constexpr std::uint32_t kChunk = 100;  ///< many to a picture, with a rest
constexpr std::uint32_t kSamples = 24; ///< the first batch in rounds, and half of another one

/// Paths of a few events, most of which learn: in a ball of fog, in which pipelines are made quickly.
PathScene fog() {
  PathScene test({24, 18});
  test.depth(3);
  test.perspective({0.0, 0.0, 4.0}, {0.0, 0.0, 0.0}, 40.0);
  test.sphere({0.0, 0.0, 0.0}, 1.3, 2.0, 0.9);
  test.point({0.0, 1.5, 0.0}, 5.0);
  return test;
}

/// In a room with a lamp behind a board.
PathScene closet() {
  PathScene test({24, 18});
  test.depth(3);
  test.perspective({0.0, 0.3, 0.9}, {0.0, -0.1, 0.0}, 60.0);
  test.material("white", MaterialId::Diffuse, 0.7);
  test.lamp("lamp", 20.0);
  test.crate("white", glm::dvec3(-1.0), glm::dvec3(1.0));
  test.quad("white", {-0.6, 0.5, -0.4}, {1.2, 0.0, 0.0}, {0.0, 0.0, 0.8});
  test.quad("lamp", {-0.3, 0.9, -0.2}, {0.6, 0.0, 0.0}, {0.0, 0.0, 0.4});
  test.box(glm::dvec3(-0.9), glm::dvec3(0.9), 0.4, 0.9);
  return test;
}

std::uint64_t hashOf(const film::Film& film) {
  const auto bytes = std::as_bytes(std::span(film.pixels()));
  return hashText({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::uint64_t hashOf(const guide::Store& store) {
  const guide::StoreContent content = store.content();
  std::string text = fmt::format("{} ", content.round);
  for (const auto* part : {&content.cells, &content.states, &content.radiance}) {
    text.append(reinterpret_cast<const char*>(part->data()), part->size());
  }
  return hashText(text);
}

/// Of a picture and the store that it leaves.
struct Bits {
  std::uint64_t film = 0;
  std::uint64_t store = 0;
  bool operator==(const Bits&) const = default;
  std::string text() const { return fmt::format("{:016x}{:016x}", film, store); }
};

/// One pipeline for any number of renders. The published settings have a radiance cache and take weight away.
class Renderer {
public:
  explicit Renderer(scene::Integrator integrator, std::uint32_t stepBound = 0)
      : test_(integrator == scene::Integrator::Mcpg ? closet() : fog()), settings_(scene::guideSettings(integrator)),
        store_(makeStore(settings_, test_)) {
    render::EstimatorOptions options = guidedBy(store_, settings_).estimator;
    options.guide->deterministic = true;
    options.chunkPixels = kChunk;
    options.stepBound = stepBound;
    estimator_ = render::makeEstimator(probeDevice(), scene_, test_.volumes, options);
  }

  static render::RenderOptions options() {
    render::RenderOptions result;
    result.stop.samples = kSamples;
    result.seed = 7;
    result.sceneHash = "hash";
    return result;
  }

  /// From an empty store.
  Bits run(const render::RenderOptions& options = Renderer::options()) {
    store_->clear();
    const film::Film film =
        render::renderFilm(probeDevice(), test_.scene, test_.volumes, *estimator_, options, report_);
    return {hashOf(film), hashOf(*store_)};
  }
  const render::RenderReport& report() const { return report_; }
  const StorePtr& store() const { return store_; }

private:
  PathScene test_;
  gpu_scene::GpuScene scene_{probeDevice(), test_.scene, test_.volumes, gpu_scene::GridLayout::Paths};
  scene::GuideSettings settings_;
  StorePtr store_;
  std::unique_ptr<render::Estimator> estimator_;
  render::RenderReport report_;
};

class GuideBits : public testing::TestWithParam<scene::Integrator> {};
INSTANTIATE_TEST_SUITE_P(, GuideBits, testing::Values(scene::Integrator::Mcpg, scene::Integrator::McpgPaper),
                         [](const auto& one) {
                           return std::string(one.param == scene::Integrator::Mcpg ? "Mcpg" : "McpgPaper");
                         });

/// Prints the bits, for the next test's children.
TEST_P(GuideBits, DISABLED_OfTheReference) { std::printf("bits %s\n", Renderer(GetParam()).run().text().c_str()); }

std::string bitsInChild(const std::string& integrator, int threads) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe");
  const std::string command = fmt::format("LP_NUM_THREADS={} '{}' --gtest_also_run_disabled_tests "
                                          "--gtest_filter=GuideBits.DISABLED_OfTheReference/{}",
                                          threads, program, integrator);
  FILE* pipe = ::popen(command.c_str(), "r");
  std::string result;
  std::array<char, 256> line{};
  while (std::fgets(line.data(), line.size(), pipe) != nullptr) {
    if (const std::string text = line.data(); text.starts_with("bits ")) {
      result = text.substr(5, 32);
    }
  }
  ::pclose(pipe);
  return result;
}

/// On a CPU device; elsewhere the variable means nothing and all are the same run.
TEST_P(GuideBits, RunsThreadsAndStepBoundsHaveNoSay) {
  const std::string name = GetParam() == scene::Integrator::Mcpg ? "Mcpg" : "McpgPaper";
  Renderer renderer(GetParam());
  const Bits bits = renderer.run();
  EXPECT_EQ(renderer.run(), bits) << "a second run";
  EXPECT_GT(renderer.report().guide->totals.guided, 500u) << "nothing was guided";
  render::RenderOptions other = Renderer::options();
  other.seed = 8;
  EXPECT_NE(renderer.run(other), bits) << "the checker does not see a change";
  for (const int threads : {1, 2}) {
    EXPECT_EQ(bitsInChild(name, threads), bits.text()) << threads << " threads";
  }
  Renderer bounded(GetParam(), 1);
  EXPECT_EQ(bounded.run(), bits) << "suspended paths";
  EXPECT_GT(bounded.report().totals.resumed, 0u);
}

/// Broken off in the rounds of the first batch, where there is no state to go on from, and in the middle of a later
/// one.
TEST_P(GuideBits, ResumedIsUninterrupted) {
  Renderer renderer(GetParam());
  const Bits whole = renderer.run();
  constexpr int kRounds = 5;
  constexpr int kChunks = 5;
  for (const int chunks : {kChunks + 2, kRounds * kChunks + 3}) {
    const TemporaryFolder folder;
    const bool early = chunks < kRounds * kChunks;
    std::atomic<bool> stop = false;
    render::RenderOptions first = Renderer::options();
    first.checkpoint = folder / "a.exr";
    first.checkpointSeconds = 0.0;
    first.interrupted = &stop;
    int done = 0;
    first.progress = [&](const render::Progress&) { stop = ++done == chunks; };
    EXPECT_NE(renderer.run(first), whole);
    EXPECT_EQ(renderer.report().stoppedBy, "interrupt");
    EXPECT_EQ(std::filesystem::exists(first.checkpoint), !early);
    render::RenderOptions second = Renderer::options();
    second.checkpoint = first.checkpoint;
    second.resume = true;
    EXPECT_EQ(renderer.run(second), whole) << chunks;
    EXPECT_EQ(renderer.report().totals.samples < std::uint64_t(kSamples) * 24 * 18, !early);
  }
}

} // namespace
} // namespace tyndall::test
