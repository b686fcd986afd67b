// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/kernel.h"
#include "passes/march/march_io.h"

namespace tyndall::passes {

/// Specialization constants of the pass, with the defaults of march_io.h.
struct MarchSpec {
  using uint = std::uint32_t;
#define SPEC(type, name, id, value) type name = value;
  TYNDALL_MARCH_SPEC(SPEC)
#undef SPEC
};

/// Single scattering by an exact march along camera rays; march_io.h is the contract.
class MarchPass {
public:
  MarchPass(const gpu::Device& device, const MarchSpec& spec);

  /// Runs `inputs.count` invocations and waits.
  void run(const interop::MarchInputs& inputs) const { kernel_.run(inputs, inputs.count); }
  const gpu::Kernel& kernel() const { return kernel_; }

private:
  gpu::Kernel kernel_;
};

} // namespace tyndall::passes
