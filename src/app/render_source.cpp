// SPDX-License-Identifier: Apache-2.0
#include "app/render_source.h"

#include "app/frames.h"
#include "base/error.h"
#include "base/file.h"

#include <spdlog/spdlog.h>

#include <algorithm>

namespace tyndall::app {
namespace fs = std::filesystem;
namespace {

/// @throws Error with all errors.
scene::Scene sound(scene::LoadResult result) {
  std::string errors;
  for (const scene::Problem& problem : result.problems) {
    if (!problem.warning) {
      errors += (errors.empty() ? "" : "\n") + std::string(Error(problem.location, problem.message).what());
    }
  }
  if (!result.ok()) {
    throw Error(errors);
  }
  return std::move(result.scene);
}

/// Logs the warnings; @throws Error with all errors.
scene::Scene accepted(scene::LoadResult result) {
  for (const scene::Problem& problem : result.problems) {
    if (problem.warning) {
      spdlog::warn("{}", Error(problem.location, problem.message).what());
    }
  }
  return sound(std::move(result));
}

/// The options that stand for keys of the scene.
void applyOptions(const RenderRequest& request, scene::Scene& scene) {
  scene.film.size = request.size.value_or(scene.film.size);
  scene.film.exposure = request.exposure.value_or(scene.film.exposure);
  scene.film.transparent = scene.film.transparent || request.transparent;
  scene.render.samples = request.samples.value_or(scene.render.samples);
  scene.render.seed = request.seed.value_or(scene.render.seed);
  if (request.depth) {
    scene.render.depth = request.depth;
  }
}

std::vector<fs::path> volumeFiles(const RenderRequest& request) {
  return request.frames ? volume::expandSequence(request.input, *request.frames) : std::vector<fs::path>{request.input};
}

/// Of a sequence, the choice that suits its fullest file: early frames are often empty.
volume::GridChoice chooseGrids(const RenderRequest& request, const std::vector<fs::path>& files) {
  volume::GridChoice choice;
  std::uint64_t most = 0;
  for (const fs::path& file : files) {
    const volume::FileInfo info = volume::inspectFile(file);
    volume::GridChoice next = volume::chooseGrids(info);
    std::uint64_t active = 0;
    for (const volume::GridInfo& grid : info.grids) {
      active = std::max(active, grid.name == next.density || grid.name == next.temperature ? grid.activeVoxels : 0);
    }
    if (choice.reason.empty() || active > most) {
      choice = std::move(next);
      most = active;
    }
  }
  if (!request.grid.empty()) {
    choice.density = request.grid;
    choice.temperature = choice.temperature == request.grid ? "" : choice.temperature;
    choice.reason = fmt::format("density from grid '{}', as asked", request.grid);
  }
  return choice;
}

/// A scene that holds nothing but the volume: enough to load its grids.
scene::Scene volumeScene(const fs::path& file, const volume::GridChoice& grids) {
  scene::Medium medium;
  medium.file = file.string();
  medium.grid = grids.density.empty() ? "none" : grids.density;
  if (!grids.temperature.empty()) {
    medium.emission = scene::Emission{.kind = scene::Emission::Kind::Blackbody, .grid = grids.temperature};
  }
  scene::Scene scene;
  scene.media.push_back(medium);
  return scene;
}

scene::AutoFrame autoFrame(const gpu_scene::VolumeSet& volumes) {
  const gpu_scene::VolumeSet::Use& use = volumes.uses.front();
  return {use.density ? &volumes.grids[*use.density] : nullptr, use.emission ? &volumes.grids[*use.emission] : nullptr};
}

bool changesMedia(const std::vector<scene::Override>& overrides) {
  return std::any_of(overrides.begin(), overrides.end(), [](const scene::Override& o) {
    return o.path.starts_with("media") || o.path.starts_with("animation");
  });
}

double firstFrame(const RenderRequest& request) { return request.frames ? request.frames->first : scene::kFirstFrame; }

Source makeUpSource(const RenderRequest& request, double memoryBudget, const Say& say) {
  const std::vector<fs::path> files = volumeFiles(request);
  scene::AutoInput input;
  input.file = request.input;
  input.grids = chooseGrids(request, files);
  say(input.grids.reason);
  std::vector<gpu_scene::VolumeSet> sets;
  for (const fs::path& file : files) {
    sets.push_back(gpu_scene::loadVolumes(volumeScene(file, input.grids), memoryBudget));
  }
  std::transform(sets.begin(), sets.end(), std::back_inserter(input.frames), autoFrame);
  input.size = request.size.value_or(input.size);
  input.up = request.up.value_or(input.up);
  input.opticalDepth = request.opticalDepth;
  input.densityScale = request.densityScale;
  const scene::AutoScene made = scene::makeAutoScene(input);
  for (const std::string& note : made.notes) {
    say(note);
  }
  Source source;
  source.madeUp = true;
  // Written and read again: what --write-scene saves is what is rendered, and --set has one meaning.
  source.text = scene::toJson(made.scene);
  source.scene = accepted(scene::parseScene(source.text, request.input, "", request.overrides, firstFrame(request)));
  if (!changesMedia(request.overrides)) {
    source.volumes = std::move(sets[made.densestFrame]);
    if (!source.scene.media.front().emission) {
      source.volumes->uses.front().emission.reset(); // a temperature grid too cold to glow
    }
  }
  if (request.frames) {
    source.exposureFrame = request.frames->first + static_cast<int>(made.densestFrame);
  }
  const bool exposureSet = std::any_of(request.overrides.begin(), request.overrides.end(),
                                       [](const scene::Override& o) { return o.path == "film.exposure"; });
  source.chooseExposure = !exposureSet && !request.exposure;
  return source;
}

bool playsFile(const std::string& file) { return file.ends_with(".gltf") || file.ends_with(".glb"); }

/// Whether there are objects that a file may move.
bool playsFiles(const scene::Scene& scene) {
  return std::any_of(scene.objects.begin(), scene.objects.end(),
                     [](const scene::Object& object) { return playsFile(object.file); });
}

/// Whether frames may differ in more than the volumes of a sequence.
bool moves(const scene::Scene& scene) {
  return !scene.animation.tracks.empty() || playsFile(scene.camera.file) || playsFiles(scene);
}

/// The scene where everything stands at a frame.
scene::Scene movedTo(int frame, const Source& source, const RenderRequest& request) {
  const fs::path folder = source.madeUp ? fs::path() : fs::path(request.input).parent_path();
  scene::LoadResult result = scene::parseScene(source.text, request.input, folder, request.overrides, frame);
  for (scene::Problem& problem : result.problems) {
    problem.message = inFrame(frame, problem.message);
  }
  scene::Scene scene = sound(std::move(result));
  applyOptions(request, scene);
  if (source.chooseExposure) {
    scene.film.exposure = source.scene.film.exposure;
  }
  return scene;
}

std::string contentsOf(const std::string& file) { return fmt::format("{:016x}", hashFile(file)); }

} // namespace

Source readSource(const RenderRequest& request, double memoryBudget, const Say& say) {
  Source source;
  if (request.bareVolume()) {
    source = makeUpSource(request, memoryBudget, say);
  } else {
    source.scene = accepted(scene::readScene(request.input, request.overrides, firstFrame(request)));
    source.text = moves(source.scene) ? readTextFile(request.input) : "";
    source.chooseExposure = request.chooseExposure;
    source.exposureFrame = request.frames ? std::optional(request.frames->first) : std::nullopt;
  }
  applyOptions(request, source.scene);
  return source;
}

scene::Scene sceneOfFrame(const Source& source, const RenderRequest& request, std::optional<int> frame) {
  const bool moving = moves(source.scene);
  scene::Scene result = frame && moving ? movedTo(*frame, source, request) : source.scene;
  bool sequence = false;
  for (scene::Medium& medium : result.media) {
    const fs::path file = medium.file;
    if (medium.homogeneous() || fs::exists(file) || !volume::isSequence(file.filename().string())) {
      continue;
    }
    if (!frame) {
      fail("{}: names a sequence; say which frames to render, such as --frames 1-48", medium.file);
    }
    medium.file = volume::expandSequence(medium.file, {*frame, *frame}).front().string();
    sequence = true;
  }
  if (frame && !sequence && !moving) {
    fail("--frames: nothing in the scene moves: it has no \"animation\" and no glTF file, and no medium's file names a "
         "sequence, as smoke_%04d.vdb or smoke_####.vdb do");
  }
  return result;
}

std::string sceneHash(const scene::Scene& scene, const gpu_scene::VolumeSet& volumes,
                      const render::EstimatorOptions& estimator) {
  scene::Scene core = scene;
  core.name.clear();
  core.animation = {}; // what its tracks move stands where it is in this frame
  core.film.exposure = 0.0;
  core.film.view = scene::View::Standard;
  core.render.samples = 1;
  core.render.seed = 0;
  core.render.deterministic = scene.render.deterministic && scene.render.integrator != scene::Integrator::Path;
  for (scene::Medium& medium : core.media) {
    medium.file = medium.homogeneous() ? "" : contentsOf(medium.file);
  }
  for (scene::NamedLight& named : core.lights) {
    if (auto* map = std::get_if<scene::MapEnvironment>(&named.light)) {
      map->file = contentsOf(map->file);
    }
  }
  for (scene::Object& object : core.objects) {
    object.file = object.file.empty() ? "" : contentsOf(object.file);
  }
  core.render.depth = scene.depth(); // however it was chosen
  std::string text = scene::toJson(core);
  text += playsFiles(scene) ? fmt::format("{}", scene.animation.seconds) : "";
  for (const volume::BrickGrid& grid : volumes.grids) {
    text += volume::storageName(grid.storage);
  }
  text += render::methodName(estimator.method);
  text += estimator.deltaTracking ? "delta" : "weighted";
  text += estimator.preview ? " preview" : "";
  text += estimator.aovs ? " layers" : "";
  return fmt::format("{:016x}", hashText(text));
}

} // namespace tyndall::app
