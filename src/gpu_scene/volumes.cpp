// SPDX-License-Identifier: Apache-2.0
#include "gpu_scene/volumes.h"

#include "base/error.h"
#include "volume/load.h"

#include <map>

namespace tyndall::gpu_scene {
namespace {

using volume::Storage;

constexpr float kLargestHalf = 65504.0f;

std::optional<Storage> storageNamed(const std::string& name) {
  for (const Storage storage : {Storage::Unorm8, Storage::Half, Storage::Float}) {
    if (name == volume::storageName(storage)) {
      return storage;
    }
  }
  return std::nullopt;
}

/// What one grid is loaded with; equal requests share one grid.
struct Request {
  std::string file;
  volume::LoadOptions options;
  bool automatic = true;

  std::string key() const {
    const Bounds3 clip = options.clip.value_or(Bounds3{});
    return fmt::format("{}|{}|{}|{}|{}|{},{},{}|{},{},{}", file, options.grid,
                       options.storage ? volume::storageName(*options.storage) : "auto", options.keepBackground,
                       options.signedValues, clip.min.x, clip.min.y, clip.min.z, clip.max.x, clip.max.y, clip.max.z);
  }
};

Request densityRequest(const scene::Medium& medium) {
  Request request{medium.file, {}, medium.storage == "auto"};
  request.options.grid = medium.grid;
  request.options.storage = storageNamed(medium.storage);
  request.options.clip = medium.clip;
  request.options.keepBackground = medium.background;
  return request;
}

Request emissionRequest(const scene::Medium& medium) {
  Request request = densityRequest(medium);
  request.options.grid = medium.emission->grid;
  request.options.keepBackground = false;
  // Degrees Celsius are negative in the cold.
  request.options.signedValues = medium.emission->kind == scene::Emission::Kind::Blackbody;
  return request;
}

class Loader {
public:
  explicit Loader(VolumeSet& set) : set_(set) {}

  std::size_t index(const Request& request) {
    const auto [place, fresh] = indices_.try_emplace(request.key(), set_.grids.size());
    if (fresh) {
      requests_.push_back(request);
      set_.grids.push_back(volume::loadGrid(request.file, request.options));
    }
    return place->second;
  }

  /// Loads the automatic grids again in a narrower format.
  void narrow(Storage storage) {
    for (std::size_t i = 0; i < requests_.size(); ++i) {
      const bool narrower = volume::bytesPerVoxel(set_.grids[i].storage) > volume::bytesPerVoxel(storage);
      const bool representable = storage != Storage::Half || set_.grids[i].maximum() <= kLargestHalf;
      if (requests_[i].automatic && narrower && representable) {
        requests_[i].options.storage = storage;
        set_.grids[i] = volume::loadGrid(requests_[i].file, requests_[i].options);
        set_.grids[i].report.notes.push_back(
            fmt::format("stored as {} to fit the memory budget (worst voxel error {:.2g} of the maximum)",
                        volume::storageName(storage), set_.grids[i].report.quantisationError));
      }
    }
  }

  void collectNotes() const {
    for (std::size_t i = 0; i < requests_.size(); ++i) {
      const volume::LoadReport& report = set_.grids[i].report;
      for (const std::string& note : report.notes) {
        add(i, note);
      }
      if (report.nonFiniteVoxels > 0) {
        add(i, fmt::format("warning: {} voxels are NaN or infinite and were set to 0", report.nonFiniteVoxels));
      }
      if (report.negativeVoxels > 0) {
        add(i, fmt::format("warning: {} voxels are negative and were set to 0", report.negativeVoxels));
      }
    }
  }

private:
  void add(std::size_t i, const std::string& note) const {
    set_.notes.push_back(fmt::format("{}: {}: {}", requests_[i].file, set_.grids[i].name, note));
  }

  VolumeSet& set_;
  std::map<std::string, std::size_t> indices_;
  std::vector<Request> requests_;
};

std::string sizes(const VolumeSet& set) {
  std::string text;
  for (const volume::BrickGrid& grid : set.grids) {
    text +=
        fmt::format("\n  {}: {:.1f} MB as {}", grid.name, grid.deviceBytes() * 1e-6, volume::storageName(grid.storage));
  }
  return text;
}

} // namespace

double VolumeSet::deviceBytes() const {
  double bytes = 0.0;
  for (const volume::BrickGrid& grid : grids) {
    bytes += grid.deviceBytes();
  }
  return bytes;
}

VolumeSet loadVolumes(const scene::Scene& scene, double memoryBudget) {
  VolumeSet set;
  Loader loader(set);
  for (const scene::Medium& medium : scene.media) {
    VolumeSet::Use use;
    if (!medium.homogeneous() && medium.grid != "none") {
      use.density = loader.index(densityRequest(medium));
    }
    if (!medium.homogeneous() && medium.emission && !medium.emission->grid.empty()) {
      use.emission = loader.index(emissionRequest(medium));
    }
    set.uses.push_back(use);
  }
  for (const Storage storage : {Storage::Half, Storage::Unorm8}) {
    if (set.deviceBytes() > memoryBudget) {
      loader.narrow(storage);
    }
  }
  if (set.deviceBytes() > memoryBudget) {
    fail("the volumes need {:.1f} MB on the device, the budget is {:.1f} MB; raise --memory, use a \"clip\" box or "
         "\"storage\": \"unorm8\":{}",
         set.deviceBytes() * 1e-6, memoryBudget * 1e-6, sizes(set));
  }
  loader.collectNotes();
  set.meshes = loadMeshes(scene);
  set.notes.insert(set.notes.end(), set.meshes.notes.begin(), set.meshes.notes.end());
  return set;
}

} // namespace tyndall::gpu_scene
