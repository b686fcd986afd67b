// SPDX-License-Identifier: Apache-2.0
#include "bench/skip_cases.h"

#include "bench/path_scenes.h"

namespace tyndall::bench {
namespace {

using passes::PathSpec;

constexpr std::uint32_t kAllModels = 0xffffffffu;
constexpr std::uint32_t kAllFormats = 7u;
constexpr int kRowOfClouds = 16;

template <bool PathSpec::*Flag>
void setFlag(PathSpec& spec, bool on) {
  spec.*Flag = on;
}

/// Without surfaces a scene has no materials either.
void setSurfaces(PathSpec& spec, bool on) {
  spec.kSurfaces = on;
  spec.kMaterialMask = on ? spec.kMaterialMask : 0u;
}

void setGrids(PathSpec& spec, bool on) {
  spec.kGrids = on;
  spec.kFormatMask = on ? kAllFormats : 0u;
}

void setFormats(PathSpec& spec, bool on) { spec.kFormatMask = on ? kAllFormats : spec.kFormatMask; }
void setPhases(PathSpec& spec, bool on) { spec.kPhaseMask = on ? kAllModels : spec.kPhaseMask; }
void setMaterials(PathSpec& spec, bool on) { spec.kMaterialMask = on ? kAllModels : spec.kMaterialMask; }

/// Everything that a scene may do without and have harmlessly: all but the tree of media, which would be empty, aiming
/// at lights, which needs some, and the orthographic camera. Off: what `Off` does.
template <void (*Off)(PathSpec&, bool)>
void setAll(PathSpec& spec, bool on) {
  if (!on) {
    Off(spec, false);
    return;
  }
  const PathSpec chosen = spec;
  spec = PathSpec{};
  spec.kMediumTree = chosen.kMediumTree;
  spec.kOrthographic = chosen.kOrthographic;
  spec.kAimed = chosen.kAimed;
}

void asChosen(PathSpec&, bool) {}

constexpr SkipCase kCases[] = {
    {"surfaces", kMistAndFarSurface, setSurfaces},
    {"grids", kMist, setGrids},
    {"chromatic extinction", kMist, setFlag<&PathSpec::kChromatic>},
    {"emission of media", kMist, setFlag<&PathSpec::kHomogeneousEmission>},
    {"emitters", kMist, setFlag<&PathSpec::kEmitters>},
    {"sun discs, environments", kMist, setFlag<&PathSpec::kDistantAreas>},
    {"phase functions, all", kMist, setPhases},
    {"lens", kMist, setFlag<&PathSpec::kLens>},
    {"all", kMistAndFarSurface, setAll<setSurfaces>},
    {"surfaces", kCloudAndFarSurface, setSurfaces},
    {"homogeneous media", kCloud, setFlag<&PathSpec::kHomogeneous>},
    {"texel formats, all", kCloud, setFormats},
    {"chromatic extinction", kCloud, setFlag<&PathSpec::kChromatic>},
    {"emission of grids", kCloud, setFlag<&PathSpec::kGridEmission>},
    {"all", kCloudAndFarSurface, setAll<setSurfaces>},
    {"tree of media", kCloudRow, setFlag<&PathSpec::kMediumTree>},
    {"homogeneous media", kBox, setFlag<&PathSpec::kHomogeneous>},
    {"grids", kBox, setGrids},
    {"materials, all", kBox, setMaterials},
    {"textures", kBox, setFlag<&PathSpec::kTextures>},
    {"spheres", kBox, setFlag<&PathSpec::kSpheres>},
    {"instances", kBox, setFlag<&PathSpec::kInstances>},
    {"passing surfaces", kBox, setFlag<&PathSpec::kPassing>},
    {"interiors", kBox, setFlag<&PathSpec::kInteriors>},
    {"volume emitters", kBox, setFlag<&PathSpec::kVolumeEmitters>},
    {"suns", kBox, setFlag<&PathSpec::kDistantDeltas>},
    {"sun discs, environments", kBox, setFlag<&PathSpec::kDistantAreas>},
    {"lens", kBox, setFlag<&PathSpec::kLens>},
    {"depth and albedo", kBox, setFlag<&PathSpec::kAovs>},
    {"counting", kBox, setFlag<&PathSpec::kCount>},
    {"all", kBox, setAll<asChosen>},
};

} // namespace

std::vector<SkipScene> skipScenes(const volume::BrickGrid& grid, double opticalDepth, std::uint32_t size) {
  BenchScene farMist = mistScene(size);
  addFarSurface(farMist);
  BenchScene cloud = sunScene(grid, opticalDepth, size);
  cloud.scene.render.depth = 0;
  BenchScene farCloud = cloud;
  addFarSurface(farCloud);
  BenchScene row = cloud;
  repeatMedium(row, kRowOfClouds);
  std::vector<SkipScene> scenes;
  scenes.push_back({"mist", mistScene(size)});
  scenes.push_back({"mist, far triangle", std::move(farMist)});
  scenes.push_back({"box", surfaceScene(boxScene(), size)});
  scenes.push_back({"cloud", std::move(cloud)});
  scenes.push_back({"cloud, far triangle", std::move(farCloud)});
  scenes.push_back({"16 clouds", std::move(row)});
  return scenes;
}

std::span<const SkipCase> skipCases() { return kCases; }

} // namespace tyndall::bench
