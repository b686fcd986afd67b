// SPDX-License-Identifier: Apache-2.0
// Surfaces on the device: one array of BVH nodes and primitives for the world and for every instanced mesh.
#ifndef TYNDALL_INTEROP_SURFACES_H
#define TYNDALL_INTEROP_SURFACES_H

#include "interop/material.h"

GPU_BEGIN

GPU_CONST uint kBvhEmpty = 0xffffffffu;
GPU_CONST uint kBvhLeaf = 0x80000000u;        // leaf: bits 28..30 hold count - 1, bits 0..27 the first primitive
GPU_CONST uint kBvhCountShift = 28;
GPU_CONST uint kBvhFirstMask = 0x0fffffffu;
GPU_CONST uint kBvhLargestLeaf = 8;
GPU_CONST uint kBvhStack = 64;                // entries; the builder bounds the depth so that it holds

// Four children, their boxes in 256ths of the node's: conservative, child box = origin + scale * byte.
struct BvhNode {
  vec3 origin;
  vec3 scale;
  uint lower[3];      // per axis, a byte per child, child 0 lowest
  uint upper[3];
  uint children[4];   // index of a node, a leaf, or kBvhEmpty
};
GPU_BUFFER(BvhNode)

// BvhPrimitive::id = kind | flags | index
GPU_CONST uint kPrimitiveTriangle = 0u;          // v0 v1 v2; index into Surfaces::triangles
GPU_CONST uint kPrimitiveSphere = 0x40000000u;   // v0 = centre, v1.x = radius; index into Surfaces::spheres
GPU_CONST uint kPrimitiveInstance = 0x80000000u; // index into Surfaces::instances
GPU_CONST uint kPrimitiveKindMask = 0xc0000000u;
GPU_CONST uint kPrimitiveOpaque = 0x20000000u;   // nothing passes: a shadow ray ends here
GPU_CONST uint kPrimitiveIndexMask = 0x1fffffffu;

// What a traversal reads. Vertices themselves, not edges: neighbours share them bit by bit.
struct BvhPrimitive {
  vec3 v0;
  vec3 v1;
  vec3 v2;
  uint id;
};
GPU_BUFFER(BvhPrimitive)

GPU_CONST uint kNoEmitter = 0xffffffffu;
GPU_CONST uint kNoMotion = 0xffffffffu;       // it stands where it stood in the previous frame

// From a surface's place in this frame to its place in the previous one: centred world space of this frame, both.
struct Motion {
  mat4x3 previousFromNow;
};
GPU_BUFFER(Motion)

struct Triangle {
  uint vertices[3];   // indices into Surfaces::vertices, in the order of BvhPrimitive
  uint material;      // index into Surfaces::materials
  uint emitter;       // index into Surfaces::emitters, or kNoEmitter
  uint motion;        // index into Surfaces::motions, or kNoMotion; of an instanced mesh: kNoMotion, its instance's holds
};
GPU_BUFFER(Triangle)

struct Vertex {
  vec3 normal;        // object space; 0 0 0: the triangle's own
  vec2 uv;
};
GPU_BUFFER(Vertex)

struct Sphere {
  vec3 centre;        // centred world space
  float radius;
  uint material;
  uint emitter;
  uint motion;        // index into Surfaces::motions, or kNoMotion
};
GPU_BUFFER(Sphere)

// A mesh seen through a transform. Emissive meshes are never instanced.
struct Instance {
  mat4x3 objectFromWorld;
  mat4x3 worldFromObject;
  uint root;          // its node
  uint motion;        // index into Surfaces::motions, or kNoMotion
};
GPU_BUFFER(Instance)

struct Surfaces {
  GPU_PTR(BvhNode) nodes;         // node 0 is the world's root
  GPU_PTR(BvhPrimitive) primitives;
  GPU_PTR(Triangle) triangles;
  GPU_PTR(Vertex) vertices;
  GPU_PTR(Sphere) spheres;
  GPU_PTR(Instance) instances;
  GPU_PTR(Material) materials;
  GPU_PTR(Texture) textures;
  GPU_PTR(Interior) interiors;
  GPU_PTR(Motion) motions;        // 0: nothing moves
  vec3 boundsMin;                 // of all surfaces
  vec3 boundsMax;
};
GPU_BUFFER(Surfaces)

GPU_END
#endif
