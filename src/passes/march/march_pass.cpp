// SPDX-License-Identifier: Apache-2.0
#include "passes/march/march_pass.h"

#include "kernels/march.h"

#include <array>

namespace tyndall::passes {
namespace {

auto specEntries(const MarchSpec& spec) {
  return std::array{
#define SPEC(type, name, id, value) gpu::SpecEntry{id, gpu::specBits(spec.name)},
      TYNDALL_MARCH_SPEC(SPEC)
#undef SPEC
  };
}

} // namespace

MarchPass::MarchPass(const gpu::Device& device, const MarchSpec& spec)
    : kernel_(device, k_march_spirv, specEntries(spec)) {}

} // namespace tyndall::passes
