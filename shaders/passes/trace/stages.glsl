// SPDX-License-Identifier: Apache-2.0
// Single scattering along a camera ray as a chain of stages; between two stages lies a walk through the grid media.
// Each distance technique ("vertex") in turn:
//   vertex 0              a collision in the grid media, from the camera walk itself
//   vertex 1 + 2h, 2 + 2h homogeneous medium h: free flight conditioned on a collision, and equiangular about a point
//                         light; balance heuristic between the two [Veach95; Kulla12]
//   the rest              a point on the ray in each emissive grid
// and at each vertex one light sample and, where lights have an extent, one phase sample, joined by the balance
// heuristic. Equation (1) of docs/theory.md is their sum.
#ifndef TYNDALL_TRACE_STAGES_GLSL
#define TYNDALL_TRACE_STAGES_GLSL

#include "core/equiangular.glsl"
#include "light/lights.glsl"
#include "medium/grid_emission.glsl"
#include "phase/planted.glsl"
#include "tracker/walk.glsl"

const uint kStageSample = 0u;    // begin a sample
const uint kStageCamera = 1u;    // the camera ray has been walked
const uint kStageVertex = 2u;    // make the next vertex
const uint kStageEmission = 3u;  // a point in an emissive grid has been chosen
const uint kStageTransmit = 4u;  // the camera ray has been walked up to the vertex
const uint kStageShade = 5u;     // take a light sample at the vertex
const uint kStageLight = 6u;     // the segment to the light has been walked
const uint kStageDirection = 7u; // the segment along the phase sample has been walked
const uint kStageDone = 8u;

// A walk that is over at once: nothing lies between this stage and the next one.
const uint kNoWalk = 0xfffffffeu;
void noWalk(inout TraceState path) { path.walk.medium = kNoWalk; }

void walkSegment(inout TraceState path, ScenePtr scene, vec3 origin, vec3 direction, float tMax, uint mode) {
  path.walk = walkBegin(origin, direction, tMax, mode, scene.at[0].homogeneousCount);
}

float homogeneousTransmittance(ScenePtr scene, vec3 origin, vec3 direction, float tMax) {
  return kHomogeneous ? exp(-homogeneousDepth(scene, origin, direction, tMax)) : 1.0;
}

void stageSample(inout TraceState path, ScenePtr scene, uvec2 pixel, uint seed, uint sampleIndex, inout Rng rng) {
  rng = rngSeed(pixel, sampleIndex, seed);
  const vec2 raster = (vec2(pixel) + rngFloat2(rng)) / vec2(scene.at[0].imageSize);
  Camera camera = scene.at[0].camera;
  const vec3 offset = raster.x * camera.rasterX + raster.y * camera.rasterY;
  path.cameraOrigin = kOrthographic ? camera.origin + offset : camera.origin;
  path.cameraDirection = normalize(kOrthographic ? camera.corner : camera.corner + offset);
  path.vertex = 0u;
  path.radiance = vec3(0.0);
  path.background = vec3(0.0);
  path.transmittance = 1.0;
  path.depth = 0.0;
  path.opacity = 0.0;
  path.albedo = vec3(0.0);
  walkSegment(path, scene, path.cameraOrigin, path.cameraDirection, kInfiniteDistance, kWalkCollide);
  path.stage = kStageCamera;
}

void recordVertex(inout TraceState path, ScenePtr scene) {
  if (kAovs) {
    path.opacity += path.vertexThroughput;
    path.depth += path.vertexThroughput * path.vertexT;
    path.albedo += path.vertexThroughput * scene.at[0].media.at[path.vertexMedium].albedo;
  }
}

