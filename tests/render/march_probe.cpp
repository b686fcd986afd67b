// SPDX-License-Identifier: Apache-2.0
#include "render/march_probe.h"

#include "support/probe.h"

// Needs <cstdint> before it.
#include "kernels/march_probe.h"

#include <gtest/gtest.h>

namespace tyndall::test {
namespace {

constexpr double kCacheBytes = 256e6;

std::vector<gpu::SpecEntry> entriesOf(const passes::MarchSpec& spec) {
  return {
#define SPEC(type, name, id, value) gpu::SpecEntry{id, gpu::specBits(spec.name)},
      TYNDALL_MARCH_SPEC(SPEC)
#undef SPEC
  };
}

} // namespace

MarchProbe::MarchProbe(const TestScene& test, std::uint32_t plantedBug, const Plant& plant)
    : scene_(probeDevice(), test.scene, test.volumes, gpu_scene::GridLayout::Cells),
      march_(probeDevice(), scene_, test.volumes, kCacheBytes) {
  const render::EstimatorOptions options{.method = render::Method::March, .plantedBug = plantedBug};
  kernel_ = std::make_unique<gpu::Kernel>(probeDevice(), k_march_probe_spirv,
                                          entriesOf(render::marchSpecFor(scene_, march_.plan(), options)));
  if (plant) {
    plantGrids(test, plant);
  }
}

void MarchProbe::plantGrids(const TestScene& test, const Plant& plant) {
  gpu_scene::PackedMedia media = scene_.media();
  plant(media);
  plantedGrids_ = gpu_scene::CellGrids(probeDevice(), media, test.volumes);
  interop::MarchScene header = render::planMarch(scene_).header;
  header.grids = plantedGrids_.ptr();
  plantedHeader_ = gpu::Buffer<interop::MarchScene>(probeDevice(), std::span<const interop::MarchScene>(&header, 1));
}

MarchRays MarchProbe::rays(std::span<const OracleRay> world) const {
  MarchRays rays;
  for (const OracleRay& ray : world) {
    const glm::vec3 origin(ray.origin - scene_.centre());
    const glm::vec3 direction(glm::normalize(ray.direction));
    rays.device.push_back({origin, direction});
    rays.exact.push_back({glm::dvec3(origin) + scene_.centre(), glm::normalize(glm::dvec3(direction))});
  }
  return rays;
}

std::vector<interop::MarchProbeResult> MarchProbe::march(const MarchRays& rays, const ProbeSamples& samples) const {
  interop::MarchProbeInputs inputs{};
  inputs.firstSample = samples.first;
  inputs.sampleCount = samples.count;
  inputs.seed = samples.seed;
  inputs.mode = interop::kProbeMarch;
  return run(rays, inputs);
}

std::vector<interop::MarchProbeResult> MarchProbe::walk(const MarchRays& rays, std::uint32_t mode) const {
  interop::MarchProbeInputs inputs{};
  inputs.mode = mode;
  return run(rays, inputs);
}

std::vector<interop::MarchProbeResult> MarchProbe::run(const MarchRays& rays, interop::MarchProbeInputs inputs) const {
  const auto input = ProbeRunner::upload(rays.device);
  const auto output = ProbeRunner::results<interop::MarchProbeResult>(rays.device.size());
  inputs.scene = scene_.ptr();
  inputs.march = plantedHeader_.size() > 0 ? plantedHeader_.ptr() : march_.ptr();
  inputs.rays = input.ptr();
  inputs.results = output.ptr();
  inputs.count = static_cast<std::uint32_t>(rays.device.size());
  kernel_->run(inputs, inputs.count);
  for (const std::string& message : probeDevice().messages()) {
    ADD_FAILURE() << "validation: " << message;
  }
  return ProbeRunner::download(output);
}

} // namespace tyndall::test
