// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/ranges.h"
#include "scene/scene.h"

#include <array>
#include <string_view>

/// The keys of a scene file, once: name, meaning, range. Reader, writer and schema are visitors of these functions.
/// A visitor offers type, choice, word, text, file, number, whole, flag, point, direction, triple, pair, object,
/// optional, list, transform and matrix, each (key, target, [range or names,] help), and three modifiers: required()
/// for the next key, applies(condition, when) for all the following ones, always() to end that. A triple is one
/// number for all three components, or three. type() is required; it returns false if the type cannot be told, and
/// the rest of that object is then left alone.
namespace tyndall::scene {

template <class Enum, std::size_t N>
using NameTable = std::array<std::pair<std::string_view, Enum>, N>;

inline constexpr NameTable<Camera::Kind, 2> kCameraTypes{
    {{"perspective", Camera::Kind::Perspective}, {"orthographic", Camera::Kind::Orthographic}}};
inline constexpr NameTable<View, 2> kViews{{{"standard", View::Standard}, {"filmic", View::Filmic}}};
inline constexpr NameTable<MediumShape, 3> kShapeTypes{
    {{"unbounded", MediumShape::Unbounded}, {"box", MediumShape::Box}, {"sphere", MediumShape::Sphere}}};
inline constexpr NameTable<Emission::Kind, 2> kEmissionTypes{
    {{"linear", Emission::Kind::Linear}, {"blackbody", Emission::Kind::Blackbody}}};
inline constexpr NameTable<bool, 2> kMediumTypes{{{"homogeneous", true}, {"grid", false}}};
inline constexpr std::array<std::string_view, 4> kStorages{"auto", "unorm8", "half", "float"};

/// A light's type is the index of its alternative in Light.
inline constexpr NameTable<std::size_t, 5> kLightTypes{
    {{"point", 0}, {"sun", 1}, {"constant", 2}, {"map", 3}, {"sky", 4}}};
static_assert(kLightTypes.size() == std::variant_size_v<Light>);

struct PhaseName {
  std::string_view name;
  PhaseId id;
  std::string_view parameters; ///< in order, blank-separated
};
inline constexpr std::array kPhases{
#define X(Name, prefix, number, sceneName, parameterNames) PhaseName{sceneName, PhaseId::Name, parameterNames},
    TYNDALL_PHASE_LIST(X)
#undef X
};
inline constexpr auto kPhaseTypes = [] {
  NameTable<PhaseId, kPhases.size()> names{};
  for (std::size_t i = 0; i < names.size(); ++i) {
    names[i] = {kPhases[i].name, kPhases[i].id};
  }
  return names;
}();

/// Calls action(name, index) for each parameter of a phase function.
template <class Action>
void forEachParameter(std::string_view parameters, Action action) {
  for (std::size_t index = 0; !parameters.empty(); ++index) {
    const std::size_t end = std::min(parameters.find(' '), parameters.size());
    action(parameters.substr(0, end), index);
    parameters.remove_prefix(std::min(end + 1, parameters.size()));
  }
}

/// One step of a transform list; a step has exactly one of its keys.
struct TransformStep {
  struct Rotation {
    glm::dvec3 axis{0.0, 1.0, 0.0};
    double degrees = 0.0;
  };
  glm::dvec3 translate{0.0};
  Rotation rotate;
  glm::dvec3 scale{1.0};
  glm::dmat4 matrix{1.0};
};

// Views of a medium: objects of the file whose values are members of Medium.
struct ShapeOf {
  Medium& medium;
};
struct EmissionOf {
  Emission& emission;
  bool homogeneous;
};

template <class V>
void fields(V& v, Camera& camera) {
  v.choice("type", camera.kind, Names<Camera::Kind>(kCameraTypes), "the projection");
  v.point("position", camera.position, "where the camera stands, scene units");
  v.point("target", camera.target, "a point in the middle of the picture, scene units");
  v.direction("up", camera.up, "the direction that is up in the picture");
  v.applies(camera.kind == Camera::Kind::Perspective, "type \"perspective\"");
  v.number("vertical_fov", camera.verticalFov, Range{0.0, 179.0, "degrees", true},
           "full angle from the bottom to the top of the picture");
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
  v.whole("depth", render.depth, WholeRange{1, 1u << 16}, "scattering events; this version renders 1");
}

template <class V>
void fields(V& v, TransformStep::Rotation& rotation) {
  v.required().direction("axis", rotation.axis, "of the rotation; it turns counterclockwise seen from its tip");
  v.required().number("degrees", rotation.degrees, Range{-1e6, 1e6, "degrees"}, "angle");
}

template <class V>
void fields(V& v, TransformStep& step) {
  v.point("translate", step.translate, "added to the position, scene units");
  v.object("rotate", step.rotate, "about an axis through the origin");
  v.triple("scale", step.scale, Range{-kLargestLength, kLargestLength}, "one factor, or one per axis; not 0");
  v.matrix("matrix", step.matrix, "16 numbers, row by row; the last row is 0 0 0 1");
}

template <class V>
void fields(V& v, Bounds3& bounds) {
  v.required().point("min", bounds.min, "the corner with the smallest coordinates");
  v.required().point("max", bounds.max, "the corner with the largest coordinates");
}

template <class V>
void fields(V& v, Phase& phase) {
  if (!v.type(phase.id, Names<PhaseId>(kPhaseTypes), "the phase function")) {
    return;
  }
  for (const PhaseName& model : kPhases) {
    v.applies(phase.id == model.id, "type \"" + std::string(model.name) + "\"");
    forEachParameter(model.parameters, [&](std::string_view name, std::size_t index) {
      double unused = 0.0;
      double& parameter = phase.id == model.id ? phase.parameters[index] : unused;
      v.required().number(name, parameter, phaseParameterRange(name), "parameter of the phase function");
    });
  }
  v.always();
}

template <class V>
void fields(V& v, EmissionOf& view) {
  Emission& emission = view.emission;
  if (!v.type(emission.kind, Names<Emission::Kind>(kEmissionTypes), "what the value or grid means")) {
    return;
  }
  const bool blackbody = emission.kind == Emission::Kind::Blackbody;
  v.triple("colour", emission.colour, kLight, "linear: the coefficient at value 1, W/(m3 sr); blackbody: a tint");
  v.number("scale", emission.scale, kLight, "factor");
  v.flag("tied_to_absorption", emission.tiedToAbsorption, "multiply by the absorption coefficient");
  v.applies(!view.homogeneous, "a medium of type \"grid\"");
  v.required().text("grid", emission.grid, "the emission or temperature grid's name in the medium's file");
  v.applies(!view.homogeneous && blackbody, "type \"blackbody\" in a medium of type \"grid\"");
  v.number("temperature_scale", emission.temperatureScale, Range{0.0, 1e9, "kelvin", true}, "per unit of the grid");
  v.number("temperature_offset", emission.temperatureOffset, Range{-1e6, 1e6, "kelvin"},
           "added: 273.15 for a grid in degrees Celsius");
  v.flag("temperature_auto", emission.temperatureAuto, "where scale is 1 and offset 0, map a grid whose maximum is below 500 K to a maximum of 2000 K");
  v.applies(view.homogeneous && blackbody, "type \"blackbody\" in a medium of type \"homogeneous\"");
  v.required().number("temperature", emission.temperature, kKelvin, "of the whole medium");
  v.always();
}

template <class V>
void fields(V& v, ShapeOf& view) {
  Medium& medium = view.medium;
  if (!v.type(medium.shape, Names<MediumShape>(kShapeTypes), "where the medium is")) {
    return;
  }
  v.applies(medium.shape == MediumShape::Box, "type \"box\"");
  fields(v, medium.box);
  v.applies(medium.shape == MediumShape::Sphere, "type \"sphere\"");
  v.point("centre", medium.centre, "of the sphere, medium space");
  v.number("radius", medium.radius, kPositiveLength, "of the sphere, medium space");
  v.always();
}

template <class V>
void fields(V& v, Medium& medium) {
  v.text("name", medium.name, "for messages and --set; unique among the media");
  bool homogeneous = medium.homogeneous();
  if (!v.type(homogeneous, Names<bool>(kMediumTypes), "one extinction, or a grid from a .vdb file")) {
    return;
  }
  ShapeOf shape{medium};
  v.transform("transform", medium.worldFromMedium, "steps from medium space to the world, the first one applied first");
  v.triple("albedo", medium.albedo, kFraction, "scattered share of the extinction");
  v.object("phase", medium.phase, "how scattered light spreads");
  v.applies(homogeneous, "type \"homogeneous\"");
  v.number("extinction", medium.sigmaT, kExtinction, "sigma_t");
  v.object("shape", shape, "where the medium is");
  v.applies(!homogeneous, "type \"grid\"");
  v.required().file("file", medium.file, "the .vdb file, relative to the scene file's folder");
  v.text("grid", medium.grid, "the density grid's name; \"\" chooses; \"none\" for emission only");
  v.number("density_scale", medium.densityScale, kExtinction, "extinction per unit of density");
  v.optional("clip", medium.clip, "keep only this box of the file's world space");
  v.word("storage", medium.storage, kStorages, "of a voxel on the device; auto is the narrowest within tolerance");
  v.flag("background", medium.background, "keep the file's background value inside the grid's bounds");
  v.always();
  v.optional("emission", medium.emission, "glowing media", [homogeneous](Emission& emission) {
    return EmissionOf{emission, homogeneous};
  });
}

template <class V>
void fields(V& v, PointLight& light) {
  v.point("position", light.position, "scene units");
  v.triple("intensity", light.intensity, kLight, "W / sr");
}
template <class V>
void fields(V& v, SunLight& light) {
  v.direction("direction", light.direction, "the way the light travels");
  v.triple("irradiance", light.irradiance, kLight, "W / m2 on a plane perpendicular to the light");
  v.number("angular_diameter", light.angularDiameter, Range{0.0, 90.0, "degrees"}, "of the disc; 0 for sharp shadows");
}
template <class V>
void fields(V& v, ConstantEnvironment& light) {
  v.triple("radiance", light.radiance, kLight, "W / (m2 sr) from every direction");
}
template <class V>
void fields(V& v, MapEnvironment& light) {
  v.required().file("file", light.file, "lat-long .exr, relative to the scene file's folder");
  v.number("scale", light.scale, kLight, "factor");
  v.number("rotation", light.rotation, Range{-1e6, 1e6, "degrees"}, "about +y");
}
template <class V>
void fields(V& v, SkyEnvironment& light) {
  v.direction("sun_direction", light.sunDirection, "the way the sun's light travels; downwards by day");
  v.number("turbidity", light.turbidity, Range{1.0, 10.0}, "haze, from pure air up");
  v.triple("ground_albedo", light.groundAlbedo, kFraction, "of the ground below the horizon");
  v.number("scale", light.scale, kLight, "1: the sun above the atmosphere gives 1 W / m2 per channel");
}

/// The keys of light type `Index`, which apply if that is what `light` holds.
template <std::size_t Index, class V>
void lightFields(V& v, Light& light) {
  std::variant_alternative_t<Index, Light> unused;
  auto* held = std::get_if<Index>(&light);
  v.applies(held != nullptr, "type \"" + std::string(kLightTypes[Index].first) + "\"");
  fields(v, held == nullptr ? unused : *held);
}

template <std::size_t Index = 0>
void emplaceLight(Light& light, std::size_t wanted) {
  if constexpr (Index < std::variant_size_v<Light>) {
    Index == wanted ? static_cast<void>(light.emplace<Index>()) : emplaceLight<Index + 1>(light, wanted);
  }
}

template <class V>
void fields(V& v, NamedLight& named) {
  v.text("name", named.name, "for messages and --set; unique among the lights");
  std::size_t type = named.light.index();
  if (!v.type(type, Names<std::size_t>(kLightTypes), "the kind of light")) {
    return;
  }
  if (type != named.light.index()) {
    emplaceLight(named.light, type);
  }
  [&]<std::size_t... Index>(std::index_sequence<Index...>) { (lightFields<Index>(v, named.light), ...); }
  (std::make_index_sequence<std::variant_size_v<Light>>());
  v.applies(!std::holds_alternative<PointLight>(named.light), "every type but \"point\"");
  v.flag("visible", named.visible, "seen directly by the camera");
  v.always();
}

template <class V>
void fields(V& v, Scene& scene) {
  v.text("name", scene.name, "a title; the file's name if left out");
  v.object("camera", scene.camera, "where the picture is taken from");
  v.object("film", scene.film, "what the picture is");
  v.object("render", scene.render, "how much work goes into it");
  v.list("media", scene.media, "what fills space");
  v.list("lights", scene.lights, "what shines from outside the media");
}

} // namespace tyndall::scene
