// SPDX-License-Identifier: Apache-2.0
#include "scene/auto_scene.h"

#include "light/blackbody.h"
#include "light/sky.h"
#include "math/colour.h"
#include "scene/auto_framing.h"
#include "scene/camera_frame.h"
#include "volume/depth.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

namespace tyndall::scene {
namespace {

constexpr double kOpticalDepth = 5.0;       // median: opaque in the middle, soft at the edge
constexpr double kOpticalDepthOfFire = 3.5; // ... and less where something glows inside
constexpr unsigned kDepthLines = 400;
constexpr double kCameraAzimuth = 32.0;   // degrees from +z towards +x: a three-quarter view
constexpr double kCameraElevation = -8.0; // a little from below: the subject stands against the sky
constexpr double kElevationOfFlat = 22.0;
constexpr double kFlat = 0.45;       // height over width
constexpr double kSunAzimuth = 55.0; // degrees from the camera's, over the viewer's left shoulder
constexpr double kSunElevation = 40.0;
constexpr double kTurbidity = 2.0;
constexpr double kSun = 48.0;           // W/m2 above the atmosphere
constexpr double kSky = 7.0;            // lower than the sun's: single scattering leaves the subject too dark
constexpr double kDusk = 0.12;          // of both, when the subject glows itself
constexpr double kGlow = 0.6;           // luminance of the stronger glowing rays, W/(m2 sr)
constexpr std::size_t kStrongRays = 12; // of 32 x 32
constexpr double kPlainGlow = 0.3;      // of the brightest ray
constexpr double kClearlyMore = 1.2;    // glow that is worth another view
constexpr double kLargestScale = 1e15;  // what a scene file takes

glm::dvec3 directionFrom(double azimuthDegrees, double elevationDegrees) {
  const double azimuth = glm::radians(azimuthDegrees);
  const double elevation = glm::radians(elevationDegrees);
  return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation), std::cos(azimuth) * std::cos(elevation)};
}

bool nameHas(const AutoInput& input, std::initializer_list<const char*> words) {
  std::string names = std::filesystem::path(input.file).filename().string() + " " + input.grids.density;
  std::transform(names.begin(), names.end(), names.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return names.find(word) != std::string::npos; });
}

bool holdsSomething(const volume::BrickGrid* grid) {
  return grid != nullptr && !grid->empty() && grid->maximum() > 0.0f;
}

Medium makeMedium(const AutoInput& input) {
  Medium medium;
  medium.name = "volume";
  medium.file = input.file;
  medium.grid = input.grids.density.empty() ? "none" : input.grids.density;
  if (input.up == UpAxis::Z) {
    medium.worldFromMedium = glm::rotate(glm::dmat4(1.0), glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0));
  }
  const bool smoke = nameHas(input, {"smoke", "soot"});
  medium.albedo = !input.grids.temperature.empty() ? glm::dvec3(0.7) // soot: fire shows through little white
                  : smoke                          ? glm::dvec3(0.86, 0.85, 0.84)
                                                   : glm::dvec3(0.99);
  medium.phase.id = PhaseId::TwoLobe;
  medium.phase.parameters = {0.6, -0.3, 0.6, 0.0};
  return medium;
}

/// Scales the density; fills in the frame that decides.
void scaleDensity(const AutoInput& input, AutoScene& result) {
  double densest = 0.0;
  for (std::size_t i = 0; i < input.frames.size(); ++i) {
    const double median = holdsSomething(input.frames[i].density)
                              ? volume::medianOpticalDepth(*input.frames[i].density, kDepthLines)
                              : 0.0;
    if (median > densest) {
      densest = median;
      result.densestFrame = i;
    }
  }
  Medium& medium = result.scene.media.front();
  if (densest > 0.0) {
    const double standard = input.grids.temperature.empty() ? kOpticalDepth : kOpticalDepthOfFire;
    medium.densityScale = input.opticalDepth.value_or(standard) / densest;
  }
  medium.densityScale = input.densityScale.value_or(medium.densityScale);
  result.medianOpticalDepth = densest * medium.densityScale;
  if (densest > 0.0) {
    result.notes.push_back(
        fmt::format("median optical depth {:.3g} at density scale {:.4g} (override with --density-scale)",
                    result.medianOpticalDepth, medium.densityScale));
  }
}

/// Kelvin from the temperature grid's values: one mapping for all frames, so that a sequence does not flicker.
void addEmission(const AutoInput& input, AutoScene& result) {
  double hottest = 0.0;
  for (const AutoFrame& frame : input.frames) {
    hottest = std::max(hottest, holdsSomething(frame.temperature) ? double(frame.temperature->maximum()) : 0.0);
  }
  if (hottest <= 0.0) {
    return;
  }
  Emission emission;
  emission.kind = Emission::Kind::Blackbody;
  emission.grid = input.grids.temperature;
  emission.temperatureAuto = false;
  if (hottest < light::kColdestGlow) {
    emission.temperatureScale = light::kMappedMaximum / hottest;
    result.notes.push_back(fmt::format("grid '{}' is not in kelvin (maximum {:.4g}): its maximum is taken as {:.0f} K "
                                       "(override with --set media.0.emission.temperature_scale=...)",
                                       emission.grid, hottest, light::kMappedMaximum));
  }
  result.scene.media.front().emission = emission;
}

std::vector<VisibleVolume> visibleVolumes(const AutoInput& input, const Medium& medium) {
  std::vector<VisibleVolume> volumes;
  for (const AutoFrame& frame : input.frames) {
    VisibleVolume volume;
    volume.density = holdsSomething(frame.density) ? frame.density : nullptr;
    volume.temperature = medium.emission && holdsSomething(frame.temperature) ? frame.temperature : nullptr;
    volume.worldFromMedium = medium.worldFromMedium;
    volume.densityScale = medium.densityScale;
    if (volume.temperature != nullptr) {
      volume.glow = glowTable(medium.emission->temperatureScale, double(volume.temperature->maximum()));
    }
    volumes.push_back(volume);
  }
  return volumes;
}

