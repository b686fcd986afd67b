// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/render_request.h"
#include "gpu_scene/volumes.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tyndall::app {

/// The scene of a request, made up for a bare volume, with the command line's changes.
struct Source {
  scene::Scene scene;                          ///< of the first frame; files of a sequence still as patterns
  std::string text;                            ///< of the scene file, where something moves
  std::optional<gpu_scene::VolumeSet> volumes; ///< of exposureFrame, where loading them was needed anyway
  bool chooseExposure = false;                 ///< scene.film.exposure is still to be chosen
  std::optional<int> exposureFrame;            ///< ... from this frame of a sequence
  bool madeUp = false;
};

/// Sentences for the user who has not asked for quiet.
using Say = std::function<void(const std::string&)>;

/// Reads a scene or makes one for a bare volume. Warnings are logged.
/// @throws Error if the scene or a volume is bad; the text has every problem, one per line.
Source readSource(const RenderRequest& request, double memoryBudget, const Say& say);

/// The scene with its places and files of one frame; as it is for no frame.
/// @throws Error if a frame is given and nothing moves, if a sequence has no frame, or if the frame is not sound.
scene::Scene sceneOfFrame(const Source& source, const RenderRequest& request, std::optional<int> frame);

/// 64-bit hash, as hex, of everything that decides the bits of a picture: the scene with what its files hold, the
/// storage of its voxels, and the estimator. Sample counts, seed, exposure and names have no say.
std::string sceneHash(const scene::Scene& scene, const gpu_scene::VolumeSet& volumes,
                      const render::EstimatorOptions& estimator);

} // namespace tyndall::app
