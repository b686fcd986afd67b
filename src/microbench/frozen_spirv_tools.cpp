// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "microbench/frozen.h"

#include <spirv-tools/optimizer.hpp>

#include <string>
#include <unordered_map>

namespace tyndall::microbench {

std::vector<std::uint32_t> frozenModule(std::span<const std::uint32_t> module, std::span<const gpu::SpecEntry> spec) {
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> values;
  for (const gpu::SpecEntry& entry : spec) {
    values[entry.id] = {entry.bits};
  }
  std::string messages;
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_3);
  optimizer.SetMessageConsumer([&](spv_message_level_t level, const char*, const spv_position_t&, const char* text) {
    if (level <= SPV_MSG_ERROR) {
      messages += std::string(text) + "\n";
    }
  });
  optimizer.RegisterPass(spvtools::CreateStripDebugInfoPass())
      .RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values))
      .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
      .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
      .RegisterPass(spvtools::CreateSimplificationPass())
      .RegisterPass(spvtools::CreateDeadBranchElimPass())
      .RegisterPass(spvtools::CreateCCPPass())
      .RegisterPass(spvtools::CreateSimplificationPass())
      .RegisterPass(spvtools::CreateDeadBranchElimPass())
      .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
      .RegisterPass(spvtools::CreateAggressiveDCEPass())
      .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
      .RegisterPass(spvtools::CreateAggressiveDCEPass())
      .RegisterPass(spvtools::CreateCompactIdsPass());
  spvtools::OptimizerOptions options;
  options.set_run_validator(true);
  std::vector<std::uint32_t> frozen;
  spvtools::ValidatorOptions validation;
  validation.SetScalarBlockLayout(true);
  options.set_validator_options(validation);
  if (!optimizer.Run(module.data(), module.size(), &frozen, options)) {
    fail("SPIRV-Tools cannot fold the specialization constants of a module: {}", messages);
  }
  return frozen;
}

} // namespace tyndall::microbench
