// SPDX-License-Identifier: Apache-2.0
#include "passes/path/path_pass.h"

#include "kernels/path.h"

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

} // namespace

PathPass::PathPass(const gpu::Device& device, const PathSpec& spec, const gpu::AtlasImages& images)
    : kernel_(device, k_path_spirv, specEntries(spec), images) {}

} // namespace tyndall::passes
