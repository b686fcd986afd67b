// SPDX-License-Identifier: Apache-2.0
// The technique that draws a path's own directions: scattering's, or the mixture of those and of the chains' lobes.
#ifndef TYNDALL_PATH_DIRECTION_GLSL
#define TYNDALL_PATH_DIRECTION_GLSL

#include "guide/mixture.glsl"
#include "passes/path/scatter.glsl"

// Loads what guides directions at a vertex that does not scatter by a delta.
void prepareDirection(GuidePtr guide, ScatterPoint vertex, inout Rng rng) {
  const vec3 point = vertex.place.position + guide.at[0].shift;
  const vec3 facing = onSurface(vertex) ? vertex.place.normal : -vertex.incoming;
  loadMixture(guide, point, vertex.transmits ? vec3(0.0) : vertex.place.normal, facing, rng);
}

// Value of scattering (x, y, z) and density of directionSample (w) [1/sr]; 0 for deltas.
vec4 directionEvalPdf(ScatterPoint vertex, vec3 w) {
  vec4 scattered = scatterEvalPdf(vertex, w);
  if (kGuide && !scatterIsDelta(vertex) && kPlantedBug != kBugLightByScatter) {
    scattered.w = mixturePdf(scattered.w, w);
  }
  return scattered;
}

struct DirectionSample {
  ScatterSample drawn;
  float scatterPart; // of the density: scattering's own
  bool guided;
};

DirectionSample directionSample(ScatterPoint vertex, inout Rng rng) {
  DirectionSample result;
  result.scatterPart = 1.0;
  result.guided = kGuide && !scatterIsDelta(vertex) && rngFloat(rng) >= mixture.scatterShare;
  if (result.guided) {
    ++mixtureGuided;
    result.drawn.direction = vmfSample(mixture.chosen.mu, mixture.chosen.kappa, rngFloat2(rng));
  } else {
    result.drawn = scatterSample(vertex, rng);
  }
  if (!kGuide || mixture.scatterShare >= 1.0 || result.drawn.pdf == 0.0 && !result.guided) {
    return result;
  }
  const vec4 scattered = scatterEvalPdf(vertex, result.drawn.direction);
  const float pdf = mixturePdf(scattered.w, result.drawn.direction);
  result.drawn.pdf = pdf;
  result.drawn.weight = pdf > 0.0 ? scattered.xyz / pdf : vec3(0.0);
  result.scatterPart = pdf > 0.0 ? mixture.scatterShare * scattered.w / pdf : 0.0;
  return result;
}

#endif
