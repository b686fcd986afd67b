// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"
#include "volume/load.h"

#include <optional>
#include <string>
#include <vector>

namespace tyndall::scene {

/// Which axis of the volume's own space points up.
enum class UpAxis { Y, Z };

/// The loaded grids of one file. Borrowed for the call; null or empty: nothing is there.
struct AutoFrame {
  const volume::BrickGrid* density = nullptr;
  const volume::BrickGrid* temperature = nullptr;
};

struct AutoInput {
  std::string file;                    ///< what the medium names: a .vdb, or the pattern of a sequence
  volume::GridChoice grids;
  std::vector<AutoFrame> frames;       ///< one, or all of a sequence
  glm::uvec2 size{640, 480};
  UpAxis up = UpAxis::Y;
  std::optional<double> opticalDepth;  ///< median to aim at, of the densest frame; within 3 to 8 if not given
  std::optional<double> densityScale;  ///< used as it is instead
};

struct AutoScene {
  Scene scene;                          ///< exposure still 0: choosing it takes a rendered picture
  std::size_t densestFrame = 0;         ///< what the exposure is to be chosen from
  double medianOpticalDepth = 0.0;      ///< of the densest frame, at the scene's density scale
  bool empty = false;                   ///< no frame has anything to see
  std::vector<std::string> notes;       ///< sentences for the user
};

/// A picture of a bare volume: framed, lit by sun and sky from over the viewer's shoulder, its extinction scaled; a
/// temperature grid glows. One framing and one scale serve all frames.
AutoScene makeAutoScene(const AutoInput& input);

} // namespace tyndall::scene
