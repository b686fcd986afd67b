// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/model.h"
#include "math/bounds.h"
#include "phase/list.h"
#include "scene/guide_settings.h"
#include "scene/json.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

/// What is rendered, as plain values with units. Made by load.h from JSON or by auto_scene.h from a bare volume.
/// Valid once made: nothing downstream checks ranges again. docs/scene-format.md is the users' page.
namespace tyndall::scene {

/// Looking along -z of its own frame, y up. All lengths in scene units.
struct Camera {
  /// File stands in scene files only: once loaded, a scene has the camera that the mesh file holds.
  enum class Kind { Perspective, Orthographic, File };
  Kind kind = Kind::Perspective;
  glm::dvec3 position{0.0, 0.0, 5.0};
  glm::dvec3 target{0.0};
  glm::dvec3 up{0.0, 1.0, 0.0};
  double verticalFov = 40.0;  ///< degrees, full angle (perspective)
  double height = 2.0;        ///< scene units seen from top to bottom (orthographic)
  double lensRadius = 0.0;    ///< scene units; 0 = a pinhole (perspective)
  std::string file;           ///< a glTF file with cameras
  std::string name;           ///< of the camera in it; empty: its first one
  double focusDistance = 1.0; ///< scene units from the lens to the plane in focus, along the view direction
};

enum class View { Standard, Filmic };

struct FilmSettings {
  glm::uvec2 size{640, 480};
  double exposure = 0.0;      ///< stops, for the PNG only
  View view = View::Standard; ///< for the PNG only
  bool transparent = false;   ///< EXR: background left out of R, G, B and kept in its own layer
};

struct Phase {
  PhaseId id = PhaseId::Isotropic;
  std::array<double, 4> parameters{}; ///< in the order of phase/list.h
};

/// Objects: inside the closed objects that name the medium.
enum class MediumShape { Unbounded, Box, Sphere, Objects };

/// Emission coefficient j in W/(m3 sr) per unit scale.
struct Emission {
  enum class Kind { Linear, Blackbody };
  Kind kind = Kind::Linear;
  std::string grid;       ///< name in the medium's file; empty: constant over a homogeneous medium
  glm::dvec3 colour{1.0}; ///< linear: j = scale * value * colour; blackbody: multiplies the spectrum's RGB
  double scale = 1.0;
  double temperatureScale = 1.0; ///< kelvin = scale * value + offset (blackbody)
  double temperatureOffset = 0.0;
  bool temperatureAuto = true;   ///< scale 1 and offset 0, but a maximum too cold to glow: mapped to 2000 K
  double temperature = 0.0;      ///< kelvin, homogeneous blackbody
  bool tiedToAbsorption = false; ///< j = sigma_a * emission instead of j = emission
};

struct Medium {
  std::string name;
  glm::dmat4 worldFromMedium{1.0};
  std::vector<glm::dmat4> instances; ///< worldFromWorld of each copy, after worldFromMedium; empty: one, as it is
  glm::dvec3 albedo{1.0};            ///< sigma_s / sigma_t, in [0, 1]
  glm::dvec3 extinctionColour{1.0};  ///< factors of the extinction per channel, [0, 1]
  Phase phase;
  std::optional<Emission> emission;

  // Homogeneous: file is empty.
  MediumShape shape = MediumShape::Unbounded;
  double sigmaT = 1.0;    ///< extinction, 1 / scene unit
  Bounds3 box;            ///< in medium space
  glm::dvec3 centre{0.0}; ///< sphere, in medium space
  double radius = 1.0;

  // Grid.
  std::string file;             ///< .vdb, absolute or relative to the working folder once loaded
  std::string grid;             ///< density grid's name; empty: chosen automatically; "none": emission only
  double densityScale = 1.0;    ///< sigma_t per unit of density, 1 / scene unit
  std::optional<Bounds3> clip;  ///< in the volume file's world space
  std::string storage = "auto"; ///< auto, unorm8, half, float
  bool background = false;      ///< keep the file's background value

