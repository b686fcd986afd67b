// SPDX-License-Identifier: Apache-2.0
#include "app/render_statistics.h"

#include "film/merge.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace tyndall::app {
namespace {

using Json = nlohmann::ordered_json;

Json finiteOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// What made the picture, its bias included.
std::string estimatorText(const RenderRecord& record) {
  const std::string name = render::methodName(record.choice.method);
  return record.request.preview ? name + ", preview (biased)" : name;
}

Json gridsJson(const gpu_scene::VolumeSet& volumes) {
  Json result = Json::array();
  for (const volume::BrickGrid& grid : volumes.grids) {
    result.push_back({{"name", grid.name},
                      {"storage", volume::storageName(grid.storage)},
                      {"active_voxels", grid.activeVoxels},
                      {"bricks", grid.bricks.size()},
                      {"bricks_with_voxels", grid.slotCount()},
                      {"device_bytes", grid.deviceBytes()},
                      {"worst_voxel_error", grid.report.quantisationError},
                      {"worst_optical_depth_error", grid.report.opticalDepthError},
                      {"negative_voxels", grid.report.negativeVoxels},
                      {"nonfinite_voxels", grid.report.nonFiniteVoxels},
                      {"notes", grid.report.notes}});
  }
  return result;
}

Json settingsJson(const RenderRecord& record) {
  const scene::Scene& scene = record.scene;
  Json settings{{"input", record.request.input},
                {"size", {scene.film.size.x, scene.film.size.y}},
                {"samples_limit", scene.render.samples},
                {"seed", scene.render.seed},
                {"depth", scene.depth() == 0 ? Json("unlimited") : Json(scene.depth())},
                {"estimator", estimatorText(record)},
                {"transparent", scene.film.transparent},
                {"exposure_stops", scene.film.exposure},
                {"view", scene.film.view == scene::View::Filmic ? "filmic" : "standard"}};
  if (record.request.seconds) {
    settings["time_limit_seconds"] = *record.request.seconds;
  }
  if (record.request.error) {
    settings["error_limit"] = *record.request.error;
  }
  if (record.request.crop) {
    const film::Window& crop = *record.request.crop;
    settings["crop"] = {crop.min.x, crop.min.y, crop.max.x, crop.max.y};
  }
  return settings;
}

/// How long paths were: scattering events in media and at surfaces.
Json pathsJson(const render::Totals& totals) {
  return {{"events", totals.events},
          {"mean_events_per_sample", totals.samples > 0 ? double(totals.events) / double(totals.samples) : 0.0},
          {"most_events_of_one", totals.longest}};
}

double ratio(std::uint64_t part, std::uint64_t whole) { return whole > 0 ? double(part) / double(whole) : 0.0; }

/// What guiding did, and what its store holds.
Json guidingJson(const RenderRecord& record, const render::GuideReport& guide) {
  const std::optional<double>& gain = record.report.guideGain;
  const render::GuideTotals& totals = guide.totals;
  return {{"integrator", scene::integratorName(record.scene.render.integrator)},
          {"gain", gain ? Json(*gain) : Json(nullptr)}, // of variance times time, measured on this picture
          {"switched_off", gain.value_or(1.0) < 1.0},
          {"vertices", totals.vertices},
          {"guided_share", ratio(totals.guided, totals.vertices)},
          {"states_per_vertex", ratio(totals.states, totals.vertices)},
          {"accepted_share", ratio(totals.accepted, totals.vertices)},
          {"forgotten", totals.forgotten},
          {"collisions", totals.evicted},
          {"unsound_scores", totals.unsound},
          {"lost_updates", totals.lost},
          {"store",
           {{"bytes", guide.bytes},
            {"cells", guide.size.cells},
            {"cells_taken", guide.occupancy.cells},
            {"static_cells", guide.size.staticCells},
            {"static_cells_taken", guide.occupancy.staticCells},
            {"states",
             (std::uint64_t(guide.size.cells) + guide.size.staticCells) * guide.size.states + guide.size.screen},
            {"states_taken", guide.occupancy.states},
            {"radiance_cells", guide.size.radiance},
            {"radiance_cells_taken", guide.occupancy.radiance},
            {"unsound_states", guide.occupancy.unsound}}}};
}

/// Of camera rays.
Json distancesJson(const render::GuideReport& guide) {
  return {{"rays", guide.totals.distanceRays},
          {"guided_share", ratio(guide.totals.distanceGuided, guide.totals.distanceRays)},
          {"states", guide.size.distanceVertices() * guide.size.distanceStates},
          {"states_taken", guide.occupancy.distances}};
}

} // namespace