/// Glow at an emission scale of 1 along 32 x 32 rays of the picture's middle, of all frames; strongest first, without
/// the rays that have none.
std::vector<double> glowsSeen(const std::vector<VisibleVolume>& volumes, const Camera& camera) {
  constexpr int kEdge = 32;
  const auto [forward, right, up] = cameraFrame(camera);
  const double half = std::tan(glm::radians(0.5 * camera.verticalFov));
  std::vector<double> glows;
  for (const VisibleVolume& volume : volumes) {
    for (int i = 0; i < kEdge * kEdge; ++i) {
      const glm::dvec2 place = half * ((glm::dvec2(i % kEdge, i / kEdge) + 0.5) * (2.0 / kEdge) - 1.0);
      const double glow = glowAlong(volume, camera.position, glm::normalize(forward + place.x * right + place.y * up));
      if (glow > 0.0) {
        glows.push_back(glow);
      }
    }
  }
  std::sort(glows.begin(), glows.end(), std::greater<>());
  return glows;
}

/// The emission scale at which the stronger rays of the picture get the luminance kGlow: about one in a hundred, for
/// hot cores are small, but none that is faint beside the brightest.
double glowScale(const std::vector<double>& glows) {
  if (glows.empty()) {
    return 1.0;
  }
  const double strong =
      std::max(glows[std::min<std::size_t>(kStrongRays, glows.size() - 1)], kPlainGlow * glows.front());
  return std::min(kGlow / strong, kLargestScale);
}

/// Of the four three-quarter views the one that shows most of the glow (a fire may lie behind its smoke); the first one
/// without any. The square root keeps one hot spot from outweighing a face that glows. Degrees.
double cameraAzimuth(const FramingInput& framing, double elevation) {
  const auto glows = [](const VisibleVolume& volume) { return volume.temperature != nullptr; };
  const bool any = std::any_of(framing.frames.begin(), framing.frames.end(), glows);
  const std::optional<Camera> first = any ? frameSubject(framing) : std::nullopt;
  double best = kCameraAzimuth;
  double most = 0.0;
  for (int quarter = 0; first && quarter < 4; ++quarter) {
    const double azimuth = kCameraAzimuth + 90.0 * quarter;
    Camera camera = *first;
    camera.position = camera.target + glm::distance(first->position, first->target) * directionFrom(azimuth, elevation);
    double sum = 0.0;
    for (const double glow : glowsSeen(framing.frames, camera)) {
      sum += std::sqrt(glow);
    }
    if (sum > kClearlyMore * most) {
      best = azimuth;
      most = sum;
    }
  }
  return best;
}

/// Seen level, a flat thing hides its shape: it is seen from above, unless its name says that it floats.
double cameraElevation(const AutoInput& input, const Medium& medium) {
  Bounds3 bounds;
  for (const AutoFrame& frame : input.frames) {
    if (holdsSomething(frame.density)) {
      bounds.extend(transformed(medium.worldFromMedium, frame.density->worldBounds()));
    }
  }
  const glm::dvec3 size = bounds.empty() ? glm::dvec3(1.0) : bounds.size();
  const bool flat = size.y < kFlat * std::max(size.x, size.z);
  return flat && !nameHas(input, {"cloud", "cumul", "sky"}) ? kElevationOfFlat : kCameraElevation;
}

std::vector<NamedLight> makeLights(bool glows, double cameraAzimuthDegrees) {
  const glm::dvec3 toSun = directionFrom(cameraAzimuthDegrees - kSunAzimuth, kSunElevation);
  const double strength = glows ? kDusk : 1.0;
  SunLight sun;
  SkyEnvironment sky;
  sun.direction = -toSun;
  sun.irradiance = strength * kSun * light::makeSky(-toSun, kTurbidity, glm::dvec3(0.0), {1, 2}).sunTransmittance;
  sky.sunDirection = -toSun;
  sky.turbidity = kTurbidity;
  sky.groundAlbedo = glm::dvec3(0.12, 0.13, 0.12); // dark fields: the subject stands out
  sky.scale = strength * kSky;
  return {{"sun", sun, false}, {"sky", sky, true}};
}

} // namespace

AutoScene makeAutoScene(const AutoInput& input) {
  AutoScene result;
  Scene& scene = result.scene;
  scene.name = std::filesystem::path(input.file).stem().string();
  scene.film.size = input.size;
  scene.film.view = View::Filmic;
  scene.film.transparent = true;
  scene.media.push_back(makeMedium(input));
  scaleDensity(input, result);
  addEmission(input, result);

  FramingInput framing{visibleVolumes(input, scene.media.front()), {}, input.size};
  const double elevation = cameraElevation(input, scene.media.front());
  framing.toCamera = directionFrom(kCameraAzimuth, elevation);
  const double azimuth = cameraAzimuth(framing, elevation);
  framing.toCamera = directionFrom(azimuth, elevation);
  if (const std::optional<Camera> camera = frameSubject(framing)) {
    scene.camera = *camera;
  } else {
    result.empty = true;
    scene.camera.position = scene.camera.target + 5.0 * framing.toCamera;
  }
  if (std::optional<Emission>& emission = scene.media.front().emission) {
    emission->scale = glowScale(glowsSeen(framing.frames, scene.camera));
  }
  scene.lights = makeLights(scene.media.front().emission.has_value(), azimuth);
  return result;
}

} // namespace tyndall::scene
