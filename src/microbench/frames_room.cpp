// SPDX-License-Identifier: Apache-2.0
#include "microbench/frames_room.h"

#include <fmt/format.h>

namespace tyndall::microbench {
namespace {

constexpr const char* kRoom = R"({{
  "name": "room",
  "camera": {{ "position": [-1.75, 1.3, 1.75], "target": [0.3, 1.1, -0.6], "vertical_fov": 66 }},
  "film": {{ "exposure": 1, "view": "filmic" }},
  "render": {{ "depth": 2, "light_sampling": false }},
  "guide": {{ "watch": false }},
  "materials": [
    {{ "name": "plaster", "type": "diffuse", "colour": [0.75, 0.72, 0.68] }},
    {{ "name": "blue", "type": "diffuse", "colour": [0.2, 0.32, 0.55] }},
    {{ "name": "wood", "type": "diffuse", "colour": [0.5, 0.33, 0.2] }},
    {{ "name": "bright", "type": "diffuse", "colour": 0, "emission": [60, 60, 60] }},
    {{ "name": "dim", "type": "diffuse", "colour": 0, "emission": [20, 20, 20] }}
  ],
  "objects": [
    {{ "name": "floor", "type": "quad", "origin": [-2, 0, 2], "edge_u": [4, 0, 0], "edge_v": [0, 0, -4], "material": "wood" }},
    {{ "name": "ceiling", "type": "quad", "origin": [-2, 2.5, -2], "edge_u": [4, 0, 0], "edge_v": [0, 0, 4], "material": "plaster" }},
    {{ "name": "back", "type": "quad", "origin": [-2, 0, -2], "edge_u": [4, 0, 0], "edge_v": [0, 2.5, 0], "material": "plaster" }},
    {{ "name": "front", "type": "quad", "origin": [2, 0, 2], "edge_u": [-4, 0, 0], "edge_v": [0, 2.5, 0], "material": "plaster" }},
    {{ "name": "left", "type": "quad", "origin": [-2, 0, 2], "edge_u": [0, 0, -4], "edge_v": [0, 2.5, 0], "material": "blue" }},
    {{ "name": "right", "type": "quad", "origin": [2, 0, -2], "edge_u": [0, 0, 4], "edge_v": [0, 2.5, 0], "material": "plaster" }},
    {{ "name": "ball", "type": "sphere", "centre": [0.6, 0.45, -0.9], "radius": 0.45, "material": "plaster" }},
    {{ "name": "bright", "type": "sphere", "centre": [-0.9, 1.9, -0.7], "radius": 0.12, "material": "bright" }},
    {{ "name": "dim", "type": "sphere", "centre": [1.4, 1.5, 0.9], "radius": 0.12, "material": "dim" }}
  ],
  "animation": {{ "frames_per_second": 24, "tracks": [{}] }}
}}
)";

constexpr double kStep = 0.07; ///< of the lamp that moves, a frame
constexpr int kLastFrame = 30; ///< it is still in the room then

/// The place of the lamp that moves. It passes its place of the first frames at the frame of the event.
std::string place(int frame) { return fmt::format("[{:.4f}, 1.9, -0.7]", -0.9 + kStep * (frame - kEventFrame)); }

std::string step(const std::string& target, const std::string& before, const std::string& after, bool always) {
  return fmt::format(R"({{ "target": "{}", "interpolation": "step", "keys": [[1, {}], [{}, {}]] }})", target,
                     always ? after : before, kEventFrame + 1, after);
}

std::string tracks(RoomEvent event, bool always) {
  switch (event) {
  case RoomEvent::Out:
    return step("materials.bright.emission", "[60, 60, 60]", "[0, 0, 0]", always);
  case RoomEvent::Moves: {
    const int first = always ? 1 : kEventFrame;
    return fmt::format(R"({{ "target": "objects.bright.centre", "keys": [[{}, {}], [{}, {}]] }})", first, place(first),
                       kLastFrame, place(kLastFrame));
  }
  case RoomEvent::Teleports:
    return step("objects.bright.centre", "[-0.9, 1.9, -0.7]", "[1.3, 0.9, -1.4]", always);
  case RoomEvent::Cut:
    return step("camera.position", "[-1.75, 1.3, 1.75]", "[1.75, 1.5, -1.75]", always) + ", " +
           step("camera.target", "[0.3, 1.1, -0.6]", "[-0.5, 0.9, 0.6]", always);
  }
  return {};
}

} // namespace

const char* roomEventName(RoomEvent event) {
  constexpr const char* kNames[] = {"out", "moves", "teleports", "cut"};
  return kNames[static_cast<int>(event)];
}

Sequence roomSequence(RoomEvent event, bool always) {
  return {roomEventName(event), fmt::format(kRoom, tracks(event, always)), {}};
}

} // namespace tyndall::microbench
