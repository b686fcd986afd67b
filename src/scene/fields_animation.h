// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/field_names.h"
#include "scene/fields_space.h"

/// Keys of a scene file about what moves; see fields.h.
namespace tyndall::scene {

template <class V>
void fields(V& v, Track& track) {
  v.required().text("target", track.target, "the path of a value, as for --set: lights.lamp.position");
  v.choice("interpolation", track.interpolation, Names<Interpolation>(kInterpolations),
           "linear: numbers and lists of numbers, component by component; step: anything, until the next key");
  v.required().keys("keys", track, "pairs of a frame and the value there, frames ascending");
}

template <class V>
void fields(V& v, Animation& animation) {
  v.number("frames_per_second", animation.framesPerSecond, Range{0.0, 1e6, "", true},
           "how fast the animations of glTF files play");
  v.list("tracks", animation.tracks, "values that move");
}

} // namespace tyndall::scene
