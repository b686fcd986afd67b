// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microbench/guiding_rows.h"
#include "gpu_scene/gpu_scene.h"
#include "render/renderer.h"
#include "scene/load.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace tyndall::microbench {

/// A scene file on the device, for any number of contestants.
class GuidingScene {
public:
  /// @param size of the picture.
  GuidingScene(const gpu::Device& device, const std::filesystem::path& path, glm::uvec2 size);

  std::string name() const { return path_.stem().string(); }
  /// The scene with what overrides of `render` and `guide` change. @throws Error
  scene::Scene with(const std::vector<scene::Override>& overrides) const;
  const gpu_scene::VolumeSet& volumes() const { return volumes_; }
  const gpu_scene::GpuScene& gpuScene() const { return *gpuScene_; }

private:
  std::filesystem::path path_;
  scene::Scene scene_;
  gpu_scene::VolumeSet volumes_;
  std::unique_ptr<gpu_scene::GpuScene> gpuScene_;
};

/// One way to draw directions in one scene, its pipeline made and warm. Borrows device and scene.
class GuidingRun {
public:
  GuidingRun(std::string name, const gpu::Device& device, const GuidingScene& scene, scene::Scene settings);

  /// Renders the picture, learning included: the store is empty when it begins. Kept in figures().
  void render(std::uint32_t samples, std::uint32_t seed);
  const RunFigures& figures() const { return figures_; }

private:
  void makeStore();
  render::GuidePlan plan() const;
  void keep(const render::RenderReport& report);

  const gpu::Device* device_;
  const GuidingScene* scene_;
  scene::Scene settings_;
  std::shared_ptr<guide::Store> store_; ///< null: nothing is guided
  std::unique_ptr<render::Estimator> estimator_;
  RunFigures figures_;
  std::uint64_t guided_ = 0; ///< of all renders
  std::uint64_t vertices_ = 0;
};

} // namespace tyndall::microbench
