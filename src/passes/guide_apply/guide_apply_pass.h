// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/kernel.h"
#include "passes/guide_apply/guide_apply_io.h"

namespace tyndall::passes {

/// Specialization constants of the pass, with the defaults of guide_apply_io.h.
struct GuideApplySpec {
  using uint = std::uint32_t;
#define SPEC(type, name, id, value) type name = value;
  TYNDALL_GUIDE_APPLY_SPEC(SPEC)
#undef SPEC
};

/// Carries logged updates of the chain store out; guide_apply_io.h is the contract.
class GuideApplyPass {
public:
  GuideApplyPass(const gpu::Device& device, const GuideApplySpec& spec);

  /// Runs `inputs.count` invocations and waits.
  void run(const interop::GuideApplyInputs& inputs) const { kernel_.run(inputs, inputs.count); }

private:
  gpu::Kernel kernel_;
};

} // namespace tyndall::passes
