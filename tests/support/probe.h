// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/buffer.h"
#include "gpu/device.h"
#include "gpu/kernel.h"

#include <span>
#include <utility>
#include <vector>

/// Probes: small kernels that map arrays through functions of the shader library, always under the validation layer.
namespace tyndall::test {

/// The process's one device, made with the validation layer on first use.
const gpu::Device& probeDevice();

/// Specialization constants by id.
using Spec = std::vector<gpu::SpecEntry>;

class ProbeRunner {
public:
  explicit ProbeRunner(std::span<const std::uint32_t> spirv, const Spec& spec = {});

  /// Runs `count` invocations; any validation message is a test failure.
  template <class Push> void run(const Push& push, std::uint32_t count) const {
    kernel_.run(push, count);
    reportMessages();
  }

  /// For probes whose push constants are (inputs, outputs, count): `outputsPerInput` results for each input.
  template <class Out, class In>
  std::vector<Out> map(const std::vector<In>& inputs, std::size_t outputsPerInput = 1) const {
    struct Push {
      interop::Ptr<In> inputs;
      interop::Ptr<Out> outputs;
      std::uint32_t count;
    };
    const gpu::Buffer<In> in(probeDevice(), std::span<const In>(inputs));
    const gpu::Buffer<Out> out(probeDevice(), inputs.size() * outputsPerInput, gpu::Memory::Host);
    run(Push{in.ptr(), out.ptr(), static_cast<std::uint32_t>(inputs.size())}, static_cast<std::uint32_t>(inputs.size()));
    return download(out);
  }

  template <class T> static gpu::Buffer<T> upload(const std::vector<T>& values) {
    return gpu::Buffer<T>(probeDevice(), std::span<const T>(values));
  }
  template <class T> static gpu::Buffer<T> results(std::size_t count) {
    return gpu::Buffer<T>(probeDevice(), count, gpu::Memory::Host);
  }
  template <class T> static std::vector<T> download(const gpu::Buffer<T>& buffer) {
    const std::span<T> mapped = buffer.mapped();
    return {mapped.begin(), mapped.end()};
  }

private:
  void reportMessages() const;

  gpu::Kernel kernel_;
};

} // namespace tyndall::test