void stageCamera(inout TraceState path, ScenePtr scene) {
  const vec3 o = path.cameraOrigin;
  const vec3 d = path.cameraDirection;
  const bool hit = kGrids && path.walk.tHit >= 0.0;
  const float gridTransmittance = kWeighted ? path.walk.transmittance : (hit ? 0.0 : 1.0);
  path.transmittance = gridTransmittance * homogeneousTransmittance(scene, o, d, kInfiniteDistance);
  if (kBackground && path.transmittance > 0.0) {
    path.background = path.transmittance * distantBackground(scene, d);
  }
  path.stage = kStageVertex;
  if (hit) {
    path.vertexT = path.walk.tHit;
    path.vertexMedium = path.walk.hitMedium;
    path.vertexThroughput =
        (kWeighted ? path.walk.weightSum : 1.0) * homogeneousTransmittance(scene, o, d, path.vertexT);
    path.vertexPdf = 0.0;
    path.vertexLight = kAnyLight;
    recordVertex(path, scene);
    path.stage = kStageShade;
  }
  noWalk(path);
}

// Free flight in homogeneous medium h, conditioned on a collision inside it: (7) of docs/theory.md.
void freeFlightVertex(inout TraceState path, Medium medium, vec2 interval, ScenePtr scene, inout Rng rng) {
  const float length = interval.y - interval.x;
  const float collided = oneMinusExp(medium.sigmaT * length);
  const float xi = rngFloat(rng);
  const float s = medium.sigmaT > 0.0 ? min(opticalDepthAt(xi * collided) / medium.sigmaT, length) : xi * length;
  path.vertexT = interval.x + s;
  // Transmittance through this medium cancels with the pdf; what is left is that of the others.
  const float ownDepth = medium.sigmaT * s;
  // Their depth is summed without this medium's: the difference would be noise where this one is opaque.
  const float others =
      exp(-homogeneousDepthWithout(scene, path.vertexMedium, path.cameraOrigin, path.cameraDirection, path.vertexT));
  path.vertexThroughput = collided * others;
  path.vertexPdf = collided > 0.0 ? medium.sigmaT * exp(-ownDepth) / collided : 0.0;
  path.vertexLight = kAnyLight;
  if (medium.emissionKind != kEmissionNone) {
    path.vertexEmission = medium.emission * (others * (medium.sigmaT > 0.0 ? collided / medium.sigmaT : length));
  }
}

void equiangularVertex(inout TraceState path, Medium medium, vec2 interval, ScenePtr scene, inout Rng rng) {
  const float xi = rngFloat(rng);
  float below = 0.0;
  uint light = 0u;
  [[dont_unroll]] for (; light + 1u < scene.at[0].pointCount; ++light) {
    below += scene.at[0].points.at[light].equiangularPdf;
    if (xi < below) {
      break;
    }
  }
  const Equiangular e = equiangularMake(path.cameraOrigin, path.cameraDirection, scene.at[0].points.at[light].position,
                                        interval.x, interval.y);
  path.vertexT = equiangularSample(e, rngFloat(rng));
  const float pdf = equiangularPdf(e, path.vertexT);
  const float depth = homogeneousDepth(scene, path.cameraOrigin, path.cameraDirection, path.vertexT);
  path.vertexThroughput = pdf > 0.0 ? medium.sigmaT * exp(-depth) / pdf : 0.0;
  const float ownDepth = medium.sigmaT * (path.vertexT - interval.x);
  path.vertexPdf = medium.sigmaT * exp(-ownDepth) / oneMinusExp(medium.sigmaT * (interval.y - interval.x));
  path.vertexLight = light;
}

void homogeneousVertex(inout TraceState path, ScenePtr scene, uint technique, inout Rng rng) {
  path.vertexMedium = technique >> 1;
  const Medium medium = scene.at[0].media.at[path.vertexMedium];
  const vec2 interval = mediumInterval(medium, path.cameraOrigin, path.cameraDirection, kInfiniteDistance);
  const bool equiangular = (technique & 1u) != 0u;
  if (interval.x >= interval.y || (equiangular && (!kPointLights || medium.sigmaT == 0.0))) {
    return;
  }
  if (equiangular) {
    equiangularVertex(path, medium, interval, scene, rng);
  } else {
    freeFlightVertex(path, medium, interval, scene, rng);
  }
  if (path.vertexThroughput > 0.0 || path.vertexEmission != vec3(0.0)) {
    walkSegment(path, scene, path.cameraOrigin, path.cameraDirection, path.vertexT, kWalkTransmit);
    path.stage = kStageTransmit;
  }
}

