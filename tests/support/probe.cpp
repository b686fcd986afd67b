// SPDX-License-Identifier: Apache-2.0
#include "support/probe.h"

#include <gtest/gtest.h>

namespace tyndall::test {

const gpu::Device& probeDevice() {
  static const gpu::Device device(gpu::DeviceOptions{.select = {}, .validation = true, .pipelineCache = {}});
  return device;
}

ProbeRunner::ProbeRunner(std::span<const std::uint32_t> spirv, const Spec& spec)
    : kernel_(probeDevice(), spirv, spec) {
  reportMessages();
}

void ProbeRunner::reportMessages() const {
  static std::size_t reported = 0;
  const std::vector<std::string>& messages = probeDevice().messages();
  for (; reported < messages.size(); ++reported) {
    ADD_FAILURE() << "validation: " << messages[reported];
  }
}

} // namespace tyndall::test
