// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/field_names.h"

#include <algorithm>
#include <string>

/// The keys of lights. See fields.h.
namespace tyndall::scene {

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

template <class V>
void fields(V& v, SpotLight& light) {
  constexpr Range kHalfAngle{0.0, 90.0, "degrees", true};
  v.point("position", light.position, "scene units");
  v.direction("direction", light.direction, "the way the light travels, along the middle of the cone");
  v.triple("intensity", light.intensity, kLight, "W / sr");
  v.number("outer_angle", light.outerAngle, kHalfAngle, "from the middle to where the light ends");
  light.innerAngle = std::min(light.innerAngle, light.outerAngle); // the default of a narrow cone
  v.number("inner_angle", light.innerAngle, kHalfAngle, "from the middle to where it begins to fall off");
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
  const bool unseen = std::holds_alternative<PointLight>(named.light) || std::holds_alternative<SpotLight>(named.light);
  v.applies(!unseen, "every type but \"point\" and \"spot\"");
  v.flag("visible", named.visible, "seen directly by the camera");
  v.always();
}

} // namespace tyndall::scene
