// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/load.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace tyndall::scene::test {

/// A folder of its own with an empty smoke.vdb, sky.exr and room.glb in it: loading checks that files exist, not what
/// they hold.
class Folder {
public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("tyndall-scene-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
    for (const char* name : {"smoke.vdb", "sky.exr", "room.glb"}) {
      std::ofstream(path_ / name).put('\n');
    }
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

inline const std::filesystem::path& folder() {
  static const Folder instance;
  return instance.path();
}

inline LoadResult parse(const std::string& text, const std::vector<Override>& overrides = {}) {
  return parseScene(text, "test.json", folder(), overrides);
}

/// All problems as "line:column: message" lines, for messages of failing tests.
inline std::string listed(const LoadResult& result) {
  std::string text;
  for (const Problem& problem : result.problems) {
    text += std::string(problem.warning ? "warning " : "") + Error(problem.location, problem.message).what() + '\n';
  }
  return text;
}

/// A scene that uses every type and every key at least once.
inline const std::string& everything() {
  static const std::string text = R"({
  "$schema": "../docs/scene.schema.json",
  "name": "everything, \"quoted\" \u00e9\ud83d\ude00",
  "camera": {"type": "perspective", "position": [1.5, 2, 1e1], "target": [0, 0.1, 0], "up": [0, 2, 0],
             "vertical_fov": 37.5, "lens_radius": 0.0625, "focus_distance": 9.75},
  "film": {"size": [321, 240], "exposure": -1.25, "view": "filmic", "transparent": true},
  "render": {"samples": 128, "seed": 4294967295, "depth": 12, "integrator": "mcpg-paper",
             "light_sampling": false, "deterministic": true},
  "guide": {"unit": 0.025, "score": "path", "loads": 3, "states": 5, "static_grid": false, "normals": false,
            "learn_share": true, "weight": "accepted", "fit": true, "newborn_share": 0.2,
            "fit_samples": 32, "learn": false, "watch": true,
            "cells": {"angle": 0.03, "finest": 2, "ratio": 1.5, "spread": 0.5},
            "radiance": {"angle": 0.04, "finest": 3, "ratio": 1.25, "spread": 0.25},
            "static_width": 50, "adaptive_share": 0.6, "prior_radius": 12, "prior_least": 0.001, "most_kappa": 1000,
            "kappa_growth": 0.5, "scatter_share": 0.4, "least_share": 0.2, "most_share": 0.9, "share_samples": 16,
            "least_rate": 0.02, "forget_below": 0.1, "forget_rate": 0.25, "radiance_limit": 16, "most_time": 0.125,
            "records": 4, "window": 2, "slots": 4096},
  "media": [
    {"name": "smoke", "type": "grid", "file": "smoke.vdb", "grid": "density", "density_scale": 0.1,
     "clip": {"min": [-1, -2, -3], "max": [1, 2, 3]}, "storage": "half", "background": true,
     "transform": [{"rotate": {"axis": [1, 2, 3], "degrees": 33.3}}, {"scale": 0.1}, {"translate": [1, 2, 3]},
                   {"matrix": [1, 0.5, 0, 4,  0, 1, 0, 5,  0, 0, 1, 6,  0, 0, 0, 1]}],
     "instances": [[], [{"translate": [4, 0, 0]}, {"scale": 0.5}, {"rotate": {"axis": [0, 1, 0], "degrees": 45}}]],
     "albedo": [0.1, 0.2, 0.3], "extinction_colour": [1, 0.5, 0.25],
     "phase": {"type": "two-lobe", "g1": 0.7, "g2": -0.2, "weight": 0.6},
     "emission": {"type": "blackbody", "grid": "temperature", "colour": [1, 0.5, 0.25], "scale": 1e-3,
                  "temperature_scale": 1000, "temperature_offset": 273.15, "temperature_auto": true,
                  "tied_to_absorption": true}},
    {"name": "fire", "type": "grid", "file": "smoke.vdb", "grid": "none",
     "emission": {"type": "linear", "grid": "flame", "colour": 2}},
    {"name": "box", "type": "homogeneous", "extinction": 1e-8, "albedo": 0, "phase": {"type": "draine", "g": 0.5, "alpha": 1},
     "shape": {"type": "box", "min": [-1, -1, -1], "max": [1, 1, 1]},
     "emission": {"type": "blackbody", "temperature": 2500}},
    {"name": "ball", "type": "homogeneous", "extinction": 1e8, "phase": {"type": "mie", "diameter": 5},
     "shape": {"type": "sphere", "centre": [1, 2, 3], "radius": 0.25}, "emission": {"type": "linear"}},
    {"name": "air", "type": "homogeneous", "extinction": 0, "phase": {"type": "rayleigh"}, "shape": {"type": "unbounded"}},
    {"name": "tea", "type": "homogeneous", "extinction": 3, "shape": {"type": "objects"}},
    {"type": "homogeneous", "extinction": 0.0, "phase": {"type": "henyey-greenstein", "g": -0.9999}}
  ],
  "lights": [
    {"name": "lamp", "type": "point", "position": [1, 2, 3], "intensity": 1e12},
    {"name": "sun", "type": "sun", "direction": [1, -1, 0.3], "irradiance": [1e-12, 2, 3], "angular_diameter": 0,
     "visible": false},
    {"name": "white", "type": "constant", "radiance": 0.5, "visible": false},
    {"name": "map", "type": "map", "file": "sky.exr", "scale": 2, "rotation": -30},
    {"name": "sky", "type": "sky", "sun_direction": [0.1, -0.7, 0.2], "turbidity": 4.5, "ground_albedo": [0, 0.5, 1],
     "scale": 20},
    {"name": "beam", "type": "spot", "position": [3, 2, 1], "direction": [0, 0, -4], "intensity": [5, 6, 7],
     "outer_angle": 15, "inner_angle": 12.5}
  ],
  "materials": [
    {"name": "nothing", "type": "null"},
    {"name": "wall", "type": "diffuse", "colour": [0.7, 0.6, 0.5], "opacity": 0.75, "emission": [10, 20, 30],
     "two_sided": true},
    {"name": "gold", "type": "conductor", "roughness": 0.3, "eta": [0.14, 0.37, 1.44], "k": [3.98, 2.38, 1.6]},
    {"name": "glass", "type": "dielectric", "ior": 1.33, "roughness": 0.05},
    {"name": "paint", "type": "metal_rough", "colour": 0.2, "metallic": 0.6, "roughness": 0.4, "ior": 1.6}
  ],
  "objects": [
    {"name": "room", "type": "mesh", "file": "room.glb", "lights": false,
     "transform": [{"scale": [1, 2, 3]}, {"translate": [1, 0, 0]}, {"rotate": {"axis": [0, 0, 1], "degrees": 180}}],
     "instances": [[{"translate": [1, 0, 0]}], [{"rotate": {"axis": [0, 1, 0], "degrees": 9}}, {"scale": 2}]]},
    {"name": "lamp", "type": "quad", "material": "wall", "origin": [1, 2, 3], "edge_u": [0, 1, 0], "edge_v": [0, 0, 1]},
    {"name": "cup", "type": "box", "min": [-1, -2, -3], "max": [1, 2, 3], "material": "glass", "medium": "tea",
     "priority": 7},
    {"name": "ball", "type": "sphere", "centre": [0.5, 0.25, 0], "radius": 0.125, "material": "gold",
     "transform": [{"translate": [0, 0, 0]}]}
  ],
  "animation": {"frames_per_second": 25, "tracks": [
    {"target": "lights.beam.position", "keys": [[1, [3, 2, 1]], [24, [1, 2, 3]]]},
    {"target": "objects.ball.transform.0.translate", "interpolation": "linear", "keys": [[1, [0, 0, 0]], [24.5, [2, 0, 0]]]},
    {"target": "lights.map.file", "interpolation": "step", "keys": [[-3, "sky.exr"]]}
  ]}
}
)";
  return text;
}

} // namespace tyndall::scene::test