  bool homogeneous() const { return file.empty(); }
};

struct PointLight {
  glm::dvec3 position{0.0};
  glm::dvec3 intensity{1.0}; ///< W / sr
};

/// Shines within a cone; between the inner and the outer angle it falls off smoothly.
struct SpotLight {
  glm::dvec3 position{0.0};
  glm::dvec3 direction{0.0, -1.0, 0.0}; ///< the way its light travels; unit length once loaded
  glm::dvec3 intensity{1.0};            ///< W / sr along the axis
  double outerAngle = 30.0;             ///< degrees, half angle
  double innerAngle = 20.0;             ///< degrees, half angle, at most the outer one
};

struct SunLight {
  glm::dvec3 direction{0.0, -1.0, 0.0}; ///< the way its light travels; unit length once loaded
  glm::dvec3 irradiance{1.0};           ///< W / m2 on a plane perpendicular to it
  double angularDiameter = 0.53;        ///< degrees; 0 = a delta direction
};

struct ConstantEnvironment {
  glm::dvec3 radiance{1.0}; ///< W / (m2 sr)
};

struct MapEnvironment {
  std::string file; ///< lat-long EXR; the middle column looks along -z, the top row up (+y)
  double scale = 1.0;
  double rotation = 0.0; ///< degrees about +y
};

/// Clear sky, a lat-long map made on load (light/sky.h).
struct SkyEnvironment {
  glm::dvec3 sunDirection{0.0, -1.0, 0.0}; ///< the way the sun's light travels
  double turbidity = 3.0;                  ///< haze, 1 (pure air) to 10
  glm::dvec3 groundAlbedo{0.3};
  double scale = 1.0; ///< 1: the sun above the atmosphere has irradiance 1 W/m2 per channel
};

using Light = std::variant<PointLight, SunLight, ConstantEnvironment, MapEnvironment, SkyEnvironment, SpotLight>;

struct NamedLight {
  std::string name;
  Light light;
  bool visible = true; ///< seen directly by the camera (sun disc and environments)
};

struct RenderSettings {
  std::uint32_t samples = 64; ///< per pixel
  std::uint32_t seed = 0;
  std::optional<std::uint32_t> depth; ///< scattering events, 0 = unlimited; empty: 1 without objects, else unlimited
  Integrator integrator = Integrator::Path;
  bool lightSampling = true; ///< false: lights that have a size are found by directions alone
  bool deterministic = false; ///< guided pictures repeat bit for bit too
};

/// A surface, or several. Its triangles have their file's materials unless `material` names one of the scene's.
struct Object {
  enum class Kind { Mesh, Quad, Box, Sphere };
  std::string name;
  Kind kind = Kind::Mesh;
  glm::dmat4 worldFromObject{1.0};
  std::vector<glm::dmat4> instances; ///< worldFromWorld of each copy, after worldFromObject; empty: one, as it is
  std::string material;              ///< name in Scene::materials; empty: the file's own, or white diffuse
  std::string medium;                ///< name of the homogeneous medium inside; empty: none
  std::uint32_t priority = 0;        ///< where refracting objects overlap, the highest decides
  bool lights = true;                ///< mesh: take the file's punctual lights too

  std::string file;                  ///< mesh
  glm::dvec3 origin{-1.0, 0.0, 1.0}; ///< quad: a corner
  glm::dvec3 edgeU{2.0, 0.0, 0.0};   ///< quad: its front is the side of cross(edgeU, edgeV)
  glm::dvec3 edgeV{0.0, 0.0, -2.0};
  Bounds3 box;            ///< box: object space; faces outwards
  glm::dvec3 centre{0.0}; ///< sphere
  double radius = 1.0;
};

enum class Interpolation { Linear, Step };

struct Key {
  double frame = 0.0;
  json::Value value; ///< of the track's target at that frame
};

/// Moves one value of a scene file. It is held before the first and after the last key.
struct Track {
  std::string target; ///< path, as for an Override
  Interpolation interpolation = Interpolation::Linear;
  std::vector<Key> keys; ///< at least one, frames ascending

  bool movesFileName() const { return target.ends_with(".file"); }
};

struct Animation {
  /// A camera, medium or object that a track moves. Its values in a Scene are composed and settled; to write it out,
  /// what the tracks name must be there, such as the steps of its transform.
  struct Element {
    std::string path; ///< "objects.2"
    json::Value value;
  };
  double framesPerSecond = 24.0;
  std::vector<Track> tracks; ///< already applied: a Scene is that of one frame
  double seconds = 0.0;      ///< of that frame, for the animations of glTF files
  std::vector<Element> elements;
};

struct Scene {
  std::string name;
  Camera camera;
  FilmSettings film;
  RenderSettings render;
  GuideSettings guide; ///< of render.integrator
  std::vector<Medium> media;
  std::vector<NamedLight> lights;
  std::vector<geometry::Material> materials; ///< unique names; no textures
  std::vector<Object> objects;
  Animation animation;

  /// Scattering events at most, 0 = unlimited.
  std::uint32_t depth() const { return render.depth.value_or(objects.empty() ? 1 : 0); }
};

} // namespace tyndall::scene
