// SPDX-License-Identifier: Apache-2.0
#include "app/render_request.h"

#include "app/mesh_input.h"
#include "base/error.h"
#include "base/file.h"
#include "film/picture.h"

#include <algorithm>

namespace tyndall::app {
namespace fs = std::filesystem;
namespace {

std::string lowerExtension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// "clouds/smoke.vdb" -> "smoke.exr"; the name given by -o may be that of the EXR or of the PNG.
fs::path settledOutput(const RenderRequest& request) {
  fs::path output = request.output.empty() ? fs::path(request.input).stem() += ".exr" : request.output;
  const std::string extension = lowerExtension(output);
  if (extension == ".png") {
    output.replace_extension(".exr");
  } else if (extension.empty()) {
    output += ".exr";
  } else if (extension != ".exr") {
    fail("-o {}: the picture is an OpenEXR and a PNG beside it; give the name the ending .exr", output.string());
  }
  return output;
}

/// One name per frame: placeholders filled in, or the number put before the ending.
fs::path numbered(const fs::path& path, std::optional<int> frame) {
  if (!frame || path.empty()) {
    return path;
  }
  if (volume::isSequence(path.filename().string())) {
    return path.parent_path() / volume::frameFile(path.filename().string(), *frame);
  }
  fs::path name = path.stem();
  name += fmt::format("_{:04d}", *frame);
  name += path.extension();
  return path.parent_path() / name;
}

fs::path withSuffix(const fs::path& path, const char* suffix) {
  fs::path result = path;
  return result += suffix;
}

void checkCombinations(const RenderRequest& request) {
  const bool volumeOptions = !request.grid.empty() || request.densityScale || request.opticalDepth || request.up;
  if (volumeOptions && !request.bareVolume()) {
    fail("--grid, --density-scale, --optical-depth and --up are for bare volumes; in a scene use --set, such as "
         "--set media.0.density_scale=2");
  }
  if (isMesh(request.input)) {
    fail("{}", meshAdvice(request.input));
  }
  if (request.densityScale && request.opticalDepth) {
    fail("--density-scale and --optical-depth both say how dense the volume is; give one of them");
  }
  const bool marches = request.method.value_or(render::Method::March) == render::Method::March;
  if (request.preview && (!marches || request.deltaTracking)) {
    fail("--preview is the march without its correction, others have none; leave --preview or {} away",
         request.deltaTracking ? "--tracker" : "--estimator");
  }
  if (request.moments && (request.resume || request.error)) {
    fail("--moments: squares of samples are in no checkpoint, and --error leaves samples out of the picture; leave {} away",
         request.resume ? "--resume" : "--error");
  }
  if (request.method.value_or(render::Method::Tracking) != render::Method::Tracking && request.deltaTracking) {
    fail("--tracker: only tracking has a choice of trackers; give it with --estimator tracking, or leave it away");
  }
  if (volume::isSequence(fs::path(request.input).filename().string()) && !request.frames &&
      !fs::exists(request.input)) {
    fail("{}: names a sequence; say which frames to render, such as --frames 1-48", request.input);
  }
  if (request.frames && request.bareVolume() && !volume::isSequence(request.input)) {
    fail("--frames: {} is one file; put a placeholder where the frame's number stands, as in smoke_%04d.vdb or "
         "smoke_####.vdb",
         request.input);
  }
  // The picture of a single black pixel takes the same names.
  film::makeImage(film::Film(glm::uvec2(1), {glm::uvec2(0), glm::uvec2(1)}), {.aovs = request.aovs});
}

/// A render must not write over what it reads.
void checkNotInput(const RenderRequest& request, const fs::path& path) {
  std::error_code missing;
  if (!path.empty() && fs::equivalent(path, request.input, missing) && !missing) {
    fail("{}: is the input; name another file", path.string());
  }
}

void checkOutputs(const RenderRequest& request) {
  const std::optional<int> frame = request.frames ? std::optional(request.frames->first) : std::nullopt;
  const OutputFiles files = outputFiles(request, frame);
  for (const fs::path& path :
       {files.exr, files.png, files.checkpoint, files.part, files.statistics, request.writeScene}) {
    if (!path.empty()) {
      checkNotInput(request, path);
      checkWritable(path);
    }
  }
}

} // namespace

bool RenderRequest::bareVolume() const { return lowerExtension(input) == ".vdb"; }

bool RenderRequest::deviceAovs() const {
  return std::any_of(aovs.begin(), aovs.end(),
                     [](const std::string& name) { return name == "depth" || name == "albedo"; });
}

OutputFiles outputFiles(const RenderRequest& request, std::optional<int> frame) {
  OutputFiles files;
  files.exr = numbered(request.output, frame);
  files.png = files.exr;
  files.png.replace_extension(".png");
  files.checkpoint = withSuffix(files.exr, ".checkpoint");
  files.part = request.mergeable ? withSuffix(files.exr, ".part") : fs::path();
  files.statistics = numbered(request.statistics, frame);
  return files;
}

void settle(RenderRequest& request) {
  checkCombinations(request);
  if (request.deltaTracking) {
    request.method = render::Method::Tracking; // who names a tracker wants to see it at work
  }
  request.output = settledOutput(request);
  if (!request.frames && volume::isSequence(request.output.filename().string()) && !request.bareVolume()) {
    fail("-o {}: a placeholder for the frame needs --frames a-b", request.output.string());
  }
  checkOutputs(request);
}

} // namespace tyndall::app
