// SPDX-License-Identifier: Apache-2.0
#include "passes/path/path_pass.h"

#include "kernels/path.h"
#include "kernels/path_ray_query.h"

#include <array>

namespace tyndall::passes {
namespace {

auto specEntries(const PathSpec& spec) {
  return std::array{
#define SPEC(type, name, id, value) gpu::SpecEntry{id, gpu::specBits(spec.name)},
      TYNDALL_PATH_SPEC(SPEC)
#undef SPEC
  };
}

std::span<const std::uint32_t> moduleFor(const gpu::AccelerationStructure* rays) {
  if (rays == nullptr) {
    return k_path_spirv;
  }
  return k_path_ray_query_spirv;
}

} // namespace

PathPass::PathPass(const gpu::Device& device, const PathSpec& spec, const gpu::AtlasImages& images,
                   const gpu::AccelerationStructure* rays)
    : kernel_(device, moduleFor(rays), specEntries(spec), images, rays) {}

} // namespace tyndall::passes
