// SPDX-License-Identifier: Apache-2.0
#include "volume/generate.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace tyndall::volume {
namespace {

/// 32-bit integer hash (Wellons' lowbias32): the same on every machine.
std::uint32_t hash(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

/// Uniform in [0, 1) per lattice point.
double lattice(const glm::ivec3& p, std::uint32_t seed) {
  const std::uint32_t x = hash(std::uint32_t(p.x) + seed * 0x9e3779b9u);
  return double(hash(std::uint32_t(p.z) + hash(std::uint32_t(p.y) + x))) / 4294967296.0;
}

/// Gradient noise, about [-1, 1], twice differentiable.
double noise(const glm::dvec3& p, std::uint32_t seed) {
  const glm::dvec3 corner = glm::floor(p);
  const glm::dvec3 f = p - corner;
  const glm::dvec3 s = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  double sum = 0.0;
  for (int i = 0; i < 8; ++i) {
    const glm::ivec3 step(i & 1, (i >> 1) & 1, i >> 2);
    const glm::ivec3 at = glm::ivec3(corner) + step;
    const glm::dvec3 slope(lattice(at, seed), lattice(at, seed + 1000u), lattice(at, seed + 2000u));
    const glm::dvec3 weight = glm::mix(1.0 - s, s, glm::dvec3(step));
    sum += weight.x * weight.y * weight.z * glm::dot(2.0 * slope - 1.0, f - glm::dvec3(step));
  }
  return 1.5 * sum;
}

/// The next octave's position: finer, and turned so that no lattice shows through.
glm::dvec3 nextOctave(const glm::dvec3& p) {
  return 2.03 * glm::dvec3(0.8 * p.x + 0.6 * p.z, 0.36 * p.x + 0.8 * p.y - 0.48 * p.z, -0.48 * p.x + 0.6 * p.y + 0.64 * p.z);
}

/// Sum of octaves, each half as large and twice as fine; about [-1, 1].
double fractal(glm::dvec3 p, std::uint32_t seed, int octaves) {
  double sum = 0.0;
  double amplitude = 0.5;
  for (int i = 0; i < octaves; ++i, amplitude *= 0.5, p = nextOctave(p)) {
    sum += amplitude * noise(p, seed + std::uint32_t(i));
  }
  return sum;
}

/// Octaves of rounded bumps with sharp creases between them: a cauliflower's surface, in [0, 1].
double billow(glm::dvec3 p, std::uint32_t seed, int octaves) {
  double sum = 0.0;
  double total = 0.0;
  double amplitude = 1.0;
  for (int i = 0; i < octaves; ++i, amplitude *= 0.55, p = nextOctave(p)) {
    sum += amplitude * std::abs(noise(p, seed + std::uint32_t(i)));
    total += amplitude;
  }
  return sum / total;
}

double smoothStep(double low, double high, double x) {
  const double s = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

/// What a model says about one point.
struct FieldSample {
  double density = 0.0;
  double temperature = 0.0;
  glm::dvec3 velocity{0.0};
};

/// Fills the fields that have been given room. `model` takes a position in metres.
template <class Model> void fill(GeneratedVolume& volume, const Model& model) {
  tbb::parallel_for(0, volume.size.z, [&](int z) {
    std::size_t at = std::size_t(volume.size.x) * volume.size.y * z;
    for (int y = 0; y < volume.size.y; ++y) {
      for (int x = 0; x < volume.size.x; ++x, ++at) {
        const FieldSample sample = model(volume.voxelSize * glm::dvec3(volume.indexMin + glm::ivec3(x, y, z)));
        volume.density[at] = float(sample.density);
        if (!volume.temperature.empty()) {
          volume.temperature[at] = float(sample.temperature);
        }
        if (!volume.velocity.empty()) {
          volume.velocity[at] = glm::vec3(sample.velocity);
        }
      }
    }
  });
}

/// Velocities to 1/64 m/s: finer digits of a made-up field would only fill the file.
glm::dvec3 coarsened(const glm::dvec3& velocity) { return glm::round(velocity * 64.0) / 64.0; }

FieldSample plumeAt(const glm::dvec3& p) {
  const double height = p.y / 2.0; // 0 at the source, 1 at the top
  // Swirls that grow with height: the column is bent and turned before it is looked up.
  const glm::dvec3 bend(0.22 * height * noise(glm::dvec3(0.0, 1.5 * p.y, 0.3), 23), 0.0,
                        0.22 * height * noise(glm::dvec3(0.7, 1.5 * p.y, 0.0), 31));
  const double radius = 0.08 + 0.47 * std::pow(std::max(height, 0.0), 1.1);
  const glm::dvec3 q = p - bend;
  if (glm::length(glm::dvec2(q.x, q.z)) > 2.0 * radius) {
    return {}; // beyond what the curls below can reach
  }
  const double turn = 2.2 * height * fractal(glm::dvec3(1.6, 1.3, 1.6) * p, 11, 2);
  const glm::dvec2 across(std::cos(turn) * q.x - std::sin(turn) * q.z, std::sin(turn) * q.x + std::cos(turn) * q.z);
  const glm::dvec3 warped(across.x, 0.8 * q.y, across.y);
  const double curls = 1.15 * billow(3.0 * warped + glm::dvec3(0.0, -1.0, 0.0), 47, 4) + 0.35 * fractal(2.2 * warped, 59, 3);
  const double shell = glm::length(across) / radius + 1.25 * (curls - 0.22) * std::min(1.0, 0.35 + height);
  const double ends = smoothStep(-0.02, 0.03, p.y) * (1.0 - smoothStep(0.74, 1.0, height + 0.35 * curls));
  FieldSample sample;
  sample.density = ends * (1.0 - smoothStep(0.72, 1.02, shell)) * (1.0 - 0.55 * height);
  sample.density = sample.density < 0.004 ? 0.0 : sample.density;
  if (sample.density > 0.0) {
    const double spin = 0.6 * height;
    sample.velocity = coarsened({0.15 * q.x / radius - spin * q.z, 0.9 - 0.4 * height, 0.15 * q.z / radius + spin * q.x});
  }
  return sample;
}

/// A sphere of the cloud's body.
struct Puff {
  glm::dvec3 centre;
  double radius;
};

/// Large spheres on the base, smaller ones on their upper sides: in metres.
std::vector<Puff> makePuffs() {
  std::vector<Puff> puffs{{{-420.0, 170.0, 40.0}, 300.0}, {{0.0, 260.0, -60.0}, 400.0},  {{430.0, 190.0, 60.0}, 310.0},
                          {{120.0, 560.0, 20.0}, 290.0},  {{-180.0, 180.0, 330.0}, 250.0}, {{200.0, 160.0, -340.0}, 260.0},
                          {{640.0, 110.0, -40.0}, 200.0}, {{-650.0, 100.0, -60.0}, 190.0}};
  const std::size_t parents = puffs.size();
  for (std::size_t parent = 0; parent < parents; ++parent) {
    for (int child = 0; child < 9; ++child) {
      const glm::ivec3 key(int(parent), child, 0);
      const double angle = 6.283185307179586 * lattice(key, 101);
      const double rise = 0.1 + 0.9 * lattice(key, 103);
      const double flat = std::sqrt(1.0 - rise * rise);
      const glm::dvec3 direction(flat * std::cos(angle), rise, flat * std::sin(angle));
      const Puff body = puffs[parent];
      puffs.push_back({body.centre + 0.85 * body.radius * direction, body.radius * (0.28 + 0.22 * lattice(key, 107))});
    }
  }
  return puffs;
}

/// Distance to the puffs' surface, negative inside, metres; edges between puffs slightly rounded.
double distanceToPuffs(const std::vector<Puff>& puffs, const glm::dvec3& p) {
  constexpr double kRounding = 25.0;
  double sum = 0.0;
  for (const Puff& puff : puffs) {
    const double distance = glm::length(p - puff.centre) - puff.radius;
    if (distance < 12.0 * kRounding) {
      sum += std::exp(-distance / kRounding);
    }
  }
  return sum > 0.0 ? -kRounding * std::log(sum) : 1e4;
}

double cloudDensity(const std::vector<Puff>& puffs, const glm::dvec3& p) {
  const double surface = distanceToPuffs(puffs, p);
  if (surface > 120.0) {
    return 0.0;
  }
  const double bumps = 240.0 * (billow(p / 230.0, 211, 4) - 0.28);
  const double base = 15.0 * fractal(p / 240.0, 223, 2) - p.y; // a ragged but flat underside
  const double depth = -std::max(surface - bumps, base);
  const double density = smoothStep(-10.0, 70.0, depth);
  return density < 0.004 ? 0.0 : density;
}

/// A tongue of the flame: where it stands, how high it reaches and how wide it is, metres.
struct Tongue {
  glm::dvec2 foot;
  double height;
  double width;
};
constexpr std::array kTongues{Tongue{{0.0, 0.0}, 0.98, 0.150},   Tongue{{-0.12, 0.06}, 0.66, 0.105},
                              Tongue{{0.13, 0.05}, 0.74, 0.100}, Tongue{{0.03, -0.13}, 0.58, 0.100},
                              Tongue{{-0.05, 0.15}, 0.45, 0.085}};

/// How far inside a tongue a point is: 1 in its middle, 0 at its surface and outside.
double insideTongue(const Tongue& tongue, const glm::dvec3& p, std::uint32_t seed) {
  const double rise = std::max(p.y, 0.0) / tongue.height;
  if (rise >= 1.0) {
    return 0.0;
  }
  // The tip leans towards the middle and sways; it narrows to a point.
  const glm::dvec2 lean(0.16 * rise * noise(glm::dvec3(0.3, 2.6 * p.y, 0.9), seed),
                        0.16 * rise * noise(glm::dvec3(1.7, 2.4 * p.y, 0.2), seed + 1));
  const glm::dvec2 across = glm::dvec2(p.x, p.z) - tongue.foot * (1.0 - 0.75 * rise) - lean;
  const double profile = tongue.width * std::min(1.0, 0.55 + 2.2 * rise) * std::pow(1.0 - rise, 0.7);
  return std::max(0.0, 1.0 - glm::length(across) / std::max(profile, 1e-6));
}

FieldSample flameAt(const glm::dvec3& p) {
  const double height = std::max(p.y, 0.0);
  const glm::dvec3 wrinkled = p + 0.05 * std::min(1.0, 0.3 + 2.0 * height) *
                                      glm::dvec3(fractal(glm::dvec3(7.0, 3.5, 7.0) * p, 401, 3), 0.0,
                                                 fractal(glm::dvec3(7.0, 3.5, 7.0) * p, 409, 3));
  double inside = 0.0;
  for (std::size_t i = 0; i < kTongues.size(); ++i) {
    inside = std::max(inside, insideTongue(kTongues[i], wrinkled, 307u + 10u * std::uint32_t(i)));
  }
  if (inside == 0.0) {
    return {};
  }
  const double licks = fractal(glm::dvec3(9.0 * p.x, 4.0 * p.y - 1.5, 9.0 * p.z), 313, 4);
  const double body = smoothStep(-0.02, 0.02, p.y) * smoothStep(0.06, 0.55, inside + 0.55 * licks * std::min(inside * 4.0, 1.0));
  FieldSample sample;
  if (body < 0.01) {
    return sample;
  }
  // Hottest in the lower middle, cooler towards the surface and the tips, where the soot is.
  const double kelvin = 900.0 + 1050.0 * std::pow(body, 0.7) * (1.0 - 0.45 * std::min(height, 1.0));
  sample.temperature = std::round(kelvin / 2.0) * 2.0;
  sample.density = body * (0.2 + 0.8 * (1.0 - 0.6 * body) * smoothStep(0.2, 0.9, height));
  sample.velocity = coarsened({-0.6 * p.x, 1.2 + 1.6 * std::sqrt(height), -0.6 * p.z});
  return sample;
}

GeneratedVolume withRoom(const glm::ivec3& size, const glm::ivec3& indexMin, double voxelSize) {
  GeneratedVolume volume;
  volume.size = size;
  volume.indexMin = indexMin;
  volume.voxelSize = voxelSize;
  volume.density.assign(volume.voxelCount(), 0.0f);
  return volume;
}

} // namespace

GeneratedVolume makePlume() {
  GeneratedVolume volume = withRoom({72, 96, 72}, {-36, -2, -36}, 0.0225);
  volume.velocity.assign(volume.voxelCount(), glm::vec3(0.0f));
  fill(volume, plumeAt);
  return volume;
}

GeneratedVolume makeCloud() {
  GeneratedVolume volume = withRoom({104, 64, 76}, {-52, -3, -38}, 19.0);
  const std::vector<Puff> puffs = makePuffs();
  fill(volume, [&](const glm::dvec3& p) { return FieldSample{.density = cloudDensity(puffs, p)}; });
  return volume;
}

GeneratedVolume makeFlame() {
  GeneratedVolume volume = withRoom({64, 96, 64}, {-32, -2, -32}, 0.011);
  volume.temperature.assign(volume.voxelCount(), 0.0f);
  volume.velocity.assign(volume.voxelCount(), glm::vec3(0.0f));
  fill(volume, flameAt);
  return volume;
}

} // namespace tyndall::volume
