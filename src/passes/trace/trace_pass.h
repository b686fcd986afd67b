// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/kernel.h"
#include "passes/trace/trace_io.h"

namespace tyndall::passes {

/// Specialization constants of the pass, with the defaults of trace_io.h.
struct TraceSpec {
  using uint = std::uint32_t;
#define SPEC(type, name, id, value) type name = value;
  TYNDALL_TRACE_SPEC(SPEC)
#undef SPEC
};

/// One statistical batch of samples for a list of pixels; trace_io.h is the contract.
class TracePass {
public:
  TracePass(const gpu::Device& device, const TraceSpec& spec, const gpu::AtlasImages& images);

  /// Runs `inputs.count` invocations and waits.
  void run(const interop::TraceInputs& inputs) const { kernel_.run(inputs, inputs.count); }
  const gpu::Kernel& kernel() const { return kernel_; }

private:
  gpu::Kernel kernel_;
};

} // namespace tyndall::passes
