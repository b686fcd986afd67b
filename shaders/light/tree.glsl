// SPDX-License-Identifier: Apache-2.0
// The choice of one emitter among many: a walk down a tree of boxes, at each node by what its two children should
// send to the receiver. [Conty18] "Importance sampling of many lights with adaptive tree splitting"; theory.md, (40)
// to (42). The includer declares the specialization constant kLightSelection before it (kSelect* of
// interop/emitters.h), and GL_EXT_control_flow_attributes.
#ifndef TYNDALL_LIGHT_TREE_GLSL
#define TYNDALL_LIGHT_TREE_GLSL

#include "core/numerics.glsl"
#include "core/rng.glsl"
#include "interop/emitters.h"

/// Where light is asked for.
struct LightReceiver {
  vec3 point;    // centred world space
  vec3 normal;   // unit; 0 0 0: in a medium. Nothing may be reflected that comes from below it, unless two-sided
  bool twoSided; // light from below the normal counts too (transmission)
};

struct EmitterChoice {
  uint emitter;  // index into Emitters::emitters
  float pdf;     // probability of the choice, > 0
};

// Angles are (cos, sin) pairs. A cosine bound that is smaller than this counts as this much, and a child is left out
// only where the bound is below its negative: roundings are some 1e-6.
const float kLightTreeSlack = 1e-3;
// The least share of a child that may shine on the receiver: bounds are no promise of what arrives.
const float kLightTreeLeastShare = 1.52587890625e-5; // 2^-16
// Importances that are not 0, and probabilities, stay between this and its inverse.
const float kLightTreeLeast = 1e-37;
// Least square of a distance, in squares of the box's half diagonal: lights spread evenly over a cube send to its
// middle what they would from there.
const float kLightTreeNear = 0.17;

// max(0, a - b) of two angles in [0, pi].
vec2 lightTreeLess(vec2 a, vec2 b) {
  return a.x >= b.x ? vec2(1.0, 0.0) : vec2(a.x * b.x + a.y * b.y, a.y * b.x - a.x * b.y);
}

// Angle between two unit vectors.
vec2 lightTreeAngle(vec3 a, vec3 b) { return vec2(dot(a, b), length(cross(a, b))); }

// Factor of a bound of a cosine, 0 where no cosine can be positive.
float lightTreeCosine(float bound, float least) {
  return bound < least - kLightTreeSlack ? 0.0 : max(bound, kLightTreeSlack);
}

/// What a node should send to the receiver, (40): 0 only where nothing in it can shine there.
float lightTreeImportance(LightTreeNode node, LightReceiver receiver) {
  if (kLightSelection == kSelectPower) {
    return node.power;
  }
  const vec3 halfSize = 0.5 * (node.boundsMax - node.boundsMin);
  const vec3 fromMiddle = receiver.point - 0.5 * (node.boundsMax + node.boundsMin);
  const float radius2 = dot(halfSize, halfSize);
  const float distance2 = dot(fromMiddle, fromMiddle);
  const float arriving = node.power / max(max(distance2, kLightTreeNear * radius2), 1e-30);
  if (distance2 <= 1.0001 * radius2 || distance2 < 1e-30) {
    return clamp(arriving, kLightTreeLeast, 1.0 / kLightTreeLeast); // the box may lie in every direction
  }
  const vec3 w = fromMiddle / sqrt(distance2);
  const float sin2 = radius2 / distance2;
  const vec2 box = vec2(sqrt(1.0 - sin2), sqrt(sin2)); // half the angle under which its bounding sphere is seen
  const vec2 normals = vec2(node.cosNormals, safeSqrt((1.0 - node.cosNormals) * (1.0 + node.cosNormals)));
  const vec2 emission = lightTreeLess(lightTreeLess(lightTreeAngle(node.axis, w), normals), box);
  float cosines = lightTreeCosine(emission.x, node.cosEmission);
  if (receiver.normal != vec3(0.0)) {
    vec2 incident = lightTreeAngle(receiver.normal, -w);
    incident.x = receiver.twoSided ? abs(incident.x) : incident.x;
    cosines *= lightTreeCosine(lightTreeLess(incident, box).x, 0.0);
  }
  return cosines > 0.0 ? clamp(arriving * cosines, kLightTreeLeast, 1.0 / kLightTreeLeast) : 0.0;
}

