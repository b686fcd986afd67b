// SPDX-License-Identifier: Apache-2.0
#include "bench/ray_caster.h"
#include "microbench/commands.h"
#include "microbench/measure.h"
#include "microbench/ray_peer.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace tyndall::microbench {
namespace {

using Json = nlohmann::ordered_json;
using interop::BenchHit;

/// Rays whose distances differ by more than rounding, or that one of both misses.
std::size_t differing(std::span<const BenchHit> hits, const std::vector<float>& distances) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    count += std::abs(hits[i].t - distances[i]) > 1e-3f * std::max(distances[i], 1e-2f) ? 1 : 0;
  }
  return count;
}

struct Kind {
  const char* name;
  bool anyHit;
};

Json kindRow(const Session& session, DeviceCaster& caster, const std::optional<RayCaster>& peer, const BenchRays& rays,
             const Kind& kind) {
  caster.load(rays);
  caster.run(kind.anyHit); // compiles
  std::vector<float> distances(rays.size());
  std::vector<double> own;
  std::vector<double> theirs;
  const bool processClock = session.device.info().type == "cpu";
  for (std::uint32_t round = 0; round < session.options.repeats; ++round) {
    const Cost cost = costOf([&] { caster.run(kind.anyHit); });
    own.push_back(processClock ? cost.cpu : cost.wall);
    if (peer) {
      theirs.push_back(costOf([&] { (*peer)(rays, kind.anyHit, distances); }).cpu);
    }
  }
  const Figure count{double(rays.size()) * 1e-6, 0.0};
  const Figure ownRate = count / medianTime(own);
  Json row{{"rays", kind.name}, {"count", rays.size()}, {"millionPerSecond", ownRate.value}};
  const Interval ownSpan = interval(ownRate, own.size());
  fmt::print("  {:<16}{:>8} [{}, {}]", kind.name, shortText(ownRate.value), shortText(ownSpan.low),
             shortText(ownSpan.high));
  if (peer) {
    const Figure peerRate = count / medianTime(theirs);
    const Figure ratio = ownRate / peerRate;
    const Interval span = interval(ratio, own.size());
    const std::size_t others = differing(caster.hits(), distances);
    fmt::print("{:>10}{:>8} [{}, {}]{:>8}", shortText(peerRate.value), shortText(ratio.value), shortText(span.low),
               shortText(span.high), others);
    row["embreeMillionPerSecond"] = peerRate.value;
    row["ratio"] = ratio.value;
    row["differing"] = others;
  }
  fmt::print("\n");
  std::fflush(stdout);
  return row;
}

Json sceneRows(const Session& session, const RayScene& scene) {
  geometry::Bvh bvh;
  const Cost build = costOf([&] { bvh = geometry::buildBvh(scene.triangles); });
  fmt::print("{}: {} nodes, {} levels, built in {} s\n", scene.name, bvh.nodes.size(), bvh.depth,
             shortText(build.wall));
  DeviceCaster caster(session.device, bvh);
  const std::optional<RayCaster> peer = embreeCaster(scene);
  const BenchRays primary = primaryRays(scene, session.options.size);
  Json rows = Json::array({kindRow(session, caster, peer, primary, {"primary", false})});
  const std::vector<BenchHit> hits(caster.hits().begin(), caster.hits().end());
  rows.push_back(kindRow(session, caster, peer, secondaryRays(scene, bvh, primary, hits, false), {"diffuse", false}));
  rows.push_back(
      kindRow(session, caster, peer, secondaryRays(scene, bvh, primary, hits, true), {"shadow, any hit", true}));
  return {{"scene", scene.name}, {"buildSeconds", build.wall}, {"nodes", bvh.nodes.size()}, {"figures", rows}};
}

} // namespace

Json raysReport(const Session& session) {
  fmt::print("\nmillion rays per {}; 95 % intervals{}\n",
             session.device.info().type == "cpu" ? "CPU core second" : "second",
             embreeCaster(boxScene()) ? "; Embree's on one core; the ratio; rays that found other distances"
                                      : "; built without Embree, so nothing to compare with");
  Json rows = Json::array();
  constexpr int kRings = 64;      // 97k triangles
  constexpr int kManyRings = 204; // a million
  for (const RayScene& scene : {boxScene(), bumpySpheres(kRings), bumpySpheres(kManyRings)}) {
    rows.push_back(sceneRows(session, scene));
  }
  return rows;
}

} // namespace tyndall::microbench
