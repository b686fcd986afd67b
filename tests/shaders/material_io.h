// SPDX-License-Identifier: Apache-2.0
// What the probe of material/bsdf.glsl reads and writes.
#ifndef TYNDALL_TESTS_MATERIAL_IO_H
#define TYNDALL_TESTS_MATERIAL_IO_H

#include "interop/interop.h"

GPU_BEGIN

// The members of Bsdf, and directions.
struct BsdfQuery {
  uint model;
  vec3 colour;
  vec3 eta;
  vec3 k;
  float alpha;
  float metallic;
  float etaRatio;
  float coatF0;
  vec3 wo;
  vec3 wi;
};
GPU_BUFFER(BsdfQuery)

GPU_CONST uint kAnswerDelta = 1u;
GPU_CONST uint kAnswerTransmitted = 2u;
GPU_CONST uint kAnswerValid = 4u;

struct BsdfAnswer {
  vec3 value; // f |cos wi| at the query's wi, or at the sample's
  float valuePdf;
  vec3 wi; // of the sample; so are the rest
  vec3 weight;
  float pdf;
  uint flags;   // kAnswer*
  uint isDelta; // bsdfIsDelta
};
GPU_BUFFER(BsdfAnswer)

GPU_CONST uint kProbeValues = 0;  // answer i is of query i
GPU_CONST uint kProbeSamples = 1; // answer i is a sample of query i % queryCount

// Bugs planted in the probe.
GPU_CONST uint kPlantNone = 0;
GPU_CONST uint kPlantAlpha = 1;      // samples are of alpha times 1.3
GPU_CONST uint kPlantImportance = 2; // refraction without 1 / eta^2
GPU_CONST uint kPlantBranchPdf = 3;  // metal-rough: pdf of the base alone
GPU_CONST uint kPlantBright = 4;     // weights 5 % high
GPU_CONST uint kPlantOneWay = 5;     // values depend on wo by 0.1 %
GPU_CONST uint kPlantSchlick = 6;    // dielectric: probability of reflection by Schlick's formula
GPU_CONST uint kPlantUnguarded = 7;  // half vectors normalised whatever they are
GPU_CONST uint kPlantAngle = 8;      // samples are turned by 0.001

GPU_END
#endif
