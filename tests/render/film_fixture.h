// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/renderer.h"
#include "support/probe.h"
#include "support/render_scenes.h"

namespace tyndall::test {

/// The film that the program would make of a scene, coverage mask and stopping included.
inline film::Film renderFilm(const TestScene& test, const render::RenderOptions& options, render::RenderReport* report = nullptr) {
  const gpu_scene::GpuScene gpuScene(probeDevice(), test.scene, test.volumes);
  render::RenderReport own;
  return render::renderFilm(probeDevice(), test.scene, test.volumes, gpuScene, options, report != nullptr ? *report : own);
}

} // namespace tyndall::test
