// SPDX-License-Identifier: Apache-2.0
// Single scattering along one camera ray without drawing distances: (10) to (13) of docs/theory.md.
//
// The ray is walked piece by piece (pieces.glsl). Transmittance along it is in closed form. Each piece takes one
// position per beam, all at the same offset u of the piece, and reads the beam's light cache there. A few
// positions of the whole ray are kept by reservoir, and their exact walks to the light correct what the caches got wrong.
#ifndef TYNDALL_MARCH_RAY_GLSL
#define TYNDALL_MARCH_RAY_GLSL

#include "light/cache.glsl"
#include "medium/emission.glsl"
#include "passes/march/pieces.glsl"

// Added to the cache's transmittance where a position is kept: it may be 0 where the truth is not.
const float kKeepFloor = 0.02;
const float kKeepFloorSky = 0.05; // coarser caches
// Russian roulette on the camera ray's transmittance: below this and each 64th of it, one in 4 goes on.
const float kFirstRoulette = 1.0 / 1024.0;
const float kOpaque = 1e-12;        // transmittance that counts as 0
const float kOpaqueDepth = 32.0;    // towards lights

struct MarchResult {
  vec3 scattered;      // and emitted
  float transmittance;
  float depth;         // weighted by opacity
  float opacity;
  vec3 albedo;         // weighted by opacity
  uint cells;
  uint steps;
  uint corrections;
  bool cut;
};

// A position that a correction is taken at.
struct Kept {
  float weight;
  float t;
  uint beam;
  float cached;        // transmittance of the grids that the march took for true
  vec3 contribution;   // of the position for a transmittance of 1
};

const uint kKeptArray = kCorrections > 0u ? kCorrections : 1u;

// Of the ray that is being marched: positions kept independently of each other, and the weights of all that were seen.
Kept kept[kKeptArray];
float weightSum;

float mediumSigmaT(uint m, Piece piece, float f) {
  if (m < kHomogeneousMedia) {
    return homogeneousActive(m, piece) ? media[m].sigmaT : 0.0;
  }
  return hasDensity(m) ? media[m].sigmaT * cubicAt(slotCubics[slotOf(media[m].densityGrid)], f) : 0.0;
}

// sigma_s times the phase function, summed over the media, for light that arrives from `w`.
vec3 scatteringTowards(Piece piece, float f, vec3 w) {
  vec3 sum = vec3(0.0);
  [[unroll]] for (uint m = 0u; m < kMedia; ++m) {
    sum += media[m].albedo * (mediumSigmaT(m, piece, f) * evalPhase(media[m].phase, rayDirection, w));
  }
  return sum;
}

// Optical depth of the grids between the ray at t and the light of beam b, from the caches.
float cachedDepth(uint b, float t, vec3 toLight, float distance) {
  float tau = 0.0;
  [[unroll]] for (uint s = 0u; s < kSlots; ++s) {
    const uint i = b * kSlots + s;
    if (beamCached[i]) {
      if (slotWalks[s].tEnter <= t && t <= slotWalks[s].tLeave) {
        tau += lightCacheDepth(beamCaches[i], slotWalks[s].origin + t * slotWalks[s].direction);
      } else if (kSlots > 1u || kHomogeneousMedia > 0u) {
        tau += lightDepthFrom(slotGrids[s], beamCaches[i], rayOrigin + t * rayDirection, toLight, distance);
      }
    }
  }
  return tau;
}

// The same by walking.
float exactDepth(vec3 point, vec3 toLight, float distance, inout MarchResult result) {
  float tau = 0.0;
  [[unroll]] for (uint m = kHomogeneousMedia; m < kMedia; ++m) {
    if (hasDensity(m) && tau < kOpaqueDepth) {
      tau += cellOpticalDepth(slotGrids[slotOf(media[m].densityGrid)], media[m].sigmaT, point, toLight,
                              vec2(0.0, distance), kOpaqueDepth, result.cells);
    }
  }
  return tau;
}

