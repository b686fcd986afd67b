// SPDX-License-Identifier: Apache-2.0
// Pass `path`: paths of any length through media and between surfaces, a statistical batch per invocation.
//
// In, out, suspended states: as in pass `trace` (trace_io.h). The sums depend on pixel, seed and batch alone.
#ifndef TYNDALL_PATH_IO_H
#define TYNDALL_PATH_IO_H

#include "interop/guide.h"
#include "interop/guide_view.h"
#include "interop/pixel_sums.h"
#include "interop/planted_bugs.h"
#include "interop/scene.h"
#include "interop/walk.h"

// SPEC(type, name, id, default). A false flag removes the feature's code from the pipeline.
// clang-format off
#define TYNDALL_PATH_SPEC(SPEC)                                                               \
  SPEC(uint, kPhaseMask,        0, 0xffffffffu) /* bit = id of phase/list.h */                \
  SPEC(uint, kFormatMask,       1, 7u)          /* bit = kFormat* */                          \
  SPEC(bool, kHomogeneous,      2, true)        /* homogeneous media */                       \
  SPEC(bool, kGrids,            3, true)        /* grid media */                              \
  SPEC(bool, kGridEmission,     4, true)        /* emissive grids */                          \
  SPEC(bool, kHomogeneousEmission, 5, true)     /* emissive homogeneous media */              \
  SPEC(bool, kChromatic,        6, true)        /* extinction that differs by channel */      \
  SPEC(bool, kSurfaces,         7, true)                                                      \
  SPEC(uint, kMaterialMask,     8, 0xffffffffu) /* bit = id of material/list.h */             \
  SPEC(bool, kTextures,         9, true)                                                      \
  SPEC(bool, kSpheres,         10, true)                                                      \
  SPEC(bool, kInstances,       11, true)        /* of meshes */                               \
  SPEC(bool, kPassing,         12, true)        /* null or overruled boundaries, holes */     \
  SPEC(bool, kInteriors,       13, true)        /* objects filled with media or refracting */ \
  SPEC(bool, kEmitters,        14, true)        /* lights that have a place */                \
  SPEC(bool, kEmissiveSurfaces, 15, true)                                                     \
  SPEC(bool, kVolumeEmitters,  16, true)        /* emissive media sampled as lights */        \
  SPEC(bool, kDistantDeltas,   17, true)        /* suns without angular size */               \
  SPEC(bool, kDistantAreas,    18, true)        /* sun discs, environments */                 \
  SPEC(bool, kOrthographic,    19, false)                                                     \
  SPEC(bool, kLens,            20, true)                                                      \
  SPEC(bool, kBackground,      21, true)        /* a distant light is visible */              \
  SPEC(bool, kAovs,            22, false)       /* depth and albedo */                        \
  SPEC(bool, kCount,           23, true)        /* lookups and segments are counted */        \
  SPEC(uint, kLightSelection,  24, 0u)          /* kSelect* of light/tree.glsl */             \
  SPEC(uint, kTechniques,      25, 3u)          /* kTechnique* below */                       \
  SPEC(bool, kAimed,           28, true)        /* small lights in homogeneous media */       \
  SPEC(bool, kMediumTree,      27, false)       /* many grid media */                         \
  SPEC(bool, kGuide,           29, false)       /* chains guide directions */                 \
  SPEC(uint, kGuideLoads,      30, 2u)          /* cells loaded at a vertex */                \
  SPEC(uint, kGuideStates,     31, 4u)          /* of a cell */                               \
  SPEC(bool, kGuideStatic,     32, true)        /* a coarse grid beside the adaptive one */   \
  SPEC(bool, kGuideNormals,    33, false)       /* adaptive cells differ by normal */         \
  SPEC(bool, kGuideCache,      34, false)       /* scores from the radiance cache */          \
  SPEC(bool, kGuideShare,      35, true)        /* the share of scattering is learnt */       \
  SPEC(uint, kGuideWeight,     36, 0u)          /* kWeight* of interop/guide.h */             \
  SPEC(bool, kGuideMotion,     37, false)       /* targets move */                            \
  SPEC(bool, kGuideLearn,      38, true)        /* the store is written */                    \
  SPEC(bool, kGuideOrdered,    44, false)       /* each pixel has its own places in the log */ \
  SPEC(bool, kGuideFit,        45, false)       /* the states of a cell are fitted together */ \
  SPEC(bool, kGuideScreen,     39, false)       /* chains in screen space instead of cells */ \
  SPEC(bool, kGuidePrevious,   48, false)       /* cells are looked up where surfaces were */ \
  SPEC(bool, kGuideView,       46, false)       /* looks at the store, renders nothing */     \
  SPEC(bool, kGuideDistances,  47, false)       /* chains guide distances on camera rays */   \
  SPEC(uint, kPlantedBug,      26, 0u)          /* tests: kBug*; 0 = none */
// clang-format on

GPU_BEGIN

// How light is found from a vertex; with both, they are joined by multiple importance sampling.
GPU_CONST uint kTechniqueLight = 1;     // a shadow ray to a sampled light
GPU_CONST uint kTechniqueDirection = 2; // the path's own next direction