// How a node's probability goes to its children.
struct LightTreeSplit {
  uint first;        // LightTreeNode::child of the first child
  uint second;
  bool firstIsLess;
  float less;        // share of the lesser child, [0, 1/2]; the other has 1 - less
};

LightTreeSplit lightTreeSplit(LightTreeNodePtr nodes, uint first, uint second, LightReceiver receiver) {
  const LightTreeNode a = nodes.at[first];
  const LightTreeNode b = nodes.at[second];
  float importanceA = lightTreeImportance(a, receiver);
  float importanceB = lightTreeImportance(b, receiver);
  if (importanceA == 0.0 && importanceB == 0.0) { // the parent's bounds were too wide to know
    importanceA = a.power;
    importanceB = b.power;
  }
  LightTreeSplit split;
  split.first = a.child;
  split.second = b.child;
  split.firstIsLess = importanceA < importanceB;
  const float lesser = min(importanceA, importanceB);
  split.less = lesser == 0.0 ? 0.0 : max(lesser / (importanceA + importanceB), kLightTreeLeastShare);
  return split;
}

/// One emitter, with probability emitterChoicePdf. `xi` uniform in [0, 1) serves for the first levels and may be
/// stratified; where a 256th of its range is left, `rng` gives a new one. Needs at least one emitter.
EmitterChoice chooseEmitter(EmittersPtr emitters, LightReceiver receiver, float xi, inout Rng rng) {
  const uint count = emitters.at[0].count;
  if (count == 1u) {
    return EmitterChoice(0u, 1.0);
  }
  if (kLightSelection == kSelectUniform) {
    return EmitterChoice(min(uint(xi * float(count)), count - 1u), 1.0 / float(count));
  }
  LightTreeNodePtr nodes = emitters.at[0].nodes;
  EmitterChoice choice = EmitterChoice(0u, 1.0);
  uint node = 0u;
  uint child = nodes.at[0].child;
  float range = 1.0; // what is left of xi's
  [[dont_unroll]] for (uint depth = 0u; depth < kLightTreeDepth && (child & kLightTreeLeaf) == 0u; ++depth) {
    const LightTreeSplit split = lightTreeSplit(nodes, node + 1u, child, receiver);
    // The lesser share lies at 0, where floats are finest.
    const bool less = xi < split.less;
    const float share = less ? split.less : 1.0 - split.less;
    const bool first = less == split.firstIsLess;
    xi = (less ? xi : xi - split.less) / share;
    node = first ? node + 1u : child;
    child = first ? split.first : split.second;
    choice.pdf = max(choice.pdf * share, kLightTreeLeast);
    range *= share;
    if (range < 1.0 / 256.0) {
      xi = rngFloat(rng);
      range = 1.0;
    }
  }
  choice.emitter = child & ~kLightTreeLeaf;
  return choice;
}

/// Probability that chooseEmitter gives `emitter`: over all emitters it sums to 1.
float emitterChoicePdf(EmittersPtr emitters, uint emitter, LightReceiver receiver) {
  const uint count = emitters.at[0].count;
  if (kLightSelection == kSelectUniform || count == 1u) {
    return 1.0 / float(count);
  }
  LightTreeNodePtr nodes = emitters.at[0].nodes;
  EmitterPtr list = emitters.at[0].emitters;
  const uint trail = list.at[emitter].trail;
  float pdf = 1.0;
  uint node = 0u;
  uint child = nodes.at[0].child;
  [[dont_unroll]] for (uint depth = 0u; depth < kLightTreeDepth && (child & kLightTreeLeaf) == 0u; ++depth) {
    const LightTreeSplit split = lightTreeSplit(nodes, node + 1u, child, receiver);
    const bool first = ((trail >> depth) & 1u) == 0u;
    const float share = first == split.firstIsLess ? split.less : 1.0 - split.less;
    if (share == 0.0) {
      return 0.0;
    }
    pdf = max(pdf * share, kLightTreeLeast);
    node = first ? node + 1u : child;
    child = first ? split.first : split.second;
  }
  return pdf;
}

#endif
