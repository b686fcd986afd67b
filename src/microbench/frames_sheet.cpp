// SPDX-License-Identifier: Apache-2.0
#include "microbench/frames_sheet.h"

#include "base/error.h"
#include "base/file.h"
#include "film/png.h"
#include "microbench/frames.h"
#include "microbench/option_values.h"

#include <cstdio>
#include <fstream>
#include <sstream>

namespace tyndall::microbench {
namespace {

constexpr std::uint32_t kGap = 2; ///< between frames, pixels
constexpr const char* kColours[] = {"R", "G", "B"};

Sequence sequenceOf(const std::filesystem::path& file) {
  if (file.empty()) {
    return roomSequence(RoomEvent::Moves, false);
  }
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) {
    fail("{}: cannot be read", file.string());
  }
  return {file.string(), text.str(), file.parent_path()};
}

film::Image sheetOf(const glm::uvec2& frame, const glm::uvec2& count) {
  film::Image sheet;
  sheet.displaySize = count * (frame + kGap) - kGap;
  sheet.window = {glm::uvec2(0), sheet.displaySize};
  for (const char* colour : kColours) {
    sheet.channels[colour].resize(sheet.window.pixelCount());
  }
  return sheet;
}

void put(film::Image& sheet, const film::Film& film, const glm::uvec2& place) {
  const glm::uvec2 size = film.imageSize();
  const glm::uvec2 corner = place * (size + kGap);
  for (std::size_t pixel = 0; pixel < film.pixels().size(); ++pixel) {
    const glm::uvec2 at = corner + glm::uvec2(pixel % size.x, pixel / size.x);
    for (int channel = 0; channel < 3; ++channel) {
      sheet.channels[kColours[channel]][at.x + std::size_t(sheet.displaySize.x) * at.y] =
          float(film.mean(pixel, channel));
    }
  }
}

} // namespace

std::shared_ptr<SheetOptions> addSheetOptions(CLI::App& command) {
  auto shared = std::make_shared<SheetOptions>();
  SheetOptions& options = *shared;
  command.add_option("scene", options.scene,
                     "A scene file with an animation; else the room of guiding-frames whose lamp "
                     "moves");
  addSize(command, options.frame.size);
  command.add_option("--spp", options.frame.samples, "Samples per pixel and frame")->check(CLI::Range(1, 16));
  command.add_option("--frames", options.frames, "The last one")->check(CLI::Range(1, 1000));
  command.add_option("--every", options.every, "Shows one of so many")->check(CLI::Range(1, 1000));
  command.add_option("--contenders", options.contenders, "Rows, by their names in guiding-frames")
      ->delimiter(',')
      ->type_name("A,B");
  addGuideOverrides(command, options.overrides);
  command.add_option("--device", options.device, "Index or part of the name");
  command.add_option("-o,--output", options.output, "The PNG");
  return shared;
}

void runSheet(const SheetOptions& options) {
  const Sequence sequence = sequenceOf(options.scene);
  const std::vector<FrameContender> contenders = frameContenders(options.contenders, options.overrides);
  const scene::FilmSettings settings = sceneAt(sequence, 1, contenders.front().overrides).film;
  checkWritable(options.output);
  const gpu::Device device({.select = options.device, .validation = false, .pipelineCache = {}});
  const auto columns = static_cast<std::uint32_t>((options.frames + options.every - 1) / options.every);
  film::Image sheet = sheetOf(options.frame.size, {columns, contenders.size()});
  for (std::uint32_t row = 0; row < contenders.size(); ++row) {
    FrameRun run(device, contenders[row], options.frame);
    for (int frame = 1; frame <= options.frames; ++frame) {
      const film::Film film = run.render(sequence, frame).front();
      if ((frame - 1) % options.every == 0) {
        put(sheet, film, {static_cast<std::uint32_t>((frame - 1) / options.every), row});
      }
    }
    std::fprintf(stderr, "%s\n", run.name().c_str());
  }
  film::writePng(options.output, sheet,
                 {.exposure = settings.exposure,
                  .view = settings.view == scene::View::Filmic ? film::View::Filmic : film::View::Standard});
}

} // namespace tyndall::microbench
