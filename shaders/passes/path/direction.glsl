// SPDX-License-Identifier: Apache-2.0
// The technique that draws a path's own directions: scattering's, or the mixture of those and of the chains' lobes.
#ifndef TYNDALL_PATH_DIRECTION_GLSL
#define TYNDALL_PATH_DIRECTION_GLSL

#include "guide/screen_chains.glsl"
#include "passes/path/scatter.glsl"

// What stands for a normal where states are looked up and kept. The picture's neighbours see smooth shapes, not facets.
vec3 facingOf(ScatterPoint vertex) {
  return !onSurface(vertex) ? -vertex.incoming : kGuideScreen ? vertex.frame[2] : vertex.place.normal;
}

// Where the vertex' cells are. In a frame's first round nothing has been learnt at the places that surfaces have come to:
// what the frame before has left lies where they were, and as wide as its camera saw them.
GridPlace gridPlace(GuidePtr guide, ScatterPoint vertex, vec3 point) {
  if (kGuidePrevious && io.firstSample == 0u) {
    return GridPlace(vertex.before + guide.at[0].shift, guide.at[0].cameraBefore, facingOf(vertex));
  }
  return GridPlace(point, guide.at[0].camera, facingOf(vertex));
}

// Loads what guides directions at a vertex that does not scatter by a delta.
void prepareDirection(GuidePtr guide, ScatterPoint vertex, inout Rng rng) {
  const vec3 point = vertex.place.position + guide.at[0].shift;
  const vec3 horizon = vertex.transmits ? vec3(0.0) : vertex.place.normal;
  if (!kGuideScreen) {
    loadMixture(guide, gridPlace(guide, vertex, point), point, horizon, rng);
    if (kGuideFit) {
      // Lobes that have misled a path so far are trusted less: weights grow with events, not by a factor at each.
      mixture.scatterShare = 1.0 - (1.0 - mixture.scatterShare) * min(path.unguided, 1.0);
    }
  } else if (path.events == 1u && onSurface(vertex)) {
    const vec3 before = vertex.before + guide.at[0].shift;
    loadScreenChains(guide, ScreenVertex(pixelInFlight(), point, before, facingOf(vertex)), horizon, rng);
  } else {
    clearMixture();
  }
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
  float scatterPdf;  // [1/sr]
  float scatterPart; // of the density: scattering's own
  float unguided;    // the weight that scattering's own density gives, over that of the mixture's
  bool guided;
};

DirectionSample directionSample(ScatterPoint vertex, inout Rng rng) {
  DirectionSample result;
  result.scatterPart = 1.0;
  result.unguided = 1.0;
  result.guided = kGuide && !scatterIsDelta(vertex) && rngFloat(rng) >= mixture.scatterShare;
  if (result.guided) {
    ++mixtureGuided;
    result.drawn.direction = vmfSample(mixture.chosen.mu, mixture.chosen.kappa, rngFloat2(rng));
  } else {
    result.drawn = scatterSample(vertex, rng);
  }
  result.scatterPdf = result.guided ? 0.0 : result.drawn.pdf;
  if (!kGuide || mixture.scatterShare >= 1.0 || result.drawn.pdf == 0.0 && !result.guided) {
    return result;
  }
  const vec4 scattered = scatterEvalPdf(vertex, result.drawn.direction);
  const float pdf = mixturePdf(scattered.w, result.drawn.direction);
  result.drawn.pdf = pdf;
  result.scatterPdf = scattered.w;
  result.drawn.weight = pdf > 0.0 ? scattered.xyz / pdf : vec3(0.0);
  result.unguided = scattered.w > 0.0 ? pdf / scattered.w : 1.0;
  result.scatterPart = pdf > 0.0 ? mixture.scatterShare * scattered.w / pdf : 0.0;
  return result;
}

#endif
