// SPDX-License-Identifier: Apache-2.0
// One seed, one picture, bit for bit: again, in small dispatches that are suspended, and in crops.
#include "film/film.h"
#include "render/renderer.h"
#include "verify/families.h"

#include <cstring>
#include <memory>
#include <type_traits>

namespace tyndall::verify {
namespace {

using render::Method;

constexpr glm::uvec2 kSize{40, 24};
constexpr std::uint32_t kSamples = 40; // two batches and a half

/// Homogeneous and grid media, emission, lights of every kind; for paths surfaces too.
PathScene everything(Method method) {
  PathScene test(kSize);
  test.scene.render.depth.reset();
  test.perspective({0.5, 0.7, 4.0}, {0.0, 0.0, 0.0}, 40.0);
  test.sphere({0.8, 0.0, 0.0}, 0.6, 0.7, 0.8);
  test.grid(puffGrid(glm::ivec3(-3, 11, 5), volume::Storage::Half), 2.0, 0.9).phase = henyeyGreenstein(0.4);
  scene::Emission glow;
  glow.scale = 0.3;
  test.emissionGrid(constantGrid(9, glm::dvec3(-0.5), glm::dvec3(0.5), 1.0), glow);
  test.point({0.3, 1.5, 0.8}, 2.0);
  test.sun({0.2, -1.0, 0.3}, 1.0, 3.0);
  test.constant(0.2);
  if (method == Method::Path) {
    test.depth(5);
    test.material("floor", MaterialId::Diffuse, 0.6);
    test.material("glass", MaterialId::Dielectric, 0.9);
    test.lamp("lamp", 3.0);
    test.quad("floor", {-4.0, -1.2, 4.0}, {8.0, 0.0, 0.0}, {0.0, 0.0, -8.0});
    test.ball("glass", {-0.5, 0.5, 0.4}, 0.3);
    test.ball("lamp", {-0.9, 0.9, -0.5}, 0.2);
  }
  return test;
}

/// Films of one scene by one pipeline.
class FilmMaker {
public:
  FilmMaker(Trial& trial, const TestScene& test, const render::EstimatorOptions& options)
      : trial_(trial), test_(test),
        gpuScene_(trial.device(), test.scene, test.volumes, render::layoutOf(options.method)),
        estimator_(render::makeEstimator(trial.device(), gpuScene_, test.volumes, options)) {}

  film::Film film(std::uint32_t seed, const film::Window& crop = {}) {
    render::RenderOptions options;
    options.stop.samples = kSamples * trial_.conditions().effort;
    options.seed = seed;
    options.crop = crop;
    render::RenderReport report;
    film::Film made = render::renderFilm(trial_.device(), test_.scene, test_.volumes, *estimator_, options, report);
    trial_.countSamples(report.totals.samples);
    return made;
  }

private:
  Trial& trial_;
  const TestScene& test_;
  gpu_scene::GpuScene gpuScene_;
  std::unique_ptr<render::Estimator> estimator_;
};

/// The film's pixels within the other's window.
bool sameBits(const film::Film& whole, const film::Film& part) {
  static_assert(std::is_trivially_copyable_v<film::PixelState>);
  const film::Window& window = part.window();
  const std::uint32_t width = window.extent().x;
  for (std::size_t i = 0; i < part.pixels().size(); ++i) {
    const glm::uvec2 pixel = window.min + glm::uvec2(i % width, i / width);
    const film::PixelState& expected = whole.pixels()[pixel.x + std::size_t(kSize.x) * pixel.y];
    if (std::memcmp(&expected, &part.pixels()[i], sizeof(expected)) != 0) {
      return false;
    }
  }
  return true;
}

void checkBits(Trial& trial, Method method) {
  const PathScene test = everything(method);
  render::EstimatorOptions options{.method = method, .plantedBug = trial.conditions().plantedBug};
  options.rays = render::RayCaster::Tree; // what is timed may differ from run to run
  const std::uint32_t seed = 7 + trial.conditions().seed;
  const film::Window crop{{7, 5}, {29, 20}};
  FilmMaker maker(trial, test, options);
  const film::Film whole = maker.film(seed);
  trial.require(sameBits(whole, maker.film(seed)), "the same seed gives other bits the second time");
  trial.require(sameBits(whole, maker.film(seed, crop)), "a crop has other bits than the whole picture");
  trial.require(!sameBits(whole, maker.film(seed + 1, crop)), "another seed gives the same bits");
  options.chunkPixels = 100;
  options.stepBound = 32;
  trial.require(sameBits(whole, FilmMaker(trial, test, options).film(seed)), "small dispatches give other bits");
}

} // namespace

void checkMarchBits(Trial& trial) { checkBits(trial, Method::March); }

void checkTrackingBits(Trial& trial) { checkBits(trial, Method::Tracking); }

void checkPathBits(Trial& trial) { checkBits(trial, Method::Path); }

} // namespace tyndall::verify
