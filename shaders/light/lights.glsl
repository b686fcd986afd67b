// SPDX-License-Identifier: Apache-2.0
// Light selection and the lights at infinity. A vertex takes one light by its selectPdf; lights at infinity that a
// direction can hit form one mixture, whose pdf and radiance are always evaluated in full.
#ifndef TYNDALL_LIGHT_LIGHTS_GLSL
#define TYNDALL_LIGHT_LIGHTS_GLSL

#include "core/numerics.glsl"
#include "core/rng.glsl"
#include "core/warp.glsl"
#include "interop/scene.h"
#include "light/environment.glsl"

const uint kAnyLight = 0xffffffffu;

// Radiance of a light at infinity seen along w; delta suns have none.
vec3 distantRadianceOf(DistantLight light, vec3 w) {
  if (light.kind == kDistantConstant) {
    return light.radiance;
  }
  if (light.kind == kDistantMap) {
    return environmentRadiance(light.map, w);
  }
  const bool inside = light.kind == kDistantDisc && insideCone(light.toLight, light.oneMinusCos, w);
  return inside ? light.radiance : vec3(0.0);
}

float distantPdfOf(DistantLight light, vec3 w) {
  if (light.kind == kDistantConstant) {
    return uniformSpherePdf();
  }
  if (light.kind == kDistantMap) {
    return environmentPdf(light.map, w);
  }
  const bool inside = light.kind == kDistantDisc && insideCone(light.toLight, light.oneMinusCos, w);
  return inside ? uniformConePdf(light.oneMinusCos) : 0.0;
}

// Radiance (xyz) and light-sampling pdf (w) of all lights at infinity together, along direction w.
vec4 distantMixture(ScenePtr scene, vec3 w) {
  vec4 result = vec4(0.0);
  [[dont_unroll]] for (uint i = 0u; i < scene.at[0].distantCount; ++i) {
    DistantLight light = scene.at[0].distant.at[i];
    result += vec4(distantRadianceOf(light, w), light.selectPdf * distantPdfOf(light, w));
  }
  return result;
}

// What the camera sees where nothing is in the way.
vec3 distantBackground(ScenePtr scene, vec3 w) {
  vec3 radiance = vec3(0.0);
  [[dont_unroll]] for (uint i = 0u; i < scene.at[0].distantCount; ++i) {
    DistantLight light = scene.at[0].distant.at[i];
    if (light.visible != 0u) {
      radiance += distantRadianceOf(light, w);
    }
  }
  return radiance;
}

// A direction towards a sun or a constant environment; xi uniform in [0, 1).
vec3 distantDirectionAt(DistantLight light, vec2 xi) {
  if (light.kind == kDistantDelta) {
    return light.toLight;
  }
  return light.kind == kDistantDisc ? uniformConeSample(light.toLight, light.oneMinusCos, xi) : uniformSphereSample(xi);
}

// A direction towards one light at infinity, by its own sampler.
vec3 distantDirection(DistantLight light, inout Rng rng) {
  if (light.kind == kDistantMap) {
    vec3 w;
    float pdf;
    environmentSample(light.map, rng, w, pdf);
    return w;
  }
  return distantDirectionAt(light, light.kind == kDistantDelta ? vec2(0.0) : rngFloat2(rng));
}

// Index of the light that `xi` in [0, 1) falls on; selectPdf sums to pointShare over point lights.
uint selectPointLight(ScenePtr scene, float xi) {
  uint light = 0u;
  [[dont_unroll]] while (light + 1u < scene.at[0].pointCount && xi >= scene.at[0].points.at[light].selectPdf) {
    xi -= scene.at[0].points.at[light].selectPdf;
    ++light;
  }
  return light;
}

uint selectDistantLight(ScenePtr scene, float xi) {
  uint light = 0u;
  [[dont_unroll]] while (light + 1u < scene.at[0].distantCount && xi >= scene.at[0].distant.at[light].selectPdf) {
    xi -= scene.at[0].distant.at[light].selectPdf;
    ++light;
  }
  return light;
}

#endif
