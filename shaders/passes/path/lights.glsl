// SPDX-License-Identifier: Apache-2.0
// Light seen from a vertex: one light sample, and the density that light sampling has for what a direction finds.
#ifndef TYNDALL_PATH_LIGHTS_GLSL
#define TYNDALL_PATH_LIGHTS_GLSL

#include "light/emitter.glsl"
#include "light/lights.glsl"
#include "light/tree.glsl"
#include "passes/path/emission.glsl"
#include "passes/path/aim_density.glsl"
#include "passes/path/direction.glsl"
#include "passes/path/surface.glsl"

const bool kSampleLights = (kTechniques & kTechniqueLight) != 0u;
const bool kSampleDirections = (kTechniques & kTechniqueDirection) != 0u;

// Something that a direction can find.
const bool kFindable = kEmissiveSurfaces || kDistantAreas || kMediaEmission;

// Share of the direction technique in the balance heuristic; `light` and `direction` are the densities [1/sr] of the
// two for the same direction [Veach95].
float directionWeight(float direction, float light) {
  if (direction == 0.0 || light == 0.0 || !kSampleLights) {
    return 1.0; // light sampling cannot have drawn it
  }
  return kSampleDirections ? direction / (direction + light) : 0.0;
}

// The factor of a light sample's value f L: the balance heuristic's weight over the sample's density.
float lightFactor(float light, float direction) {
  if (kPlantedBug == kBugBranchPdf) {
    return 1.0 / light;
  }
  return 1.0 / (kSampleDirections ? light + direction : light);
}

// Where light is asked for. Without a normal every direction counts.
LightReceiver receiverOf(ScatterPoint vertex) {
  return LightReceiver(vertex.place.position, vertex.transmits ? vec3(0.0) : vertex.place.normal, false);
}

// Probability that light sampling at the path's last vertex chooses an emitter.
float emitterProbability(ScenePtr scene, uint emitter, PathVertex vertex) {
  if (emitter == kNoEmitter) {
    return 0.0;
  }
  const LightReceiver receiver = LightReceiver(vertex.point, vertex.normal, false);
  return scene.at[0].emitterShare * emitterChoicePdf(scene.at[0].emitters, emitter, receiver);
}

// What a light sample asks for: the transmittance along a ray, times `value`.
struct LightRequest {
  vec3 direction;      // unit
  SurfacePoint target; // a point of a light; error < 0: none, the ray goes on to infinity
  vec3 value;          // of the sample; 0: nothing to ask. First what shines alone, then the vertex's part of it too
  float pdf;           // density of light sampling [1/sr], or with `delta` the probability of the choice
  bool delta;
  uint medium;         // emissive medium whose line is gathered, or kNoMedium; `pdf` is then the probability of its choice
  float directionPdf;  // density of directionSample for that line
};

LightRequest noRequest() {
  return LightRequest(vec3(0.0, 0.0, 1.0), SurfacePoint(vec3(0.0), vec3(0.0), -1.0), vec3(0.0), 1.0, false, kNoMedium,
                      0.0);
}

// The point of its light that a sample has drawn, as a ray that hits it would find it.
SurfacePoint lightPoint(Emitter light, LightSample drawn) {
  if (light.kind == kEmitterTriangle) {
    const vec3 point = light.position + drawn.barycentric.x * light.edge1 + drawn.barycentric.y * light.edge2;
    return trianglePoint(light.position, light.position + light.edge1, light.position + light.edge2, point);
  }
  if (light.kind == kEmitterSphere) {
    return spherePoint(light.position, light.edge1.x, drawn.normal);
  }
  return SurfacePoint(light.position, vec3(0.0), 0.0);
}

LightRequest volumeRequest(ScenePtr scene, vec3 from, Emitter emitter, float choicePdf, inout Rng rng) {
  LightRequest request = noRequest();
  const vec3 offset = volumePoint(scene, emitter.index, emitter, rng) - from;
  const float distance = length(offset);
  if (distance > 0.0) {
    request.direction = offset / distance;
    request.medium = emitter.index;
    request.pdf = choicePdf;
    request.value = vec3(1.0);
  }
  return request;
}

// Points, spots and small spheres: light samples in homogeneous media need no help from directions (aim.glsl).
bool isSmall(ScenePtr scene, uint emitter) {
  EmitterPtr list = scene.at[0].emitters.at[0].emitters;
  return (list.at[emitter].flags & kEmitterSmall) != 0u;
}