std::string statisticsJson(const RenderRecord& record, const film::Metadata& metadata) {
  const render::RenderReport& report = record.report;
  const render::Totals& totals = report.totals;
  Json root;
  root["version"] = TYNDALL_VERSION;
  root["device"] = {{"name", record.device.info().name},
                    {"driver", record.device.info().driver},
                    {"type", record.device.info().type},
                    {"memory_bytes", record.device.info().memoryBytes}};
  root["settings"] = settingsJson(record);
  root["stopped_by"] = report.stoppedBy;
  root["seconds"] = {{"start", record.timings.start},
                     {"load", record.timings.load},
                     {"upload", record.timings.upload},
                     {"exposure", record.timings.exposure},
                     {"estimator", record.timings.estimator}, // a part of the next two
                     {"compile_and_first_dispatch", report.firstDispatchSeconds},
                     {"render", report.seconds},
                     {"write", record.timings.write}};
  root["samples"] = totals.samples;
  if (record.choice.method == render::Method::Path) {
    root["paths"] = pathsJson(totals);
    root["surfaces"] = toJson(record.surfaces);
  }
  if (report.guide) {
    root["guiding"] = guidingJson(record, *report.guide);
    root["guiding"]["distances"] = distancesJson(*report.guide);
  }
  root["density_lookups"] = totals.lookups;
  root["segments"] = totals.segments;
  root["ray_pieces"] = totals.steps;
  root["dispatches"] = totals.dispatches;
  root["pixels"] = {{"media", report.mediaPixels}, {"background_only", report.backgroundPixels}};
  root["device_bytes"] = {{"planned", record.plannedBytes}, {"peak", record.device.peakBytes()}};
  root["kernel_bytes"] = report.kernelBytes;
  root["estimator"] = {{"name", render::methodName(record.choice.method)},
                       {"reason", record.choice.reason},
                       {"biased", record.request.preview}};
  root["light_caches"] = {{"count", report.caches.count},
                          {"dropped", report.caches.dropped},
                          {"bytes", report.caches.bytes},
                          {"build_seconds", report.caches.seconds}};
  root["grids"] = gridsJson(record.volumes);
  root["pipeline"] = report.pipeline;
  root["counters"] = {{"nonfinite_samples", totals.nonFinite},
                      {"majorant_exceeded", totals.majorantExceeded},
                      {"negative_samples", totals.negative},
                      {"resumed_tracks", totals.resumed},
                      {"cut_rays", totals.cut}};
  root["error"] = {{"relative", finiteOrNull(record.error.relative)},
                   {"upper_bound_90_percent", finiteOrNull(record.error.upper)},
                   {"covered_pixels", record.error.coveredPixels}};
  root["png"] = {{"clipped_share", record.png.clippedShare}, {"nonfinite_pixels", record.png.nonFinitePixels}};
  root["notes"] = record.notes;
  root["metadata"] = metadata;
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

film::Metadata pictureMetadata(const RenderRecord& record) {
  film::Metadata metadata;
  metadata["input"] = record.request.input;
  metadata["scene.name"] = record.scene.name;
  metadata["depth"] = record.scene.depth() == 0 ? "unlimited" : std::to_string(record.scene.depth());
  metadata["estimator"] = estimatorText(record);
  metadata["estimator.biased"] = record.request.preview ? "1" : "0";
  metadata["stop.reason"] = record.report.stoppedBy;
  metadata["stop.samples"] = std::to_string(record.scene.render.samples);
  metadata["error.relative"] = fmt::format("{:.6g}", record.error.relative);
  metadata["error.upper"] = fmt::format("{:.6g}", record.error.upper);
  for (const volume::BrickGrid& grid : record.volumes.grids) {
    metadata["grid." + grid.name + ".storage"] = volume::storageName(grid.storage);
  }
  return metadata;
}

} // namespace tyndall::app
