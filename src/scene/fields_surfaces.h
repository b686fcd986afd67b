// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/field_names.h"
#include "scene/fields_space.h"

#include <string>

/// The keys of materials and objects. See fields.h.
namespace tyndall::scene {

/// What a material is made of unless told otherwise: glass tints nothing.
inline glm::dvec3 defaultColour(MaterialId model) {
  return model == MaterialId::Dielectric ? glm::dvec3(1.0) : geometry::Material{}.colour;
}

template <class V>
void fields(V& v, geometry::Material& material) {
  v.required().text("name", material.name, "by which objects name it; unique among the materials");
  MaterialId model = material.model;
  if (!v.type(model, Names<MaterialId>(kMaterialTypes), "how the surface scatters light")) {
    return;
  }
  if (model != material.model) {
    material.model = model;
    material.colour = defaultColour(model);
  }
  const bool conductor = model == MaterialId::Conductor;
  const bool dielectric = model == MaterialId::Dielectric;
  const bool metalRough = model == MaterialId::MetalRough;
  v.applies(model != MaterialId::Null, "every type but \"null\"");
  v.triple("colour", material.colour, kFraction,
           "share of the light that is scattered; dielectric: that is let through");
  v.number("opacity", material.opacity, kFraction, "share of the light that meets the surface at all");
  v.triple("emission", material.emission, kLight, "radiance, W / (m2 sr)");
  v.flag("two_sided", material.twoSided, "emit on both sides");
  v.applies(conductor || dielectric || metalRough, "type \"conductor\", \"dielectric\" or \"metal_rough\"");
  v.number("roughness", material.roughness, kFraction, "perceptual; 0 is a mirror or clear glass");
  v.applies(metalRough, "type \"metal_rough\"");
  v.number("metallic", material.metallic, kFraction, "0 is a coated solid, 1 a metal");
  v.applies(dielectric || metalRough, "type \"dielectric\" or \"metal_rough\"");
  v.number("ior", material.ior, kIor, "index of refraction; 1 bends nothing");
  v.applies(conductor, "type \"conductor\"");
  v.triple("eta", material.eta, kMetal, "index of refraction, used where k is not 0");
  v.triple("k", material.k, kMetal, "extinction coefficient; 0: the colour is the reflectance, by Schlick's formula");
  v.always();
  material.alpha = material.opacity < 1.0 ? geometry::Alpha::Blend : geometry::Alpha::Opaque;
}

template <class V>
void fields(V& v, Object& object) {
  v.text("name", object.name, "for messages and --set; unique among the objects");
  if (!v.type(object.kind, Names<Object::Kind>(kObjectTypes), "its geometry")) {
    return;
  }
  v.transform("transform", object.worldFromObject, "steps from object space to the world, the first one applied first");
  v.transforms("instances", object.instances,
               "copies, each a list of steps that follow the transform; none: one, as it is");
  v.text("material", object.material, "a material's name; \"\" for the file's own, or white");
  v.text("medium", object.medium, "name of the medium inside; \"\" for none");
  v.whole("priority", object.priority, WholeRange{0, 1000}, "where refracting objects overlap, the highest decides");
  v.applies(object.kind == Object::Kind::Mesh, "type \"mesh\"");
  v.required().file("file", object.file, ".gltf, .glb, .obj or .ply, relative to the scene file's folder");
  v.flag("lights", object.lights, "take the file's own lights too");
  v.applies(object.kind == Object::Kind::Quad, "type \"quad\"");
  v.point("origin", object.origin, "a corner, object space");
  v.point("edge_u", object.edgeU, "from the corner along one side");
  v.point("edge_v", object.edgeV, "from the corner along the other; the front is the side of edge_u x edge_v");
  v.applies(object.kind == Object::Kind::Box, "type \"box\"");
  fields(v, object.box);
  v.applies(object.kind == Object::Kind::Sphere, "type \"sphere\"");
  v.point("centre", object.centre, "of the sphere, object space");
  v.number("radius", object.radius, kPositiveLength, "of the sphere, object space");
  v.always();
}

} // namespace tyndall::scene
