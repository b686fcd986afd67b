// SPDX-License-Identifier: Apache-2.0
// Both compilers read shaders/interop; here their layouts are compared, member by member, in the shipped kernels.
#include "gpu/spirv.h"
#include "passes/path/path_pass.h"
#include "passes/trace/trace_pass.h"

// Needs <cstdint> before it.
#include "kernels/path.h"
#include "kernels/trace.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <string>

namespace tyndall::test {
namespace {

using Offsets = std::map<std::string, std::uint32_t>;

// clang-format off
#define AT(Struct, member) {#member, static_cast<std::uint32_t>(offsetof(interop::Struct, member))}
// clang-format on

std::map<std::string, Offsets> hostOffsets() {
  return {
      {"AliasEntry", {AT(AliasEntry, keep), AT(AliasEntry, alias), AT(AliasEntry, probability)}},
      {"EnvironmentMap",
       {AT(EnvironmentMap, texels), AT(EnvironmentMap, cells), AT(EnvironmentMap, size), AT(EnvironmentMap, cellCount),
        AT(EnvironmentMap, rotation), AT(EnvironmentMap, cellSolidAngle)}},
      {"Brick", {AT(Brick, texelBrick), AT(Brick, scale), AT(Brick, offset)}},
      {"Grid",
       {AT(Grid, voxelFromWorld), AT(Grid, boundsMin), AT(Grid, boundsMax), AT(Grid, brickCount), AT(Grid, coarseCount),
        AT(Grid, format), AT(Grid, bricks), AT(Grid, maxima), AT(Grid, coarseMaxima), AT(Grid, cumulative)}},
      {"Phase", {AT(Phase, id), AT(Phase, parameters)}},
      {"Medium",
       {AT(Medium, phase), AT(Medium, albedo), AT(Medium, sigmaT), AT(Medium, colour), AT(Medium, mediumFromWorld),
        AT(Medium, shape), AT(Medium, interiors), AT(Medium, shapeMin), AT(Medium, shapeMax), AT(Medium, emission),
        AT(Medium, emissionKind), AT(Medium, emissionTied), AT(Medium, temperatureScale), AT(Medium, temperatureOffset),
        AT(Medium, densityGrid), AT(Medium, emissionGrid), AT(Medium, emitter), AT(Medium, emissionMeasure)}},
      {"MediumNode",
       {AT(MediumNode, boundsMin), AT(MediumNode, skip), AT(MediumNode, boundsMax), AT(MediumNode, medium)}},
      {"PointLight",
       {AT(PointLight, position), AT(PointLight, intensity), AT(PointLight, selectPdf),
        AT(PointLight, equiangularPdf)}},
      {"DistantLight",
       {AT(DistantLight, kind), AT(DistantLight, visible), AT(DistantLight, selectPdf), AT(DistantLight, toLight),
        AT(DistantLight, radiance), AT(DistantLight, oneMinusCos), AT(DistantLight, map)}},
      {"Camera",
       {AT(Camera, origin), AT(Camera, corner), AT(Camera, rasterX), AT(Camera, rasterY), AT(Camera, lensX),
        AT(Camera, lensY), AT(Camera, focusDistance), AT(Camera, interiors)}},
      {"Scene",
       {AT(Scene, camera),        AT(Scene, imageSize),       AT(Scene, homogeneousCount), AT(Scene, mediumCount),
        AT(Scene, emissiveCount), AT(Scene, pointCount),      AT(Scene, distantCount),     AT(Scene, pointShare),
        AT(Scene, maxEvents),     AT(Scene, mediumNodeCount), AT(Scene, reserved),         AT(Scene, emitterShare),
        AT(Scene, media),         AT(Scene, grids),           AT(Scene, emissive),         AT(Scene, points),
        AT(Scene, distant),       AT(Scene, blackbody),       AT(Scene, mediumNodes),      AT(Scene, surfaces),
        AT(Scene, emitters)}},
      {"Texture",
       {AT(Texture, texels), AT(Texture, size), AT(Texture, wrapU), AT(Texture, wrapV), AT(Texture, srgb),
        AT(Texture, nearest)}},
      {"TextureUse", {AT(TextureUse, texture), AT(TextureUse, rowU), AT(TextureUse, rowV)}},
      {"Material",
       {AT(Material, model), AT(Material, flags), AT(Material, colour), AT(Material, eta), AT(Material, k),
        AT(Material, roughness), AT(Material, metallic), AT(Material, ior), AT(Material, alpha),
        AT(Material, alphaCutoff), AT(Material, emission), AT(Material, normalScale), AT(Material, interior),
        AT(Material, colourTexture), AT(Material, metalRoughTexture), AT(Material, normalTexture),
        AT(Material, emissionTexture)}},
      {"Interior", {AT(Interior, medium), AT(Interior, ior), AT(Interior, priority)}},
      {"BvhNode",
       {AT(BvhNode, origin), AT(BvhNode, scale), AT(BvhNode, lower), AT(BvhNode, upper), AT(BvhNode, children)}},
      {"BvhPrimitive", {AT(BvhPrimitive, v0), AT(BvhPrimitive, v1), AT(BvhPrimitive, v2), AT(BvhPrimitive, id)}},
      {"Motion", {AT(Motion, previousFromNow)}},
      {"Triangle", {AT(Triangle, vertices), AT(Triangle, material), AT(Triangle, emitter), AT(Triangle, motion)}},
      {"Vertex", {AT(Vertex, normal), AT(Vertex, uv)}},
      {"Sphere",
       {AT(Sphere, centre), AT(Sphere, radius), AT(Sphere, material), AT(Sphere, emitter), AT(Sphere, motion)}},
      {"Instance",
       {AT(Instance, objectFromWorld), AT(Instance, worldFromObject), AT(Instance, root), AT(Instance, motion)}},
      {"Surfaces",
       {AT(Surfaces, nodes), AT(Surfaces, primitives), AT(Surfaces, triangles), AT(Surfaces, vertices),
        AT(Surfaces, spheres), AT(Surfaces, instances), AT(Surfaces, materials), AT(Surfaces, textures),
        AT(Surfaces, interiors), AT(Surfaces, motions), AT(Surfaces, boundsMin), AT(Surfaces, boundsMax)}},
      {"Emitter",
       {AT(Emitter, kind), AT(Emitter, flags), AT(Emitter, position), AT(Emitter, edge1), AT(Emitter, edge2),
        AT(Emitter, radiance), AT(Emitter, index), AT(Emitter, trail)}},
      {"LightTreeNode",
       {AT(LightTreeNode, boundsMin), AT(LightTreeNode, boundsMax), AT(LightTreeNode, axis),
        AT(LightTreeNode, cosNormals), AT(LightTreeNode, cosEmission), AT(LightTreeNode, power),
        AT(LightTreeNode, child)}},
      {"Emitters", {AT(Emitters, emitters), AT(Emitters, nodes), AT(Emitters, count), AT(Emitters, flags)}},
      {"PixelSums", {AT(PixelSums, moments), AT(PixelSums, extras)}},
      {"TraceCounters",
       {AT(TraceCounters, suspended), AT(TraceCounters, nonFinite), AT(TraceCounters, majorantExceeded),
        AT(TraceCounters, lookups), AT(TraceCounters, segments), AT(TraceCounters, negative)}},
      {"TraceInputs",
       {AT(TraceInputs, scene), AT(TraceInputs, pixels), AT(TraceInputs, sums), AT(TraceInputs, suspendedIn),
        AT(TraceInputs, suspendedOut), AT(TraceInputs, counters), AT(TraceInputs, count), AT(TraceInputs, firstSample),
        AT(TraceInputs, sampleCount), AT(TraceInputs, seed), AT(TraceInputs, stepBound), AT(TraceInputs, stageCost),
        AT(TraceInputs, resume)}},
      {"ChainState",
       {AT(ChainState, target), AT(ChainState, weight), AT(ChainState, spread), AT(ChainState, evidence),
        AT(ChainState, time), AT(ChainState, velocityXY), AT(ChainState, velocityZCount)}},
      {"GuideCell",
       {AT(GuideCell, fingerprint), AT(GuideCell, stamp), AT(GuideCell, scatterGain), AT(GuideCell, guideGain),
        AT(GuideCell, scatterWeight), AT(GuideCell, samples)}},
      {"RadianceCell",
       {AT(RadianceCell, fingerprint), AT(RadianceCell, stamp), AT(RadianceCell, count), AT(RadianceCell, radiance)}},
      {"ScreenChain",
       {AT(ScreenChain, state), AT(ScreenChain, point), AT(ScreenChain, normal), AT(ScreenChain, score),
        AT(ScreenChain, round)}},
      {"GuideLevels",
       {AT(GuideLevels, angle), AT(GuideLevels, finest), AT(GuideLevels, ratioLog), AT(GuideLevels, spread)}},
      {"GuideRecord",
       {AT(GuideRecord, point), AT(GuideRecord, normal), AT(GuideRecord, direction), AT(GuideRecord, target),
        AT(GuideRecord, velocity), AT(GuideRecord, throughput), AT(GuideRecord, arrived), AT(GuideRecord, left),
        AT(GuideRecord, score), AT(GuideRecord, scatterPart), AT(GuideRecord, scatterPdf), AT(GuideRecord, meanWeight),
        AT(GuideRecord, mu), AT(GuideRecord, kappa), AT(GuideRecord, cell), AT(GuideRecord, source),
        AT(GuideRecord, state)}},
      {"GuideCounters",
       {AT(GuideCounters, vertices), AT(GuideCounters, states), AT(GuideCounters, guided), AT(GuideCounters, accepted),
        AT(GuideCounters, forgotten), AT(GuideCounters, evicted), AT(GuideCounters, unsound),
        AT(GuideCounters, distanceRays), AT(GuideCounters, distanceGuided)}},
      {"DistanceState",
       {AT(DistanceState, weight), AT(DistanceState, mean), AT(DistanceState, variance), AT(DistanceState, count)}},
      {"DistanceShare", {AT(DistanceShare, flightGain), AT(DistanceShare, guideGain), AT(DistanceShare, samples)}},
      {"DistanceLobe", {AT(DistanceLobe, peak), AT(DistanceLobe, mean), AT(DistanceLobe, sigma)}},
      {"DistanceRecord",
       {AT(DistanceRecord, lobes), AT(DistanceRecord, stretch), AT(DistanceRecord, chosen),
        AT(DistanceRecord, meanWeight), AT(DistanceRecord, vertex), AT(DistanceRecord, t), AT(DistanceRecord, before),
        AT(DistanceRecord, guidedPart), AT(DistanceRecord, share)}},
      {"GuideDistances",
       {AT(GuideDistances, states), AT(GuideDistances, shares), AT(GuideDistances, records),
        AT(GuideDistances, columns), AT(GuideDistances, statesEach), AT(GuideDistances, loads),
        AT(GuideDistances, width), AT(GuideDistances, mostShare), AT(GuideDistances, priorSigma)}},
      {"Guide", {AT(Guide, cells),         AT(Guide, states),       AT(Guide, radiance),       AT(Guide, records),
                 AT(Guide, counters),      AT(Guide, camera),       AT(Guide, cameraBefore),   AT(Guide, mostStep),
                 AT(Guide, shift),         AT(Guide, levels),       AT(Guide, radianceLevels), AT(Guide, staticWidth),
                 AT(Guide, adaptiveShare), AT(Guide, cellCount),    AT(Guide, staticCount),    AT(Guide, radianceCount),
                 AT(Guide, window),        AT(Guide, priorArea),    AT(Guide, priorLeast),     AT(Guide, mostKappa),
                 AT(Guide, kappaGrowth),   AT(Guide, scatterShare), AT(Guide, leastShare),     AT(Guide, mostShare),
                 AT(Guide, shareSamples),  AT(Guide, leastRate),    AT(Guide, forgetBelow),    AT(Guide, forgetRate),
                 AT(Guide, radianceLimit), AT(Guide, time),         AT(Guide, mostTime),       AT(Guide, farDistance),
                 AT(Guide, round),         AT(Guide, mostRecords),  AT(Guide, frameTime),      AT(Guide, log),
                 AT(Guide, logCounts),     AT(Guide, logSize),      AT(Guide, screen),         AT(Guide, rasterBefore),
                 AT(Guide, screenSize),    AT(Guide, screenDepth),  AT(Guide, frameRound),     AT(Guide, newbornShare),
                 AT(Guide, fitSamples),    AT(Guide, distance)}},
      {"GuideUpdate",
       {AT(GuideUpdate, kind), AT(GuideUpdate, place), AT(GuideUpdate, fingerprint), AT(GuideUpdate, point),
        AT(GuideUpdate, state)}},
      {"PathCounters",
       {AT(PathCounters, suspended), AT(PathCounters, nonFinite), AT(PathCounters, majorantExceeded),
        AT(PathCounters, lookups), AT(PathCounters, segments), AT(PathCounters, negative), AT(PathCounters, events),
        AT(PathCounters, maxEvents)}},
      {"GuideView",
       {AT(GuideView, fingerprint), AT(GuideView, level), AT(GuideView, states), AT(GuideView, weight),
        AT(GuideView, direction), AT(GuideView, cosine), AT(GuideView, evidence), AT(GuideView, share)}},
      {"PathInputs",
       {AT(PathInputs, scene), AT(PathInputs, pixels), AT(PathInputs, sums), AT(PathInputs, suspendedIn),
        AT(PathInputs, suspendedOut), AT(PathInputs, counters), AT(PathInputs, guide), AT(PathInputs, views),
        AT(PathInputs, count), AT(PathInputs, firstSample), AT(PathInputs, sampleCount), AT(PathInputs, seed),
        AT(PathInputs, stepBound), AT(PathInputs, stageCost), AT(PathInputs, resume)}},
  };
}

std::vector<gpu::SpirvInfo> kernels() { return {gpu::readSpirv(k_trace_spirv), gpu::readSpirv(k_path_spirv)}; }

/// Structs of the table whose layout differs in a kernel, whose members are not the same ones, or that no kernel has.
std::vector<std::string> differences(const std::map<std::string, Offsets>& host) {
  std::vector<std::string> result;
  for (const auto& [name, members] : host) {
    bool found = false;
    bool same = true;
    for (const gpu::SpirvInfo& info : kernels()) {
      if (const auto place = info.offsets.find(name); place != info.offsets.end()) {
        found = true;
        same = same && place->second == members;
      }
    }
    if (!found || !same) {
      result.push_back(name);
    }
  }
  return result;
}

TEST(InteropLayout, IsTheSameForBothCompilers) { EXPECT_EQ(differences(hostOffsets()), std::vector<std::string>{}); }

TEST(InteropLayout, DifferencesAreSeen) {
  auto shifted = hostOffsets();
  shifted["Medium"]["sigmaT"] += 4; // planted
  EXPECT_EQ(differences(shifted), std::vector<std::string>{"Medium"});
  auto missing = hostOffsets();
  missing["Scene"].erase("pointShare"); // planted: a member that the table forgot
  EXPECT_EQ(differences(missing), std::vector<std::string>{"Scene"});
}

TEST(InteropLayout, EveryStructOfTheKernelsIsInTheTable) {
  const auto host = hostOffsets();
  for (const gpu::SpirvInfo& info : kernels()) {
    for (const auto& [name, members] : info.offsets) {
      // States that only the device reads are its own business; blocks hold one array or the push constants.
      const bool deviceOnly = name == "Walk" || name == "TraceState" || name.starts_with("PathState") ||
                              name == "PathRay" || name == "PathVertex" || name == "PathHit";
      const bool block = name == "Push" || name.ends_with("Ptr");
      EXPECT_TRUE(deviceOnly || block || host.contains(name)) << name;
    }
  }
}

TEST(Spirv, WorkgroupSizeIsRead) { EXPECT_EQ(gpu::readSpirv(k_trace_spirv).workgroupSize, 64u); }

} // namespace
} // namespace tyndall::test
