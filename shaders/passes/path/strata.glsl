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

bool stratified() { return path.events <= kStratifiedEvents; }

// Set `which` of the newest event, or of the camera.
uvec3 strata(uint which) {
  return sobolNet(Sobol((io.firstSample + path.sampleIndex) % kSobolPoints, path.strataSeed), 2u * path.events + which);
}

#endif
