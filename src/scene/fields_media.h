// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/field_names.h"
#include "scene/fields_space.h"

#include <string>

/// The keys of media. See fields.h.
namespace tyndall::scene {

// Views of a medium: objects of the file whose values are members of Medium.
struct ShapeOf {
  Medium& medium;
};
struct EmissionOf {
  Emission& emission;
  bool homogeneous;
};

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
  v.flag("temperature_auto", emission.temperatureAuto,
         "where scale is 1 and offset 0, map a grid whose maximum is below 500 K to a maximum of 2000 K");
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
  v.transforms("instances", medium.instances,
               "copies, each a list of steps that follow the transform; none: one, as it is");
  v.triple("albedo", medium.albedo, kFraction, "scattered share of the extinction");
  v.triple("extinction_colour", medium.extinctionColour, kFraction, "factors of the extinction per channel");
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

} // namespace tyndall::scene
