// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/fields_animation.h"
#include "scene/fields_guide.h"
#include "scene/fields_lights.h"
#include "scene/fields_media.h"
#include "scene/fields_surfaces.h"

/// The keys of a scene file, once: name, meaning, range; this file and the fields_*.h that it includes. Reader, writer
/// and schema are visitors of these functions. A visitor offers type, choice, word, text, file, number, whole, flag,
/// point, direction, triple, pair, object, optional, list, transform, transforms, matrix and keys, each (key, target, [range
/// or names,] help), and three modifiers: required() for the next key, applies(condition, when) for all the following
/// ones, always() to end that. A triple is one number for all three components, or three. type() is required; it
/// returns false if the type cannot be told, and the rest of that object is then left alone.
namespace tyndall::scene {

template <class V>
void fields(V& v, Camera& camera) {
  v.choice("type", camera.kind, Names<Camera::Kind>(kCameraTypes), "the projection");
  v.applies(camera.kind == Camera::Kind::File, "type \"file\"");
  v.required().file("file", camera.file, "a .gltf or .glb file that holds cameras");
  v.text("name", camera.name, "of the camera in the file; its first one if left out");
  v.applies(camera.kind != Camera::Kind::File, "type \"perspective\" or \"orthographic\"");
  v.point("position", camera.position, "where the camera stands, scene units");
  v.point("target", camera.target, "a point in the middle of the picture, scene units");
  v.direction("up", camera.up, "the direction that is up in the picture");
  v.applies(camera.kind == Camera::Kind::Perspective, "type \"perspective\"");
  v.number("vertical_fov", camera.verticalFov, Range{0.0, 179.0, "degrees", true},
           "full angle from the bottom to the top of the picture");
  v.number("lens_radius", camera.lensRadius, Range{0.0, kLargestLength, "scene units"}, "0 has everything in focus");
  if (camera.lensRadius > 0.0) {
    v.required();
  }
  v.number("focus_distance", camera.focusDistance, kPositiveLength,
           "to the plane in focus, along the view direction; to be given where lens_radius is not 0");
  v.applies(camera.kind == Camera::Kind::Orthographic, "type \"orthographic\"");
  v.number("height", camera.height, kPositiveLength, "what is seen from the bottom to the top of the picture");
  v.always();
}

template <class V>
void fields(V& v, FilmSettings& film) {
  v.pair("size", film.size, WholeRange{1, 65536}, "width and height, pixels");
  v.number("exposure", film.exposure, Range{-64.0, 64.0, "stops"}, "for the PNG only");
  v.choice("view", film.view, Names<View>(kViews), "tone curve of the PNG");
  v.flag("transparent", film.transparent, "leave the background out of R, G, B; it stays in a layer of its own");
}

template <class V>
void fields(V& v, RenderSettings& render) {
  v.whole("samples", render.samples, WholeRange{1, 1u << 30}, "per pixel");
  v.whole("seed", render.seed, WholeRange{0, 0xffffffffu}, "of the random numbers");
  v.whole("depth", render.depth, WholeRange{0, 1u << 16},
          "scattering events at most, 0 for unlimited; null: 1 without objects, else unlimited");
  v.choice("integrator", render.integrator, Names<Integrator>(kIntegrators), "how directions of paths are drawn");
  v.flag("light_sampling", render.lightSampling,
         "send shadow rays to lights; false: lights that have a size are found by directions alone");
  v.flag("deterministic", render.deterministic, "the same bits from every run, of guided pictures too");
}

template <class V>
void fields(V& v, Scene& scene) {
  v.text("name", scene.name, "a title; the file's name if left out");
  v.object("camera", scene.camera, "where the picture is taken from");
  v.object("film", scene.film, "what the picture is");
  v.object("render", scene.render, "how much work goes into it");
  if (scene.guide.preset != scene.render.integrator) {
    scene.guide = guideSettings(scene.render.integrator); // what is not given is the integrator's own
  }
  v.object("guide", scene.guide, "path guiding, for all integrators but \"path\"");
  v.list("media", scene.media, "what fills space");
  v.list("lights", scene.lights, "what shines from outside the media");
  v.list("materials", scene.materials, "what surfaces are made of");
  v.list("objects", scene.objects, "surfaces");
  v.object("animation", scene.animation, "what moves from frame to frame");
}

} // namespace tyndall::scene
