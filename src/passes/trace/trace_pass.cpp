// SPDX-License-Identifier: Apache-2.0
#include "passes/trace/trace_pass.h"

#include "kernels/trace.h"

#include <array>

namespace tyndall::passes {
namespace {

auto specEntries(const TraceSpec& spec) {
  return std::array{
#define SPEC(type, name, id, value) gpu::SpecEntry{id, gpu::specBits(spec.name)},
      TYNDALL_TRACE_SPEC(SPEC)
#undef SPEC
  };
}

} // namespace

TracePass::TracePass(const gpu::Device& device, const TraceSpec& spec, const gpu::AtlasImages& images)
    : kernel_(device, k_trace_spirv, specEntries(spec), images) {}

} // namespace tyndall::passes
