// SPDX-License-Identifier: Apache-2.0
#include "microbench/frames.h"

#include "base/error.h"
#include "base/file.h"
#include "math/colour.h"
#include "microbench/frames_report.h"
#include "microbench/frames_statistics.h"
#include "microbench/text_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <map>

namespace tyndall::microbench {
namespace {

using Json = nlohmann::ordered_json;

std::vector<double> luminances(const film::Film& film) {
  std::vector<double> picture;
  for (std::size_t pixel = 0; pixel < film.pixels().size(); ++pixel) {
    picture.push_back(luminance({film.mean(pixel, film::R), film.mean(pixel, film::G), film.mean(pixel, film::B)}));
  }
  return picture;
}

/// Numbers that no sequence draws.
constexpr std::uint32_t kReferenceSeed = 1u << 30;

/// Pictures without noise to speak of, by light samples and no guiding, of each moment once.
class References {
public:
  References(const gpu::Device& device, const FramesOptions& options)
      : run_(device, {"reference", overrides()}, {options.frame.size, options.referenceSamples, 1, kReferenceSeed}) {}

  const std::vector<double>& at(const Sequence& sequence, int frame) {
    const std::string moment = momentOf(sceneAt(sequence, frame, overrides()));
    auto found = pictures_.find(moment);
    if (found == pictures_.end()) {
      run_.recall({});
      found = pictures_.emplace(moment, luminances(run_.render(sequence, frame).front())).first;
    }
    return found->second;
  }

private:
  static std::vector<scene::Override> overrides() {
    return {{"render.integrator", "path"}, {"render.light_sampling", "true"}};
  }

  FrameRun run_;
  std::map<std::string, std::vector<double>> pictures_;
};

class Session {
public:
  Session(const gpu::Device& device, const FramesOptions& options)
      : device_(device), options_(options), references_(device, options) {}

  /// Through all events; the frames before them are the same, and rendered once.
  void run(const FrameContender& contender) {
    FrameRun frames(device_, contender, options_.frame);
    const std::vector<double> before = errorsOf(frames, roomSequence(events().front(), false), 1, kEventFrame);
    const FrameMemory memory = frames.memory();
    for (const RoomEvent event : events()) {
      frames.recall(memory);
      FrameRow row{roomEventName(event), contender.name, before, {}, kEventFrame};
      const auto after = errorsOf(frames, roomSequence(event, false), kEventFrame + 1, options_.frames);
      row.errors.insert(row.errors.end(), after.begin(), after.end());
      frames.recall({});
      row.steady = errorsOf(frames, roomSequence(event, true), 1, options_.frames);
      rows_.push_back(row);
    }
    std::stable_sort(rows_.begin(), rows_.end(),
                     [this](const FrameRow& a, const FrameRow& b) { return order(a.event) < order(b.event); });
  }

  const std::vector<FrameRow>& rows() const { return rows_; }

private:
  std::vector<RoomEvent> events() const {
    std::vector<RoomEvent> events;
    std::copy_if(std::begin(kRoomEvents), std::end(kRoomEvents), std::back_inserter(events), [this](RoomEvent event) {
      return options_.events.empty() ||
             std::find(options_.events.begin(), options_.events.end(), roomEventName(event)) != options_.events.end();
    });
    return events;
  }

  static std::ptrdiff_t order(const std::string& event) {
    return std::find_if(std::begin(kRoomEvents), std::end(kRoomEvents),
                        [&event](RoomEvent each) { return roomEventName(each) == event; }) -
           std::begin(kRoomEvents);
  }

  std::vector<double> errorsOf(FrameRun& run, const Sequence& sequence, int first, int last) {
    std::vector<double> errors;
    for (int frame = first; frame <= last; ++frame) {
      std::vector<std::vector<double>> pictures;
      for (const film::Film& film : run.render(sequence, frame)) {
        pictures.push_back(luminances(film));
      }
      errors.push_back(frameError(pictures, references_.at(sequence, frame)));
    }
    return errors;
  }

  const gpu::Device& device_;
  const FramesOptions& options_;
  References references_;
  std::vector<FrameRow> rows_;
};

void writeJson(const gpu::Device& device, const std::vector<FrameRow>& rows, const FramesOptions& options) {
  Json report{{"command", "guiding-frames"},
              {"version", TYNDALL_VERSION},
              {"device", device.info().name},
              {"driver", device.info().driver},
              {"size", {options.frame.size.x, options.frame.size.y}},
              {"samples", options.frame.samples},
              {"seeds", options.frame.seeds},
              {"referenceSamples", options.referenceSamples},
              {"trimmedShare", kTrimmedFrameShare},
              {"figures", Json::array()}};
  for (const FrameRow& row : rows) {
    report["figures"].push_back(toJson(row));
  }
  writeTextFile(options.json, report.dump(2) + "\n");
}

/// A chart for each event and integrator, path in all of them: more lines could not be told apart.
void writePlots(const std::vector<FrameRow>& rows, const FramesOptions& options) {
  for (const RoomEvent event : kRoomEvents) {
    for (const std::string integrator : {"mcpg-paper", "mcpg"}) {
      std::vector<FrameRow> shown;
      std::copy_if(rows.begin(), rows.end(), std::back_inserter(shown), [&](const FrameRow& row) {
        return row.name == "path" || row.name.substr(0, row.name.find(' ')) == integrator;
      });
      const std::string name = roomEventName(event);
      const bench::LineChart chart =
          chartOf(shown, name, fmt::format("A room's lamp or camera: {} after frame {}", name, kEventFrame));
      if (chart.lines.size() > 1) {
        writeTextFile(options.plots / fmt::format("frames-{}-{}.svg", name, integrator), bench::svgText(chart));
      }
    }
  }
}

/// Before the work.
void checkOutputs(const FramesOptions& options) {
  if (!options.json.empty()) {
    checkWritable(options.json);
  }
  if (!options.plots.empty()) {
    std::filesystem::create_directories(options.plots);
    checkWritable(options.plots / "frames.svg");
  }
}

} // namespace

void runFrames(const FramesOptions& options) {
  const std::vector<FrameContender> contenders = frameContenders(options.contenders, options.overrides);
  for (const FrameContender& contender : contenders) { // what a scene refuses comes to light before the work
    sceneAt(roomSequence(RoomEvent::Out, false), 1, contender.overrides);
  }
  checkOutputs(options);
  const gpu::Device device({.select = options.device, .validation = false, .pipelineCache = {}});
  fmt::print("{} on {}\n{}x{} pixels, {} samples per pixel and frame, {} seeds; relMSE of a frame without the worst "
             "{:.1f} % of pixels\n\n",
             device.info().name, device.info().driver, options.frame.size.x, options.frame.size.y,
             options.frame.samples, options.frame.seeds, 100.0 * kTrimmedFrameShare);
  Session session(device, options);
  for (const FrameContender& contender : contenders) {
    session.run(contender);
    std::fprintf(stderr, "%s\n", contender.name.c_str());
    if (!options.json.empty()) {
      writeJson(device, session.rows(), options);
    }
    if (!options.plots.empty()) {
      writePlots(session.rows(), options);
    }
  }
  fmt::print("{}", markdownOf(session.rows()));
}

} // namespace tyndall::microbench