// Leaves the stage at kStageVertex where a technique has nothing to give on this ray.
void stageVertex(inout TraceState path, ScenePtr scene, inout Rng rng) {
  const uint technique = path.vertex;
  ++path.vertex;
  path.vertexThroughput = 0.0;
  path.vertexEmission = vec3(0.0);
  noWalk(path);
  const uint homogeneousTechniques = 2u * scene.at[0].homogeneousCount;
  if (kHomogeneous && technique < homogeneousTechniques) {
    homogeneousVertex(path, scene, technique, rng);
  } else if (kGridEmission && technique - homogeneousTechniques < scene.at[0].emissiveCount) {
    path.vertexMedium = scene.at[0].emissive.at[technique - homogeneousTechniques];
    path.walk = walkBegin(path.cameraOrigin, path.cameraDirection, kInfiniteDistance, kWalkEmit, path.vertexMedium);
    path.stage = kStageEmission;
  } else {
    path.stage = kStageDone;
  }
}

void stageEmission(inout TraceState path, ScenePtr scene, inout Rng rng) {
  path.stage = kStageVertex;
  const float tHit = path.walk.tHit;
  const float inversePdf = path.walk.weightSum / path.walk.tau; // tau holds the chosen cell's maximum
  noWalk(path);
  if (tHit < 0.0) {
    return;
  }
  path.vertexT = tHit;
  const vec3 j = gridEmission(scene, path.vertexMedium, path.cameraOrigin + tHit * path.cameraDirection, rng);
  path.vertexEmission =
      j * (inversePdf * homogeneousTransmittance(scene, path.cameraOrigin, path.cameraDirection, tHit));
  if (path.vertexEmission != vec3(0.0)) {
    walkSegment(path, scene, path.cameraOrigin, path.cameraDirection, tHit, kWalkTransmit);
    path.stage = kStageTransmit;
  }
}

void stageTransmit(inout TraceState path, ScenePtr scene) {
  path.radiance += path.vertexEmission * path.walk.transmittance;
  path.vertexThroughput *= path.walk.transmittance;
  if (path.vertexLight == kAnyLight && path.vertexThroughput > 0.0) {
    recordVertex(path, scene);
  }
  path.stage = path.vertexThroughput > 0.0 ? kStageShade : kStageVertex;
  noWalk(path);
}

// MIS weight of the distance technique at a homogeneous vertex for a point light, balance heuristic.
float distanceWeight(TraceState path, ScenePtr scene, Medium medium, PointLight light) {
  if (path.vertexPdf == 0.0) {
    return 1.0; // a grid collision: no other technique makes it
  }
  const vec2 interval = mediumInterval(medium, path.cameraOrigin, path.cameraDirection, kInfiniteDistance);
  const Equiangular e =
      equiangularMake(path.cameraOrigin, path.cameraDirection, light.position, interval.x, interval.y);
  const float freeFlight = light.selectPdf * path.vertexPdf;
  const float equiangular = light.equiangularPdf * equiangularPdf(e, path.vertexT);
  return (path.vertexLight == kAnyLight ? freeFlight : equiangular) / (freeFlight + equiangular);
}

void shadePoint(inout TraceState path, ScenePtr scene, Medium medium, vec3 vertex, uint index) {
  const PointLight light = scene.at[0].points.at[index];
  const vec3 toLight = light.position - vertex;
  const float distance = length(toLight);
  const float selectPdf = path.vertexLight == kAnyLight ? light.selectPdf : light.equiangularPdf;
  if (distance == 0.0) {
    return; // a set of measure zero
  }
  const vec3 w = toLight / distance;
  const float weight = distanceWeight(path, scene, medium, light) * evalPhase(medium.phase, path.cameraDirection, w);
  // Divided by the distance twice: its square over- and underflows first.
  const vec3 irradiance = kPlantedBug == kBugJacobian ? light.intensity : light.intensity / distance / distance;
  path.pending = medium.albedo * irradiance *
                 (path.vertexThroughput * weight / selectPdf * homogeneousTransmittance(scene, vertex, w, distance));
  walkSegment(path, scene, vertex, w, distance, kWalkTransmit);
}

