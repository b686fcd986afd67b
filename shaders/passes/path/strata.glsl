// SPDX-License-Identifier: Apache-2.0
// The first numbers of a path come from stratified sets: the 16 samples of a batch spread over the pixel, the flights,
// the lights and the places on them, the directions. Numbers of one sample stay independent of each other and each is
// uniform, so that means do not change; docs/theory.md, (101).
//
//   camera    (place in the pixel, flight), (place on the lens, hero channel)
//   event     (choice of the light, place on it), (direction, flight)
#ifndef TYNDALL_PATH_STRATA_GLSL
#define TYNDALL_PATH_STRATA_GLSL

#include "core/sobol.glsl"

// Events whose numbers are stratified: what those beyond gain is less than what the numbers cost.
const uint kStratifiedEvents = 1u;

// Whether chains learn while paths are under way: a sample may read what the one before has written.
bool learnsAtOnce() { return kGuide && kGuideLearn && (kGuideScreen || kDistances); }

// Of the nets that the samples from `sampleIndex` on share. Who has met a point of a net knows something of its others, so
// that samples which read what earlier ones have taught have nets of their own: those of a round, or each.
uint strataSeed(uvec2 pixel, uint sampleIndex, uint seed) {
  const uint kApart = 0x40000000u; // from the nets of batches
  if (!kGuide || !kGuideLearn) {
    return sobolBegin(pixel, sampleIndex, seed).seed;
  }
  return sobolBegin(pixel, kSobolPoints * (learnsAtOnce() ? sampleIndex : io.firstSample), seed ^ kApart).seed;
}

bool stratified() { return path.events <= kStratifiedEvents; }

// Set `which` of the newest event, or of the camera.
uvec3 strata(uint which) {
  return sobolNet(Sobol((io.firstSample + path.sampleIndex) % kSobolPoints, path.strataSeed), 2u * path.events + which);
}

#endif
