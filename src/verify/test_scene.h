// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu_scene/volumes.h"
#include "scene/scene.h"
#include "volume/load.h"

#include <functional>
#include <string>
#include <vector>

/// Small scenes made by hand, in memory alone.
namespace tyndall::verify {

/// A scene together with its grids; grid media name no file.
struct TestScene {
  scene::Scene scene;
  gpu_scene::VolumeSet volumes;

  explicit TestScene(const glm::uvec2& size = {16, 16});

  void orthographic(const glm::dvec3& position, const glm::dvec3& target, double height);
  void perspective(const glm::dvec3& position, const glm::dvec3& target, double verticalFov);
  scene::Medium& box(const glm::dvec3& low, const glm::dvec3& high, double sigmaT, double albedo = 1.0);
  scene::Medium& sphere(const glm::dvec3& centre, double radius, double sigmaT, double albedo = 1.0);
  scene::Medium& grid(const volume::BrickGrid& density, double densityScale = 1.0, double albedo = 1.0);
  /// Adds a grid of emission to the last medium.
  void emissionGrid(const volume::BrickGrid& values, const scene::Emission& emission);
  void point(const glm::dvec3& position, double intensity = 1.0);
  void sun(const glm::dvec3& direction, double irradiance = 1.0, double angularDiameter = 0.0);
  void constant(double radiance, bool visible = true);
};

/// A TestScene with materials and objects. Paths are of unlimited length unless `depth` says otherwise.
struct PathScene : TestScene {
  explicit PathScene(const glm::uvec2& size = {16, 16});

  void depth(std::uint32_t events) { scene.render.depth = events; }
  /// Adds a material; objects name it. `colour`: see geometry::Material.
  geometry::Material& material(const std::string& name, MaterialId model, double colour = 0.0);
  /// A black material that shines on its front.
  geometry::Material& lamp(const std::string& name, double radiance);
  /// Front: the side of cross(edgeU, edgeV).
  scene::Object& quad(const std::string& material, const glm::dvec3& origin, const glm::dvec3& edgeU,
                      const glm::dvec3& edgeV);
  scene::Object& ball(const std::string& material, const glm::dvec3& centre, double radius);
  scene::Object& crate(const std::string& material, const glm::dvec3& low, const glm::dvec3& high);
  scene::Object& mesh(const std::string& material, const geometry::Mesh& mesh);
  /// The closed object that was added last holds a medium of its own.
  scene::Medium& fill(double sigmaT, double albedo = 1.0);
  void spot(const scene::SpotLight& light);

private:
  scene::Object& object(const std::string& material, scene::Object::Kind kind);
};

scene::Phase henyeyGreenstein(double g);

/// A value for every voxel of a grid.
using VoxelFunction = std::function<double(const glm::ivec3&)>;

/// A grid of `size` voxels from index `first` on.
volume::BrickGrid gridOf(const glm::ivec3& size, const glm::ivec3& first, const glm::dmat4& worldFromIndex,
                         const VoxelFunction& value, volume::Storage storage = volume::Storage::Float);

/// `count`^3 equal voxels whose outermost voxel *centres* lie on the faces of [low, high]; outside, the field falls to
/// 0 over one voxel.
volume::BrickGrid constantGrid(int count, const glm::dvec3& low, const glm::dvec3& high, double value,
                               volume::Storage storage = volume::Storage::Float);

/// A puff without symmetry in [-1, 1]^3, depth about 1 through its middle; index `first` is its first voxel.
inline constexpr int kPuffVoxels = 14;
volume::BrickGrid puffGrid(const glm::ivec3& first = glm::ivec3(0), volume::Storage storage = volume::Storage::Float);
/// Its density at an index from 0 to kPuffVoxels - 1.
double puffDensity(const glm::dvec3& index);

/// A map with a name, for tests that must hold under any.
struct NamedMap {
  std::string name;
  glm::dmat4 worldFromIndex;
};
/// Identity, translated, rotated, sheared, non-uniform, mirrored and all at once; a grid of `size` voxels stays within
/// a few `size` units of the origin.
std::vector<NamedMap> affineMaps();

} // namespace tyndall::verify
