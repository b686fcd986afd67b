// SPDX-License-Identifier: Apache-2.0
// Random numbers: one stream per (pixel, sample index, seed), whatever the dispatch that draws it.
#ifndef TYNDALL_CORE_RNG_GLSL
#define TYNDALL_CORE_RNG_GLSL

struct Rng {
  uvec4 state;  // of xoshiro128++, never all zero
  uvec3 queue;  // words that are drawn first,
  uint queued;  // ... as many of them; 0 where nobody queues any
};

/// pcg4d, a bijection of 128 bits. [Jarzynski20] "Hash Functions for GPU Rendering", JCGT 9(3), listing of pcg4d.
uvec4 pcg4d(uvec4 v) {
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  v ^= v >> 16u;
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  return v;
}

/// The stream of one sample. Twice the hash: neighbouring inputs leave a visible pattern in the first words after
/// one. A bijection, so that distinct arguments give distinct states.
Rng rngSeed(uvec2 pixel, uint sampleIndex, uint seed) {
  Rng rng;
  rng.queued = 0u;
  rng.state = pcg4d(pcg4d(uvec4(pixel, sampleIndex, seed)));
  if (rng.state == uvec4(0u)) {
    rng.state.x = 1u; // the one state that xoshiro cannot leave
  }
  return rng;
}

uint rotateLeft(uint x, uint count) { return (x << count) | (x >> (32u - count)); }

/// What the next draws give, in place of the stream's own numbers; each must be uniform over all 32-bit values. Whoever
/// queues empties the queue when what it was for is over.
void rngQueue(inout Rng rng, uvec3 words, uint count) {
  rng.queue = words;
  rng.queued = count;
}

/// Uniform over all 32-bit values. xoshiro128++ 1.0, [Blackman21] "Scrambled Linear Pseudorandom Number Generators".
uint rngUint(inout Rng rng) {
  const uint result = rotateLeft(rng.state.x + rng.state.w, 7u) + rng.state.x;
  const uint t = rng.state.y << 9u;
  rng.state.z ^= rng.state.x;
  rng.state.w ^= rng.state.y;
  rng.state.y ^= rng.state.z;
  rng.state.x ^= rng.state.w;
  rng.state.z ^= t;
  rng.state.w = rotateLeft(rng.state.w, 11u);
  return result;
}

/// A word as a number in (0, 1), never 0 nor 1. Keeps all 32 bits near 0: a thin medium's collisions are drawn there,
/// and with 24-bit numbers P(xi < 1e-8) would be 6e-8.
float unitFloat(uint word) {
  return min((float(word) + 0.5) * 2.3283064365387e-10, 0.99999994); // 2^-32, 1 - 2^-24
}

/// Uniform in (0, 1).
float rngFloat(inout Rng rng) {
  if (rng.queued > 0u) {
    const uint word = rng.queue.x;
    rng.queue = rng.queue.yzx;
    --rng.queued;
    return unitFloat(word);
  }
  return unitFloat(rngUint(rng));
}

vec2 rngFloat2(inout Rng rng) {
  const float first = rngFloat(rng);
  return vec2(first, rngFloat(rng));
}

vec3 rngFloat3(inout Rng rng) {
  const vec2 first = rngFloat2(rng);
  return vec3(first, rngFloat(rng));
}

#endif
