// SPDX-License-Identifier: Apache-2.0
// The whole scene on the device. World space is centred: the host subtracts the scene's centre in double.
#ifndef TYNDALL_INTEROP_SCENE_H
#define TYNDALL_INTEROP_SCENE_H

#include "interop/emitters.h"
#include "interop/environment.h"
#include "interop/grid.h"
#include "interop/phase.h"
#include "interop/surfaces.h"

GPU_BEGIN

GPU_CONST uint kShapeUnbounded = 0;
GPU_CONST uint kShapeBox = 1;
GPU_CONST uint kShapeSphere = 2;
GPU_CONST uint kShapeInterior = 3;  // inside the objects of Medium::interiors

GPU_CONST uint kEmissionNone = 0;
GPU_CONST uint kEmissionLinear = 1;    // j = emission * value
GPU_CONST uint kEmissionBlackbody = 2; // j = emission * B(temperatureScale * value + temperatureOffset)

// Where light is scattered and absorbed. Homogeneous media come first in Scene::media, then those with grids.
struct Medium {
  Phase phase;
  vec3 albedo;           // sigma_s / sigma_t, [0, 1]
  float sigmaT;          // homogeneous: extinction [1/unit]; grid: extinction per unit of density
  vec3 colour;           // the extinction's factor per channel, [0, 1], the largest 1
  mat4x3 mediumFromWorld; // homogeneous: affine
  uint shape;            // kShape*
  uint interiors;        // bits of the interiors that it fills (kShapeInterior)
  vec3 shapeMin;         // box: corner; sphere: centre
  vec3 shapeMax;         // box: corner; sphere: x = radius
  vec3 emission;         // [W/(m3 sr)] per unit of value, or multiplier of the blackbody's RGB
  uint emissionKind;     // kEmission*
  uint emissionTied;     // 1: j is multiplied by sigma_a
  float temperatureScale;
  float temperatureOffset;
  uint densityGrid;      // index into Scene::grids (grid media)
  uint emissionGrid;     // index into Scene::grids
  uint emitter;          // pass `path`: index among the emitters, or kNoEmitter: found by directions alone
  float emissionMeasure; // integral over the medium of the density that emission points are chosen by
};
GPU_BUFFER(Medium)

// A box around grid media, depth first: where a ray misses it, the walk goes on at `skip`.
struct MediumNode {
  vec3 boundsMin;        // centred world space
  uint skip;             // the node after all of those below this one
  vec3 boundsMax;
  uint medium;           // leaf: index into Scene::media; inner: kNoMedium
};
GPU_BUFFER(MediumNode)

// Lights with a position.
struct PointLight {
  vec3 position;
  vec3 intensity;        // [W/sr]
  float selectPdf;       // probability of light selection at a vertex
  float equiangularPdf;  // probability of being the centre of an equiangular distance
};
GPU_BUFFER(PointLight)

GPU_CONST uint kDistantDelta = 0;       // sun without angular size
GPU_CONST uint kDistantDisc = 1;        // sun with angular size
GPU_CONST uint kDistantConstant = 2;    // constant environment
GPU_CONST uint kDistantMap = 3;         // lat-long environment

// Lights at infinity.
struct DistantLight {
  uint kind;             // kDistant*
  uint visible;          // 1: the camera sees it
  float selectPdf;
  vec3 toLight;          // unit (sun)
  vec3 radiance;         // [W/(m2 sr)] disc and constant; delta: irradiance [W/m2]
  float oneMinusCos;     // 1 - cos(half angle) of the disc
  EnvironmentMap map;
};
GPU_BUFFER(DistantLight)

// Rays leave origin + rasterX * x + rasterY * y (orthographic) or go along that direction (perspective);
// x, y in [0, 1] across the whole image, y down.
struct Camera {
  vec3 origin;           // position; orthographic: corner x = y = 0 of the image
  vec3 corner;           // direction of corner x = y = 0 (perspective); view direction (orthographic)
  vec3 rasterX;
  vec3 rasterY;
  vec3 lensX;            // half-axes of the lens [scene units]; 0 0 0: a pinhole
  vec3 lensY;
  float focusDistance;   // from the lens to the plane in focus, along the view direction
  uint interiors;        // that the camera stands in
};

struct Scene {
  Camera camera;
  uvec2 imageSize;
  uint homogeneousCount; // media [0, homogeneousCount)
  uint mediumCount;      // grid media are [homogeneousCount, mediumCount)
  uint emissiveCount;    // grid media with emission
  uint pointCount;
  uint distantCount;
  float pointShare;      // probability that light selection takes a point light
  uint maxEvents;        // scattering events of a path at most
  uint mediumNodeCount;
  uint reserved;         // unused: pointers lie at multiples of 8
  float emitterShare;    // pass `path`: probability that light selection takes an emitter
  GPU_PTR(Medium) media;
  GPU_PTR(Grid) grids;
  GPU_PTR(uint) emissive; // indices of media with grid emission
  GPU_PTR(PointLight) points;
  GPU_PTR(DistantLight) distant;
  GPU_PTR(vec3) blackbody; // table of light/blackbody.glsl
  GPU_PTR(MediumNode) mediumNodes; // of the grid media, where there are many
  GPU_PTR(Surfaces) surfaces;
  GPU_PTR(Emitters) emitters;
};
GPU_BUFFER(Scene)

GPU_END
#endif