// One beam at its position of the piece [t0, t0 + share * (t1 - t0)], offset u. `throughput` is that of t0.
void takeBeam(uint skyGroup, Piece piece, vec4 extinction, float share, float u, float throughput,
              uint b, inout MarchResult result, inout Rng rng) {
  const Beam beam = beams[b];
  if (beam.strength == vec3(0.0)) {
    return;
  }
  const float length = piece.t1 - piece.t0;
  float f = share * u;
  float inversePdf = share * length;
  vec3 toLight = beam.place;
  float distance = kInfiniteDistance;
  vec3 irradiance = beam.strength;
  if (kPointLights && beam.point) {
    const Equiangular e = equiangularMake(rayOrigin + piece.t0 * rayDirection, rayDirection, beam.place, 0.0, inversePdf);
    const float s = equiangularSample(e, u);
    const float pdf = equiangularPdf(e, s);
    f = length > 0.0 ? min(s / length, 1.0) : 0.0;
    inversePdf = pdf > 0.0 ? 1.0 / pdf : 0.0;
    toLight = beam.place - (rayOrigin + (piece.t0 + s) * rayDirection);
    distance = sqrt(dot(toLight, toLight));
    if (distance == 0.0) {
      return; // a set of measure zero
    }
    toLight /= distance;
    irradiance = kPlantedBug == kBugJacobian ? irradiance : irradiance / distance / distance;
  }
  const float t = piece.t0 + f * length;
  vec3 contribution = scatteringTowards(piece, f, toLight) * irradiance *
                      (throughput * exp(-length * cubicIntegral(extinction, f)) * inversePdf);
  if (kHomogeneousMedia > 0u) {
    contribution *= homogeneousTransmittance(rayOrigin + t * rayDirection, toLight, distance);
  }
  if (kSlots == 0u) {
    result.scattered += contribution;
    return;
  }
  const float cached = exp(-cachedDepth(b, t, toLight, distance));
  result.scattered += contribution * cached;
  if (kCorrections > 0u) {
    const bool sky = isSky(skyGroup, beam);
    const float weight = max(contribution.x, max(contribution.y, contribution.z)) * (cached + (sky ? kKeepFloorSky : kKeepFloor));
    weightSum += weight;
    [[unroll]] for (uint k = 0u; k < kCorrections; ++k) {
      if (rngFloat(rng) * weightSum < weight) {
        kept[k] = Kept(weight, t, b, cached, contribution);
      }
    }
  }
}

vec3 pieceEmission(vec3Ptr blackbody, Piece piece, float f) {
  vec3 sum = vec3(0.0);
  [[unroll]] for (uint m = 0u; m < kMedia; ++m) {
    if (media[m].emissionKind == kEmissionNone) {
      continue;
    }
    if (m < kHomogeneousMedia) {
      sum += homogeneousActive(m, piece) ? media[m].emission : vec3(0.0);
    } else if (kGridEmission && slotFilled(slotOf(media[m].emissionGrid), piece)) {
      const vec4 k = slotCubics[slotOf(media[m].emissionGrid)];
      const float value = k.x + f * (k.y + f * (k.z + f * k.w)); // may be negative: degrees
      sum += emissionOf(media[m], blackbody, value, mediumSigmaT(m, piece, f));
    }
  }
  return sum;
}

// What a piece gives whatever the lights: emission, and the layers beside the picture.
void takePiece(vec3Ptr blackbody, Piece piece, vec4 extinction, float share, float u, float throughput, inout MarchResult result) {
  const float length = piece.t1 - piece.t0;
  const float f = share * u;
  const float weight = throughput * share * length * exp(-length * cubicIntegral(extinction, f));
  if (kHomogeneousMedia > 0u || kGridEmission) {
    result.scattered += weight * pieceEmission(blackbody, piece, f);
  }
  if (kAovs) {
    [[unroll]] for (uint m = 0u; m < kMedia; ++m) {
      const float opacity = weight * mediumSigmaT(m, piece, f);
      result.opacity += opacity;
      result.depth += opacity * (piece.t0 + f * length);
      result.albedo += opacity * media[m].albedo;
    }
  }
}

