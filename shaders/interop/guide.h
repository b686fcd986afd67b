// SPDX-License-Identifier: Apache-2.0
// Markov chain path guiding on the device: one store of chain states for surfaces and media. Positions are in the
// store's space, which stays while frames come with centres of their own.
#ifndef TYNDALL_INTEROP_GUIDE_H
#define TYNDALL_INTEROP_GUIDE_H

#include "interop/basic.h"
#include "interop/guide_distance.h"

GPU_BEGIN

GPU_CONST uint kMostLobes = 16;      // of a mixture: loads times states of a cell
GPU_CONST uint kNoCell = 0xffffffffu;
GPU_CONST uint kNoState = 0xffffffffu;
GPU_CONST uint kMostChainCount = 1024;

// What a state's weight is, and what takes it away again.
GPU_CONST uint kWeightAccepted = 0;  // mean score of accepted samples; misses do nothing
GPU_CONST uint kWeightForgets = 1;   // ... where a trusted sample misses, it is lost [Alber25]
GPU_CONST uint kWeightMean = 2;      // mean score of all samples that the lobe drew
GPU_CONST float kLeastChainWeight = 1e-30f; // below it a state is empty

// A Markov chain: a lobe that aims at a place where light comes from. All zero: empty.
struct ChainState {
  vec3 target;         // mean of the places that were hit, weighted by their scores
  float weight;        // mean score: of accepted samples, or of all that its lobe drew; in a fitted cell its part of the
                       // cell's mean score; 0: empty
  float spread;        // mean of 1 - cos about the mean direction, weighted likewise, [0, 2]
  float evidence;      // number of accepted samples, or sum of its parts in those of the cell: what target and spread
                       // rest on
  float time;          // of the last update [s]
  uint velocityXY;     // of the target, two halves [units/s]
  uint velocityZCount; // low half: z; high half: number of samples, or in a fitted cell its runs of misses
};
GPU_BUFFER(ChainState)

// A vertex of a hash grid, with kGuideStates states at its index times that.
struct GuideCell {
  uint fingerprint;    // of the vertex, never 0; 0: free
  uint stamp;          // round of the last write
  float scatterGain;   // root of the sum of squared scores that scattering's own directions account for
  float guideGain;     // ... and that the lobes do
  float scatterWeight; // where states are fitted: part of the mean score that scattering's own directions explain
  uint samples;        // that the gains, and fitted states, are made of
};
GPU_BUFFER(GuideCell)

// Outgoing radiance at a vertex of the cache's grid: for scores alone, never in a picture.
struct RadianceCell {
  uint fingerprint;
  uint stamp;
  uint count;
  vec3 radiance;       // mean; surfaces: all of it, media: before the albedo [W/(m2 sr)]
};
GPU_BUFFER(RadianceCell)

// What a pixel of the picture keeps of the vertex that it sees first: chains in screen space. All zero: nothing.
struct ScreenChain {
  ChainState state;
  vec3 point;          // of the vertex
  vec3 normal;         // ... on the camera's side, unit
  float score;         // of the sample that made the state what it is; 0: the state is not read
  uint round;          // of that sample
};
GPU_BUFFER(ScreenChain)

// How cells' widths grow with the distance from the camera.
struct GuideLevels {
  float angle;         // width of a cell per distance
  float finest;        // width on level 0 [units]
  float ratioLog;      // logarithm of the widths' ratio from level to level
  float spread;        // a vertex k levels coarser is taken with probability ~ 2^(-spread k); 0: never
};

// A vertex of a path in flight, until its score is known.
struct GuideRecord {
  vec3 point;
  vec3 normal;         // on the path's side; media: against the way it came
  vec3 direction;      // that was drawn
  vec3 target;         // the first thing that it met
  vec3 velocity;       // of the target [units/s]
  vec3 throughput;     // on arrival at the vertex
  vec3 arrived;        // radiance of the sample on arrival
  vec3 left;           // ... and when the path's own ray left, the vertex' light sample being in
  vec3 score;          // of the cache: what the direction found, over its density
  float scatterPart;   // of the density: by scattering's own directions, [0, 1]
  float scatterPdf;    // of scattering's own directions [1/sr]
  float meanWeight;    // of the loaded states, empty ones counted
  float mu[3];         // of the chosen lobe
  float kappa;
  uint cell;           // whose share is learnt, or kNoCell; in screen space: the pixel's chain
  uint source;         // the state that drew the direction (fitted cells: any), or kNoState
  ChainState state;    // its copy; empty if scattering drew the direction
};
GPU_BUFFER(GuideRecord)

