// SPDX-License-Identifier: Apache-2.0
// Lights that have a place, and the tree by which a vertex chooses one of them.
#ifndef TYNDALL_INTEROP_EMITTERS_H
#define TYNDALL_INTEROP_EMITTERS_H

#include "interop/interop.h"

GPU_BEGIN

GPU_CONST uint kEmitterPoint = 0;    // position, radiance = intensity [W/sr]
GPU_CONST uint kEmitterSpot = 1;     // the same; edge1 = axis (unit), edge2.x = 1 - cos of the outer, .y of the inner half-angle
GPU_CONST uint kEmitterTriangle = 2; // position = v0, edge1 = v1 - v0, edge2 = v2 - v0; radiance on the side of
                                     // cross(edge1, edge2), or both
GPU_CONST uint kEmitterSphere = 3;   // position = centre, edge1.x = radius; outside, or both sides
GPU_CONST uint kEmitterVolume = 4;   // index = medium whose emission it is; its points are position + (edge1 edge2
                                     // radiance) * local, local in the unit cube, the unit ball or of the grid's voxels

GPU_CONST uint kEmitterTwoSided = 1u; // flag
GPU_CONST uint kEmitterSmall = 2u;    // flag: a point, a spot, or a sphere that is small beside the scene

struct Emitter {
  uint kind;          // kEmitter*
  uint flags;
  vec3 position;      // centred world space
  vec3 edge1;
  vec3 edge2;
  vec3 radiance;      // [W/(m2 sr)], before the material's emission texture; point and spot: [W/sr]
  uint index;         // triangle: into Surfaces::triangles; sphere: into Surfaces::spheres; volume: the medium
  uint trail;         // the way from the tree's root to its leaf: bit i = 1: the second child at depth i
};
GPU_BUFFER(Emitter)

// A box of emitters with a bound of the directions they shine to [Conty and Kulla 2018].
struct LightTreeNode {
  vec3 boundsMin;     // centred world space
  vec3 boundsMax;
  vec3 axis;          // unit
  float cosNormals;   // of the angle around the axis that holds all emitters' normals
  float cosEmission;  // of the angle around a normal within which light is emitted
  float power;        // luminance, [W]; > 0
  uint child;         // inner: index of the second child, the first one follows this node; leaf: kLightTreeLeaf | emitter
};
GPU_BUFFER(LightTreeNode)
GPU_CONST uint kLightTreeLeaf = 0x80000000u;
GPU_CONST uint kLightTreeDepth = 32; // at most: bits of a trail

// How a vertex chooses an emitter: what each pipeline is specialized to.
GPU_CONST uint kSelectTree = 0;    // by what should arrive at the vertex
GPU_CONST uint kSelectPower = 1;   // by power alone
GPU_CONST uint kSelectUniform = 2; // evenly

struct Emitters {
  GPU_PTR(Emitter) emitters;
  GPU_PTR(LightTreeNode) nodes; // node 0 is the root
  uint count;
  uint flags;                   // unused
};
GPU_BUFFER(Emitters)

GPU_END
#endif
