// SPDX-License-Identifier: Apache-2.0
#include "app/commands.h"
#include "base/error.h"
#include "base/file.h"
#include "film/picture.h"
#include "film/png.h"
#include "render/renderer.h"
#include "scene/load.h"

#include <spdlog/spdlog.h>

#include <memory>

namespace tyndall::app {
namespace {

struct RenderArguments {
  std::string input;
  std::string output = "out.exr";
  std::uint32_t samples = 0;
};

int renderCommand(const RenderArguments& arguments) {
  const scene::LoadResult loaded = scene::readScene(arguments.input);
  for (const scene::Problem& problem : loaded.problems) {
    spdlog::warn("{}", Error(problem.location, problem.message).what());
  }
  if (!loaded.ok()) return 1;
  const scene::Scene& scene = loaded.scene;
  const gpu::Device device({});
  const gpu_scene::VolumeSet volumes = gpu_scene::loadVolumes(scene, 4e9);
  const gpu_scene::GpuScene gpuScene(device, scene, volumes);
  render::RenderOptions options;
  options.stop.samples = arguments.samples > 0 ? arguments.samples : scene.render.samples;
  render::RenderReport report;
  const film::Film film = render::renderFilm(device, scene, volumes, gpuScene, options, report);
  const film::Image image = film::makeImage(film, {scene.film.transparent, gpuScene.features().background, {}});
  film::writeExr(arguments.output, image);
  const auto png = film::writePng(std::filesystem::path(arguments.output).replace_extension(".png"), image,
                 {scene.film.exposure, scene.film.view == scene::View::Filmic ? film::View::Filmic : film::View::Standard});
  fmt::print("{:.2f} s, first {:.2f}, lookups {} segments {} resumed {} nonfinite {} exceeded {} error {} clipped {} media px {} bg {}\n", report.seconds, report.firstDispatchSeconds,
             report.totals.lookups, report.totals.segments, report.totals.resumed, report.totals.nonFinite, report.totals.majorantExceeded, film::estimateError(film).relative, png.clippedShare, report.mediaPixels, report.backgroundPixels);
  return 0;
}

} // namespace

void addRenderCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("render", "Render a scene (.json) or a volume (.vdb)");
  auto arguments = std::make_shared<RenderArguments>();
  command->add_option("input", arguments->input, "Scene (.json) or volume (.vdb)")->required();
  command->add_option("-o,--output", arguments->output, "EXR to write; a PNG is written beside it");
  command->add_option("--spp", arguments->samples, "Samples per pixel");
  command->callback([arguments, &action] { action = [arguments] { return renderCommand(*arguments); }; });
}

} // namespace tyndall::app
