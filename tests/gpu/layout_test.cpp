// SPDX-License-Identifier: Apache-2.0
// Both compilers read shaders/interop; here their layouts are compared, member by member, in the shipped kernel.
#include "gpu/spirv.h"
#include "passes/trace/trace_pass.h"

// Needs <cstdint> before it.
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
      {"EnvironmentMap", {AT(EnvironmentMap, texels), AT(EnvironmentMap, cells), AT(EnvironmentMap, size), AT(EnvironmentMap, cellCount),
                          AT(EnvironmentMap, rotation), AT(EnvironmentMap, cellSolidAngle)}},
      {"Brick", {AT(Brick, texelBrick), AT(Brick, scale), AT(Brick, offset)}},
      {"Grid", {AT(Grid, voxelFromWorld), AT(Grid, boundsMin), AT(Grid, boundsMax), AT(Grid, brickCount), AT(Grid, coarseCount),
                AT(Grid, format), AT(Grid, bricks), AT(Grid, maxima), AT(Grid, coarseMaxima)}},
      {"Phase", {AT(Phase, id), AT(Phase, parameters)}},
      {"Medium", {AT(Medium, phase), AT(Medium, albedo), AT(Medium, sigmaT), AT(Medium, mediumFromWorld), AT(Medium, shape),
                  AT(Medium, shapeMin), AT(Medium, shapeMax), AT(Medium, emission), AT(Medium, emissionKind), AT(Medium, emissionTied),
                  AT(Medium, temperatureScale), AT(Medium, temperatureOffset), AT(Medium, densityGrid), AT(Medium, emissionGrid)}},
      {"PointLight", {AT(PointLight, position), AT(PointLight, intensity), AT(PointLight, selectPdf), AT(PointLight, equiangularPdf)}},
      {"DistantLight", {AT(DistantLight, kind), AT(DistantLight, visible), AT(DistantLight, selectPdf), AT(DistantLight, toLight),
                        AT(DistantLight, radiance), AT(DistantLight, oneMinusCos), AT(DistantLight, map)}},
      {"Camera", {AT(Camera, origin), AT(Camera, corner), AT(Camera, rasterX), AT(Camera, rasterY)}},
      {"Scene", {AT(Scene, camera), AT(Scene, imageSize), AT(Scene, homogeneousCount), AT(Scene, mediumCount), AT(Scene, emissiveCount),
                 AT(Scene, pointCount), AT(Scene, distantCount), AT(Scene, pointShare), AT(Scene, media), AT(Scene, grids),
                 AT(Scene, emissive), AT(Scene, points), AT(Scene, distant), AT(Scene, blackbody)}},
      {"PixelSums", {AT(PixelSums, moments), AT(PixelSums, extras)}},
      {"TraceCounters", {AT(TraceCounters, suspended), AT(TraceCounters, nonFinite), AT(TraceCounters, majorantExceeded),
                         AT(TraceCounters, lookups), AT(TraceCounters, segments), AT(TraceCounters, negative)}},
      {"TraceInputs", {AT(TraceInputs, scene), AT(TraceInputs, pixels), AT(TraceInputs, sums), AT(TraceInputs, suspendedIn),
                       AT(TraceInputs, suspendedOut), AT(TraceInputs, counters), AT(TraceInputs, count), AT(TraceInputs, firstSample),
                       AT(TraceInputs, sampleCount), AT(TraceInputs, seed), AT(TraceInputs, stepBound), AT(TraceInputs, stageCost),
                       AT(TraceInputs, resume)}},
  };
}

/// Structs whose layout differs or whose members are not the same ones.
std::vector<std::string> differences(const std::map<std::string, Offsets>& host) {
  const gpu::SpirvInfo info = gpu::readSpirv(k_trace_spirv);
  std::vector<std::string> result;
  for (const auto& [name, members] : host) {
    const auto place = info.offsets.find(name);
    if (place == info.offsets.end() || place->second != members) {
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

TEST(InteropLayout, EveryStructOfTheKernelIsInTheTable) {
  const auto host = hostOffsets();
  for (const auto& [name, members] : gpu::readSpirv(k_trace_spirv).offsets) {
    // States that only the device reads are its own business; blocks hold one array or the push constants.
    const bool deviceOnly = name == "Walk" || name == "TraceState";
    const bool block = name == "Push" || (name.size() > 3 && name.substr(name.size() - 3) == "Ptr");
    EXPECT_TRUE(deviceOnly || block || host.contains(name)) << name;
  }
}

TEST(Spirv, WorkgroupSizeIsRead) { EXPECT_EQ(gpu::readSpirv(k_trace_spirv).workgroupSize, 64u); }

} // namespace
} // namespace tyndall::test