// Radiance of a point of an emissive surface, by its texture, and by how much of it is there: a ray that comes upon it
// finds a hole with probability 1 - opacity.
vec3 shiningPart(ScenePtr scene, Emitter emitter, LightSample light) {
  SurfacesPtr surfaces = scene.at[0].surfaces;
  MaterialPtr materials = surfaces.at[0].materials;
  const bool triangle = emitter.kind == kEmitterTriangle;
  vec2 uv = vec2(0.0);
  if (kTextures && triangle) {
    uv = triangleUv(surfaces, emitter.index, light.barycentric);
  }
  uint material;
  if (triangle) {
    material = surfaces.at[0].triangles.at[emitter.index].material;
  } else {
    material = surfaces.at[0].spheres.at[emitter.index].material;
  }
  const float opacity = kPassing ? materialOpacity(materials, material, surfaces.at[0].textures, uv) : 1.0;
  return opacity * materialEmission(materials, material, surfaces.at[0].textures, uv);
}

// A sample of the surface of an emitter that has one, or of a point. `choicePdf` of the emitter.
LightRequest surfaceRequest(ScenePtr scene, vec3 from, uint index, float choicePdf, inout Rng rng) {
  EmittersPtr emitters = scene.at[0].emitters;
  EmitterPtr list = emitters.at[0].emitters;
  const Emitter emitter = list.at[index];
  LightRequest request = noRequest();
  const LightSample light = sampleEmitter(emitters, index, from, rng);
  if (!(light.pdf > 0.0) || light.radiance == vec3(0.0)) {
    return request;
  }
  request.value = light.radiance;
  if (kPlantedBug == kBugJacobian && light.delta) {
    request.value *= light.distance * light.distance;
  }
  if ((kTextures || kPassing) && (emitter.kind == kEmitterTriangle || emitter.kind == kEmitterSphere)) {
    request.value = shiningPart(scene, emitter, light);
  }
  request.direction = light.direction;
  request.target = lightPoint(emitter, light);
  request.pdf = choicePdf * light.pdf;
  request.delta = light.delta;
  return request;
}

LightRequest emitterRequest(ScenePtr scene, ScatterPoint vertex, float xi, inout Rng rng) {
  EmittersPtr emitters = scene.at[0].emitters;
  const EmitterChoice choice = chooseEmitter(emitters, receiverOf(vertex), xi, rng);
  const float choicePdf = choice.pdf * scene.at[0].emitterShare;
  EmitterPtr list = emitters.at[0].emitters;
  if (kVolumeEmitters && list.at[choice.emitter].kind == kEmitterVolume) {
    return volumeRequest(scene, vertex.place.position, list.at[choice.emitter], choicePdf, rng);
  }
  LightRequest request = surfaceRequest(scene, vertex.place.position, choice.emitter, choicePdf, rng);
  if (kAimed && vertex.flightT >= 0.0 && isSmall(scene, choice.emitter)) {
    request.delta = true;
    request.value *= flightShare(scene, vertex, choice.emitter, choicePdf);
  }
  return request;
}

LightRequest distantRequest(ScenePtr scene, float xi, inout Rng rng) {
  LightRequest request = noRequest();
  DistantLight light = scene.at[0].distant.at[selectDistantLight(scene, xi)];
  request.direction = distantDirection(light, rng);
  if (kDistantDeltas && light.kind == kDistantDelta) {
    request.value = light.radiance;
    request.pdf = light.selectPdf;
    request.delta = true;
  } else {
    const vec4 mixture = distantMixture(scene, request.direction);
    request.value = mixture.w > 0.0 ? mixture.xyz : vec3(0.0);
    request.pdf = mixture.w;
  }
  return request;
}

// One light sample. Selection probabilities of the lights at infinity sum to what emitters leave over.
LightRequest lightRequest(ScenePtr scene, ScatterPoint vertex, inout Rng rng) {
  LightRequest request = noRequest();
  const float xi = rngFloat(rng);
  const float share = scene.at[0].emitterShare;
  if (kEmitters && xi < share) {
    request = emitterRequest(scene, vertex, xi / share, rng);
  } else if (kDistantDeltas || kDistantAreas) {
    request = distantRequest(scene, xi - share, rng);
  }
  if (request.value == vec3(0.0) || (!kSampleLights && !request.delta)) {
    request.value = vec3(0.0);
    return request;
  }
  const vec4 scattered = directionEvalPdf(vertex, request.direction);
  request.value *= scattered.xyz;
  request.directionPdf = scattered.w;
  if (request.medium == kNoMedium) {
    request.value *= lightFactor(request.pdf, request.delta ? 0.0 : scattered.w);
  }
  return request;
}

#endif
