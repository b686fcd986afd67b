// SPDX-License-Identifier: Apache-2.0
// Vertices of a path are recorded as it goes; when it is over, what each direction has found is known, and they learn.
#ifndef TYNDALL_PATH_RECORDS_GLSL
#define TYNDALL_PATH_RECORDS_GLSL

#include "guide/learn.glsl"
#include "passes/path/direction.glsl"

// What the newest record waits for.
const uint kRecordClosed = 0u;
const uint kRecordLeaves = 1u;  // its own ray, the light sample coming first
const uint kRecordMeets = 2u;   // what its ray meets
const uint kRecordArrives = 3u; // a vertex that scatters into more than one direction

uint recordPlace(GuidePtr guide) { return path.slot * guide.at[0].mostRecords + path.recordCount - 1u; }

bool recording(uint stage) { return kGuideLearn && path.recordStage == stage; }

// A vertex has drawn its direction. `throughput`: on arrival there.
void recordVertex(GuidePtr guide, ScatterPoint vertex, DirectionSample direction, vec3 throughput) {
  path.recordStage = kRecordClosed;
  if (path.recordCount >= guide.at[0].mostRecords) {
    return;
  }
  ++path.recordCount;
  path.recordStage = kRecordLeaves;
  GuideRecord record;
  record.point = vertex.place.position + guide.at[0].shift;
  record.normal = onSurface(vertex) ? vertex.place.normal : -vertex.incoming;
  record.direction = direction.drawn.direction;
  record.target = record.point + guide.at[0].farDistance * direction.drawn.direction;
  record.velocity = vec3(0.0);
  record.throughput = throughput;
  record.arrived = path.radiance;
  record.left = path.radiance;
  record.score = vec3(0.0);
  record.scatterPart = direction.scatterPart;
  record.meanWeight = mixture.weightSum / float(kLobes);
  for (int i = 0; i < 3; ++i) {
    record.mu[i] = mixture.chosen.mu[i];
  }
  record.kappa = mixture.chosen.kappa;
  record.cell = mixture.cell;
  record.source = direction.guided ? mixture.source : kNoState;
  record.state = kEmptyState;
  if (direction.guided) {
    record.state = mixture.state;
  }
  guide.at[0].records.at[recordPlace(guide)] = record;
}

// The path's own ray leaves: what is added from now on comes from its direction.
void recordLeaves(GuidePtr guide) {
  if (recording(kRecordLeaves)) {
    guide.at[0].records.at[recordPlace(guide)].left = path.radiance;
    path.recordStage = kRecordMeets;
  }
}

// The ray has met something that is no null boundary; `before`: where that was in the previous frame.
void recordMeets(GuidePtr guide, vec3 point, vec3 before) {
  if (recording(kRecordMeets)) {
    guide.at[0].records.at[recordPlace(guide)].target = point + guide.at[0].shift;
    if (kGuideMotion) {
      guide.at[0].records.at[recordPlace(guide)].velocity = (point - before) / guide.at[0].frameTime;
    }
    path.recordStage = kRecordArrives;
  }
}

vec3 perThroughput(vec3 radiance, vec3 throughput) {
  return mix(vec3(0.0), radiance / throughput, greaterThan(throughput, vec3(0.0)));
}

// The first vertex beyond that scatters into more than one direction: what the cache knows of it is the score, unless the
// direction has found light itself.
void recordArrives(GuidePtr guide, ScatterPoint vertex, vec3 throughput, inout Rng rng) {
  if (!kGuideCache || !recording(kRecordArrives)) {
    return;
  }
  const uint place = recordPlace(guide);
  const vec3 before = guide.at[0].records.at[place].throughput;
  vec3 found = path.radiance - guide.at[0].records.at[place].left;
  if (found == vec3(0.0)) {
    const vec3 facing = onSurface(vertex) ? vertex.place.normal : -vertex.incoming;
    found = throughput * cachedRadiance(guide, vertex.place.position + guide.at[0].shift, facing, rng);
  }
  guide.at[0].records.at[place].score = perThroughput(found, before);
  path.recordStage = kRecordClosed;
}

// The path is over: its last ray may have found light after which no vertex came.
void recordEnds(GuidePtr guide) {
  if (kGuideCache && (recording(kRecordMeets) || recording(kRecordArrives))) {
    const uint place = recordPlace(guide);
    const vec3 found = path.radiance - guide.at[0].records.at[place].left;
    guide.at[0].records.at[place].score = perThroughput(found, guide.at[0].records.at[place].throughput);
  }
  path.recordStage = kRecordClosed;
}

void learnFromPath(GuidePtr guide, inout Rng rng) {
  recordEnds(guide);
  [[dont_unroll]] while (path.recordCount > 0u) {
    const GuideRecord record = guide.at[0].records.at[recordPlace(guide)];
    vec3 value = record.score;
    if (!kGuideCache) {
      value = perThroughput(path.radiance - record.left, record.throughput);
    }
    learn(guide, record, value, rng);
    if (kGuideCache) {
      const vec3 lit = perThroughput(record.left - record.arrived, record.throughput);
      cacheRadiance(guide, record, value + lit, rng);
    }
    --path.recordCount;
  }
}

#endif
