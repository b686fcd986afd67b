// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/kernel.h"
#include "passes/path/path_io.h"

namespace tyndall::passes {

/// Specialization constants of the pass, with the defaults of path_io.h.
struct PathSpec {
  using uint = std::uint32_t;
#define SPEC(type, name, id, value) type name = value;
  TYNDALL_PATH_SPEC(SPEC)
#undef SPEC
};

/// One statistical batch of samples for a list of pixels; path_io.h is the contract.
class PathPass {
public:
  /// @param rays casts the rays, where it is given, by ray queries; it must outlive the pass.
  PathPass(const gpu::Device& device, const PathSpec& spec, const gpu::AtlasImages& images,
           const gpu::AccelerationStructure* rays = nullptr);

  /// Runs `inputs.count` invocations and waits.
  void run(const interop::PathInputs& inputs) const { kernel_.run(inputs, inputs.count); }
  const gpu::Kernel& kernel() const { return kernel_; }

private:
  gpu::Kernel kernel_;
};

} // namespace tyndall::passes
