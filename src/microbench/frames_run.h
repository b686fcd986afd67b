// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "film/film.h"
#include "gpu_scene/gpu_scene.h"
#include "gpu_scene/motion.h"
#include "microbench/frames_room.h"
#include "render/estimator.h"
#include "scene/load.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tyndall::microbench {

/// One way to draw directions: overrides of `render` and `guide`.
struct FrameContender {
  std::string name;
  std::vector<scene::Override> overrides;
};

struct FrameOptions {
  glm::uvec2 size{48, 48};
  std::uint32_t samples = 8; ///< of a pixel and frame
  std::uint32_t seeds = 2;   ///< sequences side by side, each with chains of its own
  std::uint32_t firstSeed = 1;
};

/// What frames hand on to the next one.
struct FrameMemory {
  std::vector<guide::StoreContent> chains; ///< of each seed
  std::optional<gpu_scene::Pose> pose;
  std::optional<scene::Camera> camera;
  glm::dvec3 origin{0.0}; ///< of the chains' space,
  double unit = 0.0;      ///< ... and its length
};

/// The frames of sequences by one contender, one after the other, as `tyndall render --frames` renders them. Borrows
/// the device.
class FrameRun {
public:
  FrameRun(const gpu::Device& device, FrameContender contender, const FrameOptions& options)
      : device_(&device), contender_(std::move(contender)), options_(options) {}

  const std::string& name() const { return contender_.name; }
  /// The film of each seed. @throws Error
  std::vector<film::Film> render(const Sequence& sequence, int frame);
  const FrameMemory& memory() const { return memory_; }
  /// Goes on from there, or with nothing learnt and nothing known.
  void recall(FrameMemory memory);
  /// Of the frame rendered last.
  const scene::Scene& scene() const { return scene_; }

private:
  void prepare(const Sequence& sequence, int frame);
  void makeEstimator(int frame);
  void makeStore();
  film::Film renderSeed(std::uint32_t seed, int frame);

  const gpu::Device* device_;
  FrameContender contender_;
  FrameOptions options_;
  FrameMemory memory_;
  std::string moment_; ///< of the scene that the estimator was made for; empty: of another frame before
  scene::Scene scene_;
  gpu_scene::VolumeSet volumes_;
  std::unique_ptr<gpu_scene::GpuScene> gpuScene_;
  std::shared_ptr<guide::Store> store_; ///< null: nothing is guided
  std::unique_ptr<render::Estimator> estimator_;
};

/// A scene at a frame. @throws Error with all that is wrong in it
scene::Scene sceneAt(const Sequence& sequence, int frame, const std::vector<scene::Override>& overrides);
/// All that is in it, as text: the same where nothing has moved.
std::string momentOf(const scene::Scene& scene);

} // namespace tyndall::microbench