// What happened, added up over a dispatch.
struct PathCounters {
  uint suspended;        // entries of suspendedOut
  uint nonFinite;        // samples dropped because they were not finite
  uint majorantExceeded; // lookups above their majorant
  uint lookups;          // density lookups
  uint segments;         // rays: camera, bounce and shadow segments
  uint negative;         // samples with a negative component
  uint events;           // scattering events
  uint maxEvents;        // of one path
};
GPU_BUFFER(PathCounters)

GPU_CONST uint kTargetPath = 0xffffffffu;  // the path's own ray
GPU_CONST uint kTargetLight = 0xfffffffeu; // a shadow ray to a light

// A ray in flight, or one that waits.
struct PathRay {
  vec3 origin;           // centred world space
  vec3 direction;        // unit
  float tMax;
  uint interiors;        // bits of the interiors that the origin lies in
};

// What a cast has found.
struct PathHit {
  float t;               // of the surface; the ray's tMax if there is none
  uint primitive;        // or kNoHit
  uint instance;
  vec2 place;            // barycentric
};

// Where a path scattered last: what the probability of a light sample depends on.
struct PathVertex {
  vec3 point;
  vec3 normal;           // surfaces: geometric, on the side that the path came from; 0 0 0 in media
  float pdf;             // of the direction that was drawn there [1/sr]; 0: no light sample could have drawn it
  float travelled;       // from the vertex to the ray's origin: null boundaries do not end a line
  uint aimed;            // 1: small emitters are left to light samples (aim.glsl)
};

// Everything that a suspended pixel needs to go on.
struct PathState {
  uint slot;             // index into the dispatch's pixels and sums
  uint sampleIndex;      // within the batch
  uint stage;            // kStage*: what follows the running walk
  uint casting;          // 1: the ray is to be cast against the surfaces first
  uvec4 rng;
  PathRay ray;           // in flight: the path's own, or a shadow ray
  PathRay next;          // the path's own, while shadow rays are in flight; stage Aimed: the shadow ray
  PathVertex vertex;     // that the path's own ray comes from
  vec3 throughput;       // of the path up to its ray's origin
  float unguided;        // ... that it would have, had scattering drawn its directions, over it
  vec3 ratio;            // per channel: the path's pdf with that channel as hero, over their mean
  vec3 pending;          // what the shadow ray's transmittance multiplies
  uint hero;
  uint events;           // scattering events so far
  uint strataSeed;       // of the batch's stratified sets (strata.glsl)
  uint flightWord;       // number for the next flight of the path's own ray,
  uint flightFresh;      // ... 1: not used yet
  uint emissive;         // which emissive medium is collected along the ray
  uint target;           // what the ray in flight is for: kTarget*, or the emissive medium that it was drawn for
  float targetPdf;       // probability of choosing that medium
  float shadowPdf;       // shadow ray to a medium: density of the direction technique along it
  float travelled;       // shadow ray: from the vertex to its origin
  vec3 glow;             // radiance of a point of the ray, transmittance of grids left out
  float glowT;           // its distance from the vertex; < 0: none
  float glowInversePdf;
  float glowMeasure;     // of the whole line
  PathHit hit;           // of the ray in flight
  PathHit nextHit;       // of `next`, if it has been cast
  uint nextCast;         // 1: it has been
  uint recordCount;      // vertices that have been recorded (records.glsl)
  uint recordStage;      // kRecord*: what the newest one waits for
  float aim;             // where on the path's ray an emitter is chosen to aim at; < 0: nowhere
  float distanceShare;   // probability that chains drew the camera ray's distance; < 0: the ray asks none (distance.glsl)
  float guidedT;         // ... which they have drawn; < 0: they have not
  uint distanceLearns;   // 1: the ray has a record
  float collisionT;      // of the nearest collision in a homogeneous medium
  uint collisionMedium;
  vec3 radiance;         // of this sample
  vec3 background;
  float transmittance;
  float depth;           // weighted by opacity
  float opacity;
  vec3 albedo;           // weighted by opacity
  Walk walk;
  PixelSums sums;
};
GPU_BUFFER(PathState)

// Push constants.
struct PathInputs {
  GPU_PTR(Scene) scene;
  GPU_PTR(uint) pixels;            // x | y << 16, absolute in the image
  GPU_PTR(PixelSums) sums;
  GPU_PTR(PathState) suspendedIn;
  GPU_PTR(PathState) suspendedOut;
  GPU_PTR(PathCounters) counters;
  GPU_PTR(Guide) guide;            // kGuide
  GPU_PTR(GuideView) views;        // kGuideView: of each pixel's last sample
  uint count;                      // pixels, or suspended states when resuming
  uint firstSample;                // index of the batch's first sample within the pixel
  uint sampleCount;                // samples of this batch to take
  uint seed;
  uint stepBound;                  // cells and collisions per invocation and dispatch
  uint stageCost;                  // steps that a stage counts for
  uint resume;                     // 1: go on with suspendedIn
};

GPU_END
#endif
