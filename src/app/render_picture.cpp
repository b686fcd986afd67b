// SPDX-License-Identifier: Apache-2.0
#include "app/render_picture.h"

#include "app/device_options.h"
#include "app/picture_files.h"
#include "app/render_progress.h"
#include "app/render_text.h"
#include "film/checkpoint.h"
#include "film/merge.h"
#include "render/guide_views.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

namespace tyndall::app {
namespace {

/// Where only a time or an error ends a render.
constexpr std::uint32_t kNoSampleLimit = 1u << 30;

std::string percent(double share) { return fmt::format("{:.2g} %", 100.0 * share); }

std::string errorInWords(const film::ErrorEstimate& error) {
  if (!std::isfinite(error.relative)) {
    return "error not known from so few samples";
  }
  return fmt::format("error {} (below {} with 90 % confidence)", percent(error.relative),
                     std::isfinite(error.upper) ? percent(error.upper) : "an unknown bound");
}

film::Film renderWithProgress(const PictureContext& context, const Prepared& prepared, const OutputFiles& files,
                              render::RenderReport& report) {
  const RenderRequest& request = context.request;
  ProgressDisplay display(request.quiet);
  render::RenderOptions options;
  options.crop = request.crop.value_or(film::Window{});
  options.stop = stopRule(request, prepared.scene);
  options.seed = prepared.scene.render.seed;
  options.moments = request.moments;
  options.secondsBefore = prepared.timings.estimator;
  options.checkpoint = files.checkpoint;
  options.checkpointSeconds = request.checkpointSeconds;
  options.resume = request.resume;
  options.sceneHash = sceneHash(prepared.scene, prepared.volumes, estimatorOptions(request, prepared));
  options.interrupted = &context.interrupted;
  options.progress = [&](const render::Progress& progress) {
    render::Progress shown = progress;
    if (request.error && progress.error > 0.0) { // the error falls with the square root of the work
      shown.fraction = std::max(shown.fraction, std::min(1.0, std::pow(*request.error / progress.error, 2.0)));
    }
    display.show(shown);
  };
  return render::renderFilm(context.device, prepared.scene, prepared.volumes, *prepared.estimator, options, report);
}

/// Removes the checkpoint of a picture that is done, unless it is to be extended.
void settleCheckpoint(const PictureContext& context, const OutputFiles& files, bool complete) {
  if (!context.request.resume && complete) {
    film::removeCheckpoint(files.checkpoint);
  }
}

/// Mean over the samples of each pixel; 0 without samples.
std::vector<float> secondMoments(const film::Film& film, const std::vector<double>& squares) {
  std::vector<float> means;
  for (std::size_t pixel = 0; pixel < squares.size(); ++pixel) {
    const std::uint32_t samples = film.samples(pixel);
    means.push_back(samples > 0 ? float(squares[pixel] / samples) : 0.0f);
  }
  return means;
}

void writeFiles(const PictureContext& context, const Prepared& prepared, const OutputFiles& files, RenderRecord& record,
                film::Film& film) {
  const Stopwatch watch;
  const scene::FilmSettings& settings = prepared.scene.film;
  record.error = film::estimateError(film);
  for (const auto& [key, value] : pictureMetadata(record)) {
    film.metadata[key] = value;
  }
  const PictureSettings picture{.transparent = settings.transparent,
                                .opaqueBackground = prepared.gpuScene->features().background,
                                .aovs = context.request.aovs,
                                .png = {settings.exposure, filmView(settings.view)}};
  noteSettings(picture, film.metadata);
  std::map<std::string, std::vector<float>> layers;
  if (context.request.guideViews) {
    layers = render::guideViews(*prepared.estimator, film);
  }
  if (context.request.moments) {
    layers["second_moment.Y"] = secondMoments(film, record.report.sampleSquares);
  }
  record.png = writePicture(files.exr, film, picture, layers).report;
  if (!files.part.empty()) {
    film::saveCheckpoint(files.part, film);
  }
  settleCheckpoint(context, files, record.report.stoppedBy != "interrupt");
  record.timings.write = watch.seconds();
  if (!files.statistics.empty()) {
    writeText(files.statistics, statisticsJson(record, film.metadata));
  }
}

/// Most samples of any pixel: pixels that see the background alone are done sooner.
std::uint32_t samplesPerPixel(const film::Film& film) {
  std::uint32_t most = 0;
  for (const film::PixelState& pixel : film.pixels()) {
    most = std::max(most, pixel.samples[0] + pixel.samples[1]);
  }
  return most;
}

void sayWhatCameOut(const PictureContext& context, const RenderRecord& record, const film::Film& film,
                    const OutputFiles& files) {
  const render::RenderReport& report = record.report;
  context.say(fmt::format("{} samples per pixel in {} (stopped by {}), {}, {} of "
                          "the PNG's pixels clipped",
                          samplesPerPixel(film), formatDuration(report.seconds), report.stoppedBy,
                          context.request.preview ? errorInWords(record.error) + " and a bias that it does not know"
                                                  : errorInWords(record.error),
                          percent(record.png.clippedShare)));
  if (report.totals.events > 0) {
    context.say(fmt::format("paths: {:.2f} scattering events per sample, {} in the longest",
                            double(report.totals.events) / double(report.totals.samples), report.totals.longest));
  }
  if (report.guideGain) {
    context.say(fmt::format("guiding: {:.2g} times the variance x time of going without it{}", 1.0 / *report.guideGain,
                            *report.guideGain < 1.0 ? ", so it was switched off after the trial" : ""));
  }
  if (report.totals.negative > 0) {
    context.say(fmt::format("{} samples were negative, which this estimator may produce", report.totals.negative));
  }
  context.say(fmt::format("wrote {} and {}", files.exr.string(), files.png.string()));
  if (!files.part.empty()) {
    context.say(fmt::format("wrote {} for tyndall merge", files.part.string()));
  }
}

int judge(const PictureContext& context, const RenderRecord& record, const film::Film& film, const OutputFiles& files) {
  const std::uint64_t nonFinite = film::countOf(film.metadata, "nonFinite"); // of earlier runs too
  const std::uint64_t majorantExceeded = film::countOf(film.metadata, "majorantExceeded");
  const std::uint64_t cut = film::countOf(film.metadata, "cut");
  if (context.request.preview) {
    spdlog::warn("{} is BIASED (--preview): its error estimate does not know by how much; render without --preview "
                 "for the picture that counts",
                 files.exr.string());
  }
  if (nonFinite > 0 || majorantExceeded > 0 || cut > 0) {
    spdlog::error("{}: the picture is not sound: {} samples were not finite and left out, {} lookups exceeded their "
                  "majorant, {} rays were cut short; please report this with the scene, and use the picture with care",
                  files.exr.string(), nonFinite, majorantExceeded, cut);
    return kFailed;
  }
  if (record.report.stoppedBy == "interrupt") {
    spdlog::warn("interrupted: {} holds what was there; the same command with --resume goes on", files.exr.string());
    return kInterrupted;
  }
  if (context.request.seconds && context.request.samples && record.report.stoppedBy == "time") {
    spdlog::warn("the time limit came before {} samples per pixel", *context.request.samples);
  }
  return kDone;
}

/// What the grids in the estimator's layout, surfaces, the light caches and the estimator's own buffers take.
double plannedBytes(const PictureContext& context, const Prepared& prepared) {
  const bool cells = render::layoutOf(prepared.choice.method) == gpu_scene::GridLayout::Cells;
  const double grids = cells ? gpu_scene::plannedCellBytes(prepared.gpuScene->media(), prepared.volumes)
                             : prepared.volumes.deviceBytes();
  const render::EstimatorOptions options = estimatorOptions(context.request, prepared);
  const double chains = prepared.guide ? prepared.guide->store->bytes() : 0.0;
  return grids + chains + double(prepared.gpuScene->surfaceBytes()) + prepared.estimator->caches().bytes +
         render::plannedBytes(context.device, options);
}

} // namespace

render::StopRule stopRule(const RenderRequest& request, const scene::Scene& scene) {
  const bool otherLimit = request.seconds || request.error;
  return {.samples = otherLimit ? request.samples.value_or(kNoSampleLimit) : scene.render.samples,
          .seconds = request.seconds,
          .error = request.error};
}

render::EstimatorOptions estimatorOptions(const RenderRequest& request, const Prepared& prepared) {
  const bool deterministic = prepared.scene.render.deterministic; // then the time they take decides nothing
  return {.method = prepared.choice.method,
          .aovs = request.deviceAovs(),
          .deltaTracking = request.deltaTracking.value_or(false),
          .preview = request.preview,
          .cacheBytes = prepared.choice.cacheBytes,
          .techniques = prepared.scene.render.lightSampling ? interop::kTechniqueLight | interop::kTechniqueDirection
                                                            : interop::kTechniqueDirection,
          .rays = deterministic && request.rays == render::RayCaster::Auto ? render::RayCaster::Tree : request.rays,
          .guide = prepared.guide};
}

int renderPicture(const PictureContext& context, const Prepared& prepared, const OutputFiles& files) {
  render::RenderReport report;
  film::Film film = renderWithProgress(context, prepared, files, report);
  RenderRecord record{.request = context.request,
                      .scene = prepared.scene,
                      .volumes = prepared.volumes,
                      .device = context.device,
                      .report = report,
                      .choice = prepared.choice,
                      .surfaces = countSurfaces(prepared.gpuScene->surfaces(), prepared.gpuScene->emitters()),
                      .error = {},
                      .png = {},
                      .plannedBytes = plannedBytes(context, prepared),
                      .timings = prepared.timings,
                      .notes = prepared.volumes.notes};
  const std::vector<std::string>& sceneNotes = prepared.gpuScene->notes();
  record.notes.insert(record.notes.end(), sceneNotes.begin(), sceneNotes.end());
  writeFiles(context, prepared, files, record, film);
  sayWhatCameOut(context, record, film, files);
  return judge(context, record, film, files);
}

} // namespace tyndall::app
