// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math/bounds.h"
#include "phase/list.h"

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
  enum class Kind { Perspective, Orthographic };
  Kind kind = Kind::Perspective;
  glm::dvec3 position{0.0, 0.0, 5.0};
  glm::dvec3 target{0.0};
  glm::dvec3 up{0.0, 1.0, 0.0};
  double verticalFov = 40.0;     ///< degrees, full angle (perspective)
  double height = 2.0;           ///< scene units seen from top to bottom (orthographic)
};

enum class View { Standard, Filmic };

struct FilmSettings {
  glm::uvec2 size{640, 480};
  double exposure = 0.0;         ///< stops, for the PNG only
  View view = View::Standard;    ///< for the PNG only
  bool transparent = false;      ///< EXR: background left out of R, G, B and kept in its own layer
};

struct Phase {
  PhaseId id = PhaseId::Isotropic;
  std::array<double, 4> parameters{};  ///< in the order of phase/list.h
};

enum class MediumShape { Unbounded, Box, Sphere };

/// Emission coefficient j in W/(m3 sr) per unit scale.
struct Emission {
  enum class Kind { Linear, Blackbody };
  Kind kind = Kind::Linear;
  std::string grid;                    ///< name in the medium's file; empty: constant over a homogeneous medium
  glm::dvec3 colour{1.0};              ///< linear: j = scale * value * colour; blackbody: multiplies the spectrum's RGB
  double scale = 1.0;
  double temperatureScale = 1.0;       ///< kelvin = scale * value + offset (blackbody)
  double temperatureOffset = 0.0;
  bool temperatureAuto = true;         ///< scale 1 and offset 0, but a maximum too cold to glow: mapped to 2000 K
  double temperature = 0.0;            ///< kelvin, homogeneous blackbody
  bool tiedToAbsorption = false;       ///< j = sigma_a * emission instead of j = emission
};

struct Medium {
  std::string name;
  glm::dmat4 worldFromMedium{1.0};
  glm::dvec3 albedo{1.0};              ///< sigma_s / sigma_t, in [0, 1]
  Phase phase;
  std::optional<Emission> emission;

  // Homogeneous: file is empty.
  MediumShape shape = MediumShape::Unbounded;
  double sigmaT = 1.0;                 ///< extinction, 1 / scene unit
  Bounds3 box;                         ///< in medium space
  glm::dvec3 centre{0.0};              ///< sphere, in medium space
  double radius = 1.0;

  // Grid.
  std::string file;                    ///< .vdb, absolute or relative to the working folder once loaded
  std::string grid;                    ///< density grid's name; empty: chosen automatically; "none": emission only
  double densityScale = 1.0;           ///< sigma_t per unit of density, 1 / scene unit
  std::optional<Bounds3> clip;         ///< in the volume file's world space
  std::string storage = "auto";        ///< auto, unorm8, half, float
  bool background = false;             ///< keep the file's background value

  bool homogeneous() const { return file.empty(); }
};

struct PointLight {
  glm::dvec3 position{0.0};
  glm::dvec3 intensity{1.0};           ///< W / sr
};

struct SunLight {
  glm::dvec3 direction{0.0, -1.0, 0.0};  ///< the way its light travels; unit length once loaded
  glm::dvec3 irradiance{1.0};            ///< W / m2 on a plane perpendicular to it
  double angularDiameter = 0.53;         ///< degrees; 0 = a delta direction
};

struct ConstantEnvironment {
  glm::dvec3 radiance{1.0};            ///< W / (m2 sr)
};

struct MapEnvironment {
  std::string file;                    ///< lat-long EXR; the middle column looks along -z, the top row up (+y)
  double scale = 1.0;
  double rotation = 0.0;               ///< degrees about +y
};

/// Clear sky, a lat-long map made on load (light/sky.h).
struct SkyEnvironment {
  glm::dvec3 sunDirection{0.0, -1.0, 0.0}; ///< the way the sun's light travels
  double turbidity = 3.0;                  ///< haze, 1 (pure air) to 10
  glm::dvec3 groundAlbedo{0.3};
  double scale = 1.0;                      ///< 1: the sun above the atmosphere has irradiance 1 W/m2 per channel
};

using Light = std::variant<PointLight, SunLight, ConstantEnvironment, MapEnvironment, SkyEnvironment>;

struct NamedLight {
  std::string name;
  Light light;
  bool visible = true;                 ///< seen directly by the camera (sun disc and environments)
};

struct RenderSettings {
  std::uint32_t samples = 64;          ///< per pixel
  std::uint32_t seed = 0;
  std::uint32_t depth = 1;             ///< scattering events
};

struct Scene {
  std::string name;
  Camera camera;
  FilmSettings film;
  RenderSettings render;
  std::vector<Medium> media;
  std::vector<NamedLight> lights;
};

} // namespace tyndall::scene
