// SPDX-License-Identifier: Apache-2.0
// Vertices of a path are recorded as it goes; when it is over, what each direction has found is known, and they learn.
#ifndef TYNDALL_PATH_RECORDS_GLSL
#define TYNDALL_PATH_RECORDS_GLSL

#include "passes/path/direction.glsl"

// What the newest record waits for.
const uint kRecordClosed = 0u;
const uint kRecordLeaves = 1u;  // its own ray, the light sample coming first
const uint kRecordMeets = 2u;   // what its ray meets
const uint kRecordArrives = 3u; // a vertex that scatters into more than one direction; in screen space: any

// A direction is judged by what its ray has met, not by what the path went on to find.
const bool kScoreAtHit = kGuideCache || kGuideScreen;

uint recordPlace(GuidePtr guide) { return path.slot * guide.at[0].mostRecords + path.recordCount - 1u; }

bool recording(uint stage) { return kGuideLearn && path.recordStage == stage; }

// The state as it was drawn from. But for chains in screen space nothing writes while paths are under way, and those
// have other lobes' states at worst.
ChainState drawnState(GuidePtr guide, uint source) {
  if (kGuideScreen) {
    return guide.at[0].screen.at[source].state;
  }
  ChainState state = guide.at[0].states.at[source];
  if (kGuideMotion) {
    moveTarget(guide, state);
  }
  return state;
}

// What the chain that drew the direction needs.
void recordChain(GuidePtr guide, uint place, DirectionSample direction) {
  GuideRecordPtr records = guide.at[0].records;
  records.at[place].direction = direction.drawn.direction;
  records.at[place].meanWeight = mixture.weightSum / float(kLobes);
  for (int i = 0; i < 3; ++i) {
    records.at[place].mu[i] = mixture.chosen.mu[i];
  }
  records.at[place].kappa = mixture.chosen.kappa;
  records.at[place].cell = mixture.cell;
  records.at[place].source = direction.guided ? mixture.source : kNoState;
  ChainState state = kEmptyState;
  if (direction.guided) {
    state = drawnState(guide, mixture.source);
  }
  records.at[place].state = state;
}

// A vertex has drawn its direction. `throughput`: on arrival there.
void recordVertex(GuidePtr guide, ScatterPoint vertex, DirectionSample direction, vec3 throughput) {
  path.recordStage = kRecordClosed;
  if (path.recordCount >= guide.at[0].mostRecords || kGuideScreen && mixture.cell == kNoCell) {
    return;
  }
  ++path.recordCount;
  path.recordStage = kRecordLeaves;
  GuideRecordPtr records = guide.at[0].records;
  const uint place = recordPlace(guide);
  const vec3 point = vertex.place.position + guide.at[0].shift;
  // What the settings at hand never read is not written.
  records.at[place].point = point;
  records.at[place].normal = facingOf(vertex);
  records.at[place].target = point + guide.at[0].farDistance * direction.drawn.direction;
  records.at[place].velocity = vec3(0.0);
  records.at[place].throughput = throughput;
  records.at[place].left = path.radiance;
  records.at[place].scatterPart = direction.scatterPart;
  records.at[place].scatterPdf = direction.scatterPdf;
  if (kGuideCache) {
    records.at[place].arrived = path.radiance;
  }
  if (kScoreAtHit) {
    records.at[place].score = vec3(0.0);
  }
  if (kGuideFit) {
    records.at[place].source = direction.guided ? 0u : kNoState; // some state's lobe, or none's
  } else {
    recordChain(guide, place, direction);
  }
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
      const vec3 step = point - before;
      const bool jumped = dot(step, step) > guide.at[0].mostStep * guide.at[0].mostStep;
      guide.at[0].records.at[recordPlace(guide)].velocity = jumped ? vec3(0.0) : step / guide.at[0].frameTime;
    }
    path.recordStage = kRecordArrives;
  }
}

vec3 perThroughput(vec3 radiance, vec3 throughput) {
  return mix(vec3(0.0), radiance / throughput, greaterThan(throughput, vec3(0.0)));
}

// The first vertex beyond that the record waits for. Where the direction has found no light itself, what the cache knows
// of the vertex is the score.
void recordArrives(GuidePtr guide, ScatterPoint vertex, vec3 throughput, inout Rng rng) {
  if (!kScoreAtHit || !recording(kRecordArrives)) {
    return;
  }
  const uint place = recordPlace(guide);
  const vec3 before = guide.at[0].records.at[place].throughput;
  vec3 found = path.radiance - guide.at[0].records.at[place].left;
  if (kGuideCache && found == vec3(0.0)) {
    found = throughput * cachedRadiance(guide, vertex.place.position + guide.at[0].shift, facingOf(vertex), rng);
  }
  guide.at[0].records.at[place].score = perThroughput(found, before);
  path.recordStage = kRecordClosed;
}

// The path is over: its last ray may have found light after which no vertex came.
void recordEnds(GuidePtr guide) {
  if (kScoreAtHit && (recording(kRecordMeets) || recording(kRecordArrives))) {
    const uint place = recordPlace(guide);
    const vec3 found = path.radiance - guide.at[0].records.at[place].left;
    guide.at[0].records.at[place].score = perThroughput(found, guide.at[0].records.at[place].throughput);
  }
  path.recordStage = kRecordClosed;
}

void learnFromPath(GuidePtr guide, inout Rng rng) {
  recordEnds(guide);
  if (kGuideOrdered) {
    logFirst = path.slot * guide.at[0].logSize;
  }
  [[dont_unroll]] while (path.recordCount > 0u) {
    const GuideRecord record = guide.at[0].records.at[recordPlace(guide)];
    vec3 value = record.score;
    if (!kScoreAtHit) {
      value = perThroughput(path.radiance - record.left, record.throughput);
    }
    if (kGuideScreen) {
      learnOnScreen(guide, record, value, rng);
    } else {
      learn(guide, record, value, rng);
    }
    if (kGuideCache) {
      const vec3 lit = perThroughput(record.left - record.arrived, record.throughput);
      cacheRadiance(guide, record, value + lit, rng);
    }
    --path.recordCount;
  }
  if (kGuideOrdered) {
    guide.at[0].logCounts.at[path.slot] = logged;
  }
}

#endif
