// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/film.h"
#include "render/estimator.h"
#include "scene/auto_scene.h"
#include "scene/load.h"
#include "volume/sequence.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tyndall::app {

/// What `tyndall render` was asked for, each value checked by itself. nullopt: the scene decides.
struct RenderRequest {
  std::string input;            ///< scene, volume, or a pattern of volumes
  std::filesystem::path output; ///< .exr, maybe with a frame placeholder
  std::optional<std::uint32_t> samples;
  std::optional<double> seconds;
  std::optional<double> error; ///< relative
  std::optional<glm::uvec2> size;
  std::optional<film::Window> crop;
  std::optional<std::uint32_t> seed;
  std::optional<std::uint32_t> depth; ///< scattering events, 0 = unlimited
  std::vector<scene::Override> overrides;
  std::vector<std::string> aovs;
  bool guideViews = false; ///< layers of what guides the paths
  bool moments = false;    ///< a layer of second moments
  bool transparent = false;
  std::optional<double> exposure; ///< stops
  bool chooseExposure = false;    ///< --exposure auto
  bool resume = false;
  double checkpointSeconds = 20.0;
  std::filesystem::path statistics; ///< empty: none
  std::filesystem::path writeScene; ///< empty: none
  bool quiet = false;
  bool mergeable = false;
  std::optional<render::Method> method; ///< nullopt: chosen for the scene
  render::RayCaster rays = render::RayCaster::Auto;
  bool preview = false;                 ///< biased: the march without its correction
  std::optional<bool> deltaTracking;    ///< --tracker; nullopt: not asked for
  std::string device;                   ///< index or part of the name
  std::optional<double> memoryBytes;
  std::optional<volume::FrameRange> frames;

  // Bare volumes alone.
  std::string grid;
  std::optional<double> densityScale;
  std::optional<double> opticalDepth;
  std::optional<scene::UpAxis> up;

  bool bareVolume() const;
  /// Whether layers are wanted that the device has to collect.
  bool deviceAovs() const;
};

/// Files of one picture.
struct OutputFiles {
  std::filesystem::path exr;
  std::filesystem::path png;
  std::filesystem::path checkpoint;
  std::filesystem::path part;       ///< empty unless mergeable
  std::filesystem::path statistics; ///< empty unless asked for
};

/// Names for one frame, or for the only picture.
OutputFiles outputFiles(const RenderRequest& request, std::optional<int> frame);

/// Completes the request (the output's name) and checks what needs no scene: combinations of options, layer names,
/// that every output can be written. @throws Error
void settle(RenderRequest& request);

} // namespace tyndall::app
