// SPDX-License-Identifier: Apache-2.0
// The lights of one camera ray. A "beam" is a light whose direction (at infinity) or position is fixed for the whole
// ray, so that all cells of the ray share its cache and nothing is drawn in a cell: suns, one direction towards each
// sun disc, one direction for all environments together, the strongest point lights, and one of the other point lights.
#ifndef TYNDALL_MARCH_BEAMS_GLSL
#define TYNDALL_MARCH_BEAMS_GLSL

#include "core/equiangular.glsl"
#include "light/lights.glsl"
#include "passes/march/sky.glsl"

struct Beam {
  bool point;
  vec3 place;     // unit direction to the light, or its position
  vec3 strength;  // what reaches an unshadowed point [W/m2], 1 / pdf included; point: times r^2 [W/sr]
  uint group;     // its caches, see MarchScene::cacheOf; kNoCache: none
};

const uint kBeamArray = kBeams > 0u ? kBeams : 1u;

Beam beams[kBeamArray];
LightCache beamCaches[kBeamArray * kSlotArray]; // [beam * kSlots + slot], where beamCached
bool beamCached[kBeamArray * kSlotArray];
uint beamCount;

void clearBeams() {
  [[unroll]] for (uint b = 0u; b < kBeams; ++b) {
    beams[b] = Beam(false, vec3(0.0), vec3(0.0), kNoCache);
  }
  beamCount = 0u;
}

void addBeam(Beam beam) {
  [[unroll]] for (uint b = 0u; b < kBeams; ++b) {
    if (b == beamCount) {
      beams[b] = beam;
    }
  }
  ++beamCount;
}

// One beam per sun, by its own sampler, and one for the environments.
void addDistantBeams(ScenePtr scene, MarchScenePtr march, vec3 d, Sobol sobol, inout Rng rng) {
  bool sky = false;
  [[dont_unroll]] for (uint i = 0u; i < scene.at[0].distantCount; ++i) {
    DistantLight light = scene.at[0].distant.at[i];
    if (isEnvironment(light)) {
      sky = true;
      continue;
    }
    Beam beam = Beam(false, light.toLight, light.radiance, march.at[0].distantGroup + i);
    if (kDistantAreas && light.kind == kDistantDisc) {
      beam.place = distantDirectionAt(light, vec2(sobolFloat(sobol, kDimDisc), sobolFloat(sobol, kDimDisc + 1u)));
      beam.strength /= distantPdfOf(light, light.toLight);
    }
    addBeam(beam);
  }
  if (kSky && sky) {
    const SkySample drawn = skySample(scene, march, d, sobol, rng);
    addBeam(Beam(false, drawn.direction, drawn.strength, march.at[0].skyGroup + drawn.index));
  }
}

// How much of a point light's intensity the ray's stretch in the media sees: the integral of 1 / r^2 over it.
float rayShare(PointLight light, vec3 origin, vec3 direction, vec2 stretch) {
  const Equiangular e = equiangularMake(origin, direction, light.position, stretch.x, stretch.y);
  return dot(light.intensity, vec3(1.0)) * e.theta / e.distance;
}

void addPointBeams(ScenePtr scene, MarchScenePtr march, vec3 origin, vec3 direction, vec2 stretch, inout Rng rng) {
  const uint fixedCount = march.at[0].pointBeams;
  [[dont_unroll]] for (uint i = 0u; i < fixedCount; ++i) {
    addBeam(Beam(true, scene.at[0].points.at[i].position, scene.at[0].points.at[i].intensity, i));
  }
  float sum = 0.0;
  float kept = 0.0;
  uint drawn = fixedCount;
  [[dont_unroll]] for (uint i = fixedCount; i < scene.at[0].pointCount; ++i) {
    const float share = rayShare(scene.at[0].points.at[i], origin, direction, stretch);
    sum += share;
    if (rngFloat(rng) * sum < share) {
      drawn = i;
      kept = share;
    }
  }
  if (kept > 0.0) {
    addBeam(Beam(true, scene.at[0].points.at[drawn].position, scene.at[0].points.at[drawn].intensity * (sum / kept), kNoCache));
  }
}

bool isSky(uint skyGroup, Beam beam) { return kSky && beam.group != kNoCache && beam.group >= skyGroup; }

void loadCaches(MarchScenePtr march) {
  [[unroll]] for (uint b = 0u; b < kBeams; ++b) {
    [[unroll]] for (uint s = 0u; s < kSlots; ++s) {
      const uint i = b * kSlots + s;
      const uint index = beams[b].group == kNoCache ? kNoCache : march.at[0].cacheOf.at[beams[b].group * kSlots + s];
      beamCached[i] = index != kNoCache;
      if (beamCached[i]) {
        LightCachePtr caches = march.at[0].caches;
        if (isSky(march.at[0].skyGroup, beams[b])) {
          caches = march.at[0].skyCaches;
        }
        beamCaches[i] = caches.at[index];
      }
    }
  }
}

// `stretch` is where the ray may meet media.
void makeBeams(ScenePtr scene, MarchScenePtr march, vec3 origin, vec3 direction, vec2 stretch, Sobol sobol, inout Rng rng) {
  clearBeams();
  if (kDistantLights) {
    addDistantBeams(scene, march, direction, sobol, rng);
  }
  if (kPointLights) {
    addPointBeams(scene, march, origin, direction, stretch, rng);
  }
  loadCaches(march);
}

#endif