// Adds a share 1 / kCorrections of the correction at a position that was kept in proportion to its weight.
void correct(Kept kept, inout MarchResult result) {
  const vec3 point = rayOrigin + kept.t * rayDirection;
  Beam beam = beams[0];
  [[unroll]] for (uint b = 1u; b < kBeams; ++b) {
    if (kept.beam == b) {
      beam = beams[b];
    }
  }
  vec3 toLight = beam.place;
  float distance = kInfiniteDistance;
  if (kPointLights && beam.point) {
    toLight = beam.place - point;
    distance = sqrt(dot(toLight, toLight));
    toLight /= max(distance, 1e-30);
  }
  const float exact = exp(-exactDepth(point, toLight, distance, result));
  const float cached = kPlantedBug == kBugOtherCache ? kept.cached * 0.99 : kept.cached;
  result.scattered += kept.contribution * ((exact - cached) * (weightSum / (kept.weight * float(kCorrections))));
  ++result.corrections;
}

// Marches one ray. `direction` is unit; `offset` is u.
MarchResult marchRay(ScenePtr scene, MarchScenePtr march, vec3 origin, vec3 direction, Sobol sobol, inout Rng rng) {
  MarchResult result = MarchResult(vec3(0.0), 1.0, 0.0, 0.0, vec3(0.0), 0u, 0u, 0u, false);
  weightSum = 0.0;
  [[unroll]] for (uint k = 0u; k < kCorrections; ++k) {
    kept[k] = Kept(0.0, 0.0, 0u, 0.0, vec3(0.0));
  }
  const vec2 stretch = beginRay(origin, direction);
  if (stretch.x >= stretch.y) {
    return result;
  }
  makeBeams(scene, march, rayOrigin, rayDirection, stretch, sobol, rng);
  const float base = dot(rayOrigin - origin, direction);
  const float u = sobolFloat(sobol, kDimOffset);
  const vec4 extent = vec4(march.at[0].centre, march.at[0].radius);
  vec3Ptr blackbody = scene.at[0].blackbody;
  const uint maxSteps = march.at[0].maxSteps;
  const uint skyGroup = march.at[0].skyGroup;
  float roulette = 1.0;  // 1 / probability of still being shaded
  float next = kFirstRoulette;
  float t = stretch.x;
  [[dont_unroll]] while (t < stretch.y && result.transmittance > kOpaque) {
    if (++result.steps > maxSteps) {
      result.cut = true;
      break;
    }
    Piece piece = nextPiece(extent, t);
    if (piece.t1 >= kInfiniteDistance) {
      break;
    }
    if (piece.media) {
      const vec4 extinction = pieceExtinction(piece, result.cells);
      const float length = piece.t1 - piece.t0;
      // Dense cells are taken in parts; the walk does not step before the last one.
      float share = 1.0;
      [[dont_unroll]] while (length * cubicIntegral(extinction, share) > kPieceDepth && piece.t0 + 0.5 * share * length > piece.t0) {
        share *= 0.5;
      }
      if (roulette > 0.0) {
        const float throughput = result.transmittance * roulette;
        takePiece(blackbody, piece, extinction, share, u, throughput, result);
        [[unroll]] for (uint b = 0u; b < kBeams; ++b) {
          takeBeam(skyGroup, piece, extinction, share, u, throughput, b, result, rng);
        }
      }
      result.transmittance *= exp(-length * cubicIntegral(extinction, share));
      if (result.transmittance < next) {
        next *= 1.0 / 64.0;
        roulette = rngFloat(rng) < 0.25 ? 4.0 * roulette : 0.0;
      }
      if (share < 1.0) {
        t = piece.t0 + share * length;
        continue;
      }
    }
    leavePiece(piece);
    t = piece.t1;
  }
  result.depth += base * result.opacity;
  [[dont_unroll]] for (uint k = 0u; k < kCorrections && kSlots > 0u && weightSum > 0.0; ++k) {
    Kept chosen = kept[0]; // selected, not indexed: an array with a computed index would lie in memory
    [[unroll]] for (uint j = 1u; j < kCorrections; ++j) {
      if (j == k) {
        chosen = kept[j];
      }
    }
    if (chosen.weight > 0.0) { // denormal weights may keep nothing
      correct(chosen, result);
    }
  }
  return result;
}

#endif