void shadeDistant(inout TraceState path, ScenePtr scene, Medium medium, vec3 vertex, uint index, inout Rng rng) {
  DistantLight light = scene.at[0].distant.at[index];
  const vec3 w = distantDirection(light, rng);
  const float phase = evalPhase(medium.phase, path.cameraDirection, w);
  vec3 estimate;
  if (kDistantDeltas && light.kind == kDistantDelta) {
    estimate = light.radiance * (phase / light.selectPdf);
  } else {
    const vec4 mixture = distantMixture(scene, w);
    const float pdf = kPlantedBug == kBugBranchPdf ? light.selectPdf * distantPdfOf(light, w) : mixture.w + phase;
    estimate = pdf == 0.0 ? vec3(0.0) : mixture.xyz * (phase / pdf);
  }
  path.pending = medium.albedo * estimate *
                 (path.vertexThroughput * homogeneousTransmittance(scene, vertex, w, kInfiniteDistance));
  walkSegment(path, scene, vertex, w, kInfiniteDistance, kWalkTransmit);
}

void skipDarkSegment(inout TraceState path) {
  if (path.pending == vec3(0.0)) {
    noWalk(path);
  }
}

void stageShade(inout TraceState path, ScenePtr scene, inout Rng rng) {
  const vec3 vertex = path.cameraOrigin + path.vertexT * path.cameraDirection;
  const Medium medium = scene.at[0].media.at[path.vertexMedium];
  path.pending = vec3(0.0);
  path.stage = kStageLight;
  noWalk(path);
  const bool chosen = path.vertexLight != kAnyLight;
  const float xi = chosen ? 0.0 : rngFloat(rng);
  if (kPointLights && (chosen || xi < scene.at[0].pointShare)) {
    shadePoint(path, scene, medium, vertex, chosen ? path.vertexLight : selectPointLight(scene, xi));
  } else if ((kDistantDeltas || kDistantAreas) && scene.at[0].distantCount > 0u) {
    shadeDistant(path, scene, medium, vertex, selectDistantLight(scene, xi - scene.at[0].pointShare), rng);
  }
  skipDarkSegment(path);
}

void stageLight(inout TraceState path, ScenePtr scene, inout Rng rng) {
  path.radiance += path.pending == vec3(0.0) ? vec3(0.0) : path.pending * path.walk.transmittance;
  path.stage = kStageVertex;
  noWalk(path);
  if (!kDistantAreas || path.vertexLight != kAnyLight) {
    return;
  }
  const vec3 vertex = path.cameraOrigin + path.vertexT * path.cameraDirection;
  const Medium medium = scene.at[0].media.at[path.vertexMedium];
  const vec3 w = phaseSample(medium.phase, path.cameraDirection, rng);
  const vec4 mixture = distantMixture(scene, w);
  const float phase = evalPhase(medium.phase, path.cameraDirection, w);
  // Sampled by the phase function: its value and its pdf cancel.
  const float weight = phase == 0.0 ? 0.0 : phase / (phase + mixture.w);
  path.pending = medium.albedo * mixture.xyz *
                 (weight * path.vertexThroughput * homogeneousTransmittance(scene, vertex, w, kInfiniteDistance));
  walkSegment(path, scene, vertex, w, kInfiniteDistance, kWalkTransmit);
  path.stage = kStageDirection;
  skipDarkSegment(path);
}

void stageDirection(inout TraceState path) {
  path.radiance += path.pending == vec3(0.0) ? vec3(0.0) : path.pending * path.walk.transmittance;
  path.stage = kStageVertex;
  noWalk(path);
}

#endif
