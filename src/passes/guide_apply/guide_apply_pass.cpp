// SPDX-License-Identifier: Apache-2.0
#include "passes/guide_apply/guide_apply_pass.h"

#include "kernels/guide_apply.h"

#include <array>

namespace tyndall::passes {
namespace {

auto specEntries(const GuideApplySpec& spec) {
  return std::array{
#define SPEC(type, name, id, value) gpu::SpecEntry{id, gpu::specBits(spec.name)},
      TYNDALL_GUIDE_APPLY_SPEC(SPEC)
#undef SPEC
  };
}

} // namespace

GuideApplyPass::GuideApplyPass(const gpu::Device& device, const GuideApplySpec& spec)
    : kernel_(device, k_guide_apply_spirv, specEntries(spec)) {}

} // namespace tyndall::passes