// Writes to the store, in the order in which a log carries them out: what a state's lobe drew comes before the state is
// replaced.
GPU_CONST uint kUpdateSample = 0;   // a sample that a state's lobe drew
GPU_CONST uint kUpdateMiss = 1;     // ... that takes weight away
GPU_CONST uint kUpdateShare = 2;    // gains of a cell
GPU_CONST uint kUpdateChain = 3;    // a state for a vertex
GPU_CONST uint kUpdateRadiance = 4; // a sample of the cache
GPU_CONST uint kUpdateFit = 5;      // a sample for a cell whose states are fitted together
GPU_CONST uint kUpdateKinds = 6;

// One of them as a value. It touches cells of one window only.
struct GuideUpdate {
  uint kind;           // kUpdate*
  uint place;          // Sample, Miss: the state; Share: the cell; Chain, Radiance, Fit: first cell of the window
  uint fingerprint;    // Chain, Radiance, Fit: of the vertex; Sample, Miss: bits of the weight that drew
  vec3 point;          // Sample, Fit: where the direction was drawn
  ChainState state;    // Sample: its target and velocity, weight = score, evidence = 1 if accepted; Miss: weight = score;
                       // Share: weight, spread = gains; Radiance: target = sample; Fit: as Sample, but weight = 0 if
                       // it has found nothing, spread = scattering's part of the density, time = scattering's own
                       // density, evidence = a random number, count = 1 if a lobe drew it
};
GPU_BUFFER(GuideUpdate)

// What guiding did, added up over a dispatch.
struct GuideCounters {
  uint vertices;       // that loaded states
  uint states;         // loaded that were not empty
  uint guided;         // directions that lobes drew
  uint accepted;       // samples that became states, or that fitted cells took in
  uint forgotten;      // states that lost weight
  uint evicted;        // cells that another vertex took over
  uint unsound;        // scores that were not finite
  uint distanceRays;   // camera rays that found distance chains
  uint distanceGuided; // ... whose distance they drew
};
GPU_BUFFER(GuideCounters)

// What the guided passes read and write. Lengths in scene units; docs/guiding.md says what each is for.
struct Guide {
  GPU_PTR(GuideCell) cells;
  GPU_PTR(ChainState) states;
  GPU_PTR(RadianceCell) radiance;
  GPU_PTR(ScreenChain) screen;    // kGuideScreen: row by row, from the top
  GPU_PTR(GuideRecord) records;   // mostRecords for each pixel of a dispatch
  GPU_PTR(GuideCounters) counters;
  GPU_PTR(GuideUpdate) log;       // of writes to the store, which the pass guide_apply carries out
  GPU_PTR(uint) logCounts;        // kGuideOrdered: of those of each pixel; else of all together, more than fit counted
  GuideDistances distance;        // kGuideDistances
  vec3 camera;         // where cells are finest
  vec3 cameraBefore;   // ... in the frame before
  vec3 shift;          // from centred world space to the store's
  GuideLevels levels;
  GuideLevels radianceLevels;
  mat4x3 rasterBefore; // from the store's space: where the frame before saw a point, x and y of the picture in [0, 1]
                       // times z, which is positive before the camera
  uvec2 screenSize;    // of the picture [pixels]
  float screenDepth;   // difference in distance from the camera at which a state counts for 1/e
  uint frameRound;     // the frame's first; states of earlier ones lie where the frame before saw their vertex
  float staticWidth;
  float adaptiveShare; // of the loads, where there is a static grid
  uint cellCount;      // adaptive cells come first, a multiple of `window`
  uint staticCount;    // likewise
  uint radianceCount;
  uint window;         // cells that a vertex may be in
  float priorArea;     // a lobe of one sample covers about its root on the light [units^2]
  float priorLeast;    // ... but is never narrower than this 1 - cos
  float mostKappa;     // of states with few samples ...
  float kappaGrowth;   // ... times the number of samples to this power
  float scatterShare;  // of directions that scattering draws, until it is learnt
  float leastShare;    // bounds of what is learnt
  float mostShare;
  uint shareSamples;   // before it counts
  float leastRate;     // of a chain's means
  float newbornShare;  // of a fitted cell's weight that stands for what no state explains
  uint fitSamples;     // of a fitted cell before it is read
  float forgetBelow;   // a miss is a score below this part of the state's weight
  float forgetRate;    // of the weight that a miss takes away, (0, 1]
  float radianceLimit; // a sample of the cache or of a fitted cell counts for at most this many times the mean
  float time;          // of the frame [s]
  float frameTime;     // since the frame before [s]
  float mostTime;      // a target is moved ahead for at most this long [s]
  float mostStep;      // what moves further from frame to frame has jumped: that foretells nothing
  float farDistance;   // where targets at infinity stand
  uint round;          // of learning, counted on
  uint mostRecords;    // vertices of a path that learn
  uint logSize;        // places in the log; kGuideOrdered: of each pixel
};
GPU_BUFFER(Guide)

GPU_END
#endif
