// SPDX-License-Identifier: Apache-2.0
#include "light/environment.h"

#include "support/probe.h"
#include "support/statistics.h"

// Needs <cstdint> before it.
#include "kernels/environment_probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace tyndall::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::uint32_t kCount = 1u << 19;

struct Answers {
  std::vector<glm::vec4> densities; ///< (w, pdf)
  std::vector<glm::vec3> radiances;
};

struct EnvironmentProbe {
  interop::EnvironmentMap map;
  std::uint32_t count;
  interop::Ptr<glm::vec3> directions;
  interop::Ptr<glm::vec4> densities;
  interop::Ptr<glm::vec3> radiances;
};

/// Samples, or what is known of the given directions.
Answers ask(const light::EnvironmentTable& table, double rotation, const std::vector<glm::vec3>& directions, bool planted = false) {
  const bool sampling = directions.empty();
  const std::uint32_t count = sampling ? kCount : static_cast<std::uint32_t>(directions.size());
  const auto texels = ProbeRunner::upload(table.texels);
  const auto cells = ProbeRunner::upload(table.cells);
  const auto in = ProbeRunner::upload(sampling ? std::vector<glm::vec3>(1) : directions);
  const auto densities = ProbeRunner::results<glm::vec4>(count);
  const auto radiances = ProbeRunner::results<glm::vec3>(count);
  const ProbeRunner probe(k_environment_probe_spirv, {{0, sampling ? 0u : 1u}, {1, gpu::specBits(planted)}});
  const interop::EnvironmentMap map = light::deviceMap(table, 360.0 * rotation, texels.ptr(), cells.ptr());
  probe.run(EnvironmentProbe{map, count, in.ptr(), densities.ptr(), radiances.ptr()}, count);
  return {ProbeRunner::download(densities), ProbeRunner::download(radiances)};
}

/// (u, v) of a direction by the convention: middle column -z, right +x, top +y, turned about +y.
glm::dvec2 placeOf(const glm::dvec3& w, double rotation) {
  const double u = std::atan2(w.x, -w.z) / (2.0 * kPi) + 0.5 + rotation;
  return {u - std::floor(u), std::atan2(std::hypot(w.x, w.z), w.y) / kPi};
}

glm::dvec3 directionAt(double u, double v, double rotation) {
  const double azimuth = 2.0 * kPi * (u - 0.5 - rotation);
  return {std::sin(kPi * v) * std::sin(azimuth), std::cos(kPi * v), -std::sin(kPi * v) * std::cos(azimuth)};
}

struct Named {
  const char* name;
  light::EnvironmentTable table;
  double rotation;
};

std::vector<Named> maps() {
  std::mt19937 engine(5);
  std::exponential_distribution<float> exponential;
  const auto make = [](const glm::uvec2& size, const std::function<glm::vec3(std::size_t)>& texel) {
    std::vector<glm::vec3> texels;
    for (std::size_t i = 0; i < std::size_t(size.x) * size.y; ++i) {
      texels.push_back(texel(i));
    }
    return light::makeEnvironment(texels, size, 1.0);
  };
  std::vector<Named> result;
  result.push_back({"constant 1x1", make({1, 1}, [](std::size_t) { return glm::vec3(1.0f); }), 0.0});
  result.push_back({"random 8x4", make({8, 4}, [&](std::size_t) { return glm::vec3(exponential(engine), exponential(engine), 1.0f); }), 0.3});
  result.push_back({"random 60x31", make({60, 31}, [&](std::size_t) { return glm::vec3(std::pow(exponential(engine), 3.0f)); }), -0.77});
  result.push_back({"one bright texel", make({64, 32}, [](std::size_t i) { return glm::vec3(i == 64 * 9 + 63 ? 1e5f : 1e-3f); }), 0.0});
  result.push_back({"bright pole", make({32, 16}, [](std::size_t i) { return glm::vec3(i < 32 ? 50.0f : 0.0f); }), 0.1});
  result.push_back({"coarsened", make({1300, 700}, [&](std::size_t i) { return glm::vec3(i % 7 == 0 ? exponential(engine) : 0.01f); }), 0.5});
  return result;
}

/// Expected samples in 32 x 16 equal parts of the square, from the cells' probabilities in double.
std::vector<double> partProbabilities(const light::EnvironmentTable& table) {
  std::vector<double> parts(32 * 16, 0.0);
  const glm::uvec2 cells = table.cellCount;
  const auto overlap = [](double a0, double a1, double b0, double b1) { return std::max(0.0, std::min(a1, b1) - std::max(a0, b0)); };
  const auto height = [](double v) { return -std::cos(kPi * v); };
  for (unsigned y = 0; y < cells.y; ++y) {
    const double v0 = double(y) / cells.y;
    const double v1 = (y + 1.0) / cells.y;
    for (unsigned x = 0; x < cells.x; ++x) {
      const double probability = static_cast<double>(table.cells[std::size_t(y) * cells.x + x].probability);
      const double u0 = double(x) / cells.x;
      const double u1 = (x + 1.0) / cells.x;
      for (unsigned py = static_cast<unsigned>(v0 * 16.0); py < 16 && py < v1 * 16.0; ++py) {
        // Within a cell the density is uniform in solid angle: in the azimuth and the height.
        const double inV = overlap(height(v0), height(v1), height(py / 16.0), height((py + 1) / 16.0)) / (height(v1) - height(v0));
        for (unsigned px = static_cast<unsigned>(u0 * 32.0); px < 32 && px < u1 * 32.0; ++px) {
          parts[py * 32 + px] += probability * inV * overlap(u0, u1, px / 32.0, (px + 1) / 32.0) / (u1 - u0);
        }
      }
    }
  }
  return parts;
}

/// The map's radiance by the definition: bilinear, wrapped, clamped.
glm::dvec3 bilinear(const light::EnvironmentTable& table, const glm::dvec2& place) {
  const glm::dvec2 texel = place * glm::dvec2(table.size) - 0.5;
  const glm::dvec2 low = glm::floor(texel);
  const glm::ivec2 size(table.size);
  glm::dvec3 sum(0.0);
  for (int dy = 0; dy < 2; ++dy) {
    for (int dx = 0; dx < 2; ++dx) {
      const int x = (static_cast<int>(low.x) + dx + size.x) % size.x;
      const int y = std::clamp(static_cast<int>(low.y) + dy, 0, size.y - 1);
      const glm::dvec2 weight = glm::mix(1.0 - (texel - low), texel - low, glm::dvec2(dx, dy));
      sum += weight.x * weight.y * glm::dvec3(table.texels[static_cast<std::size_t>(y) * table.size.x + static_cast<std::size_t>(x)]);
    }
  }
  return sum;
}

/// Integral of the map's green over the sphere: midpoint rule in the square.
double integrated(const light::EnvironmentTable& table) {
  const int width = std::max(2048, static_cast<int>(table.size.x) * 2);
  const int height = std::max(1024, static_cast<int>(table.size.y) * 2);
  double sum = 0.0;
  for (int y = 0; y < height; ++y) {
    const double solidAngle = 2.0 * kPi / width * (std::cos(kPi * y / height) - std::cos(kPi * (y + 1) / height));
    for (int x = 0; x < width; ++x) {
      sum += bilinear(table, {(x + 0.5) / width, (y + 0.5) / height}).g * solidAngle;
    }
  }
  return sum;
}

TEST(EnvironmentMap, SamplesFollowTheTable) {
  for (const Named& map : maps()) {
    const Answers answers = ask(map.table, map.rotation, {});
    std::vector<std::uint64_t> counts(32 * 16);
    for (const glm::vec4& sample : answers.densities) {
      ASSERT_NEAR(glm::length(glm::dvec3(sample)), 1.0, 1e-6) << map.name;
      const glm::dvec2 place = placeOf(glm::dvec3(sample), map.rotation) * glm::dvec2(32.0, 16.0);
      ++counts[std::min<std::size_t>(15, static_cast<std::size_t>(place.y)) * 32 + std::min<std::size_t>(31, static_cast<std::size_t>(place.x))];
    }
    std::vector<double> parts = partProbabilities(map.table);
    // Directions on a border may round to a part that has no probability of its own.
    std::transform(parts.begin(), parts.end(), parts.begin(), [](double p) { return std::max(p, 1e-9); });
    EXPECT_GT(chiSquaredPValue(counts, parts), kMinPValue) << map.name;
    std::rotate(parts.begin(), parts.begin() + 3, parts.end());
    EXPECT_TRUE(map.table.size.x == 1 || chiSquaredPValue(counts, parts) < kMinPValue) << map.name << ": the checker tells a turned map";
  }
}

double pdfIntegral(const Named& map, bool planted) {
  const glm::uvec2 cells = map.table.cellCount;
  const unsigned perCell = cells.x > 500 ? 1 : 3;
  std::vector<glm::vec3> directions;
  std::vector<double> weights;
  for (unsigned y = 0; y < cells.y * perCell; ++y) {
    const double v = (y + 0.5) / (cells.y * perCell);
    const double solidAngle = 2.0 * kPi / (cells.x * perCell) * (std::cos(kPi * double(y) / (cells.y * perCell)) - std::cos(kPi * (y + 1.0) / (cells.y * perCell)));
    for (unsigned x = 0; x < cells.x * perCell; ++x) {
      directions.emplace_back(directionAt((x + 0.5) / (cells.x * perCell), v, map.rotation));
      weights.push_back(solidAngle);
    }
  }
  const Answers answers = ask(map.table, map.rotation, directions, planted);
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += weights[i] * static_cast<double>(answers.densities[i].w);
  }
  return sum;
}

TEST(EnvironmentMap, PdfIntegratesToOne) {
  for (const Named& map : maps()) {
    // The density is constant in a cell, so the midpoint rule is exact but for float.
    EXPECT_NEAR(pdfIntegral(map, false), 1.0, 2e-5) << map.name;
  }
  EXPECT_GT(std::abs(pdfIntegral(maps()[4], true) - 1.0), 2e-5); // planted: per unit square
}

double estimateZ(const Named& map, bool planted) {
  const Answers answers = ask(map.table, map.rotation, {}, planted);
  std::vector<double> terms;
  for (std::size_t i = 0; i < answers.densities.size(); ++i) {
    const double pdf = static_cast<double>(answers.densities[i].w);
    terms.push_back(pdf > 0.0 ? static_cast<double>(answers.radiances[i].g) / pdf : 0.0);
  }
  const double expected = integrated(map.table);
  return estimateMean(terms).zScore(expected, 1e-4 * expected);
}

TEST(EnvironmentMap, RadianceOverPdfHasTheMapsIntegralAsMean) {
  for (const Named& map : maps()) {
    EXPECT_LT(estimateZ(map, false), kMaxZ) << map.name;
  }
  EXPECT_GT(estimateZ(maps()[1], true), kMaxZ);
}

TEST(EnvironmentMap, RadianceIsBilinearAndOriented) {
  std::mt19937 engine(6);
  std::normal_distribution<double> normal;
  std::vector<glm::vec3> directions{glm::vec3(0.0f, 0.0f, 1.0f), glm::vec3(-0.0f, 0.0f, 1.0f)};
  for (int i = 0; i < 20000; ++i) {
    directions.emplace_back(glm::normalize(glm::dvec3(normal(engine), normal(engine), normal(engine))));
  }
  for (const Named& map : maps()) {
    const Answers answers = ask(map.table, map.rotation, directions);
    double brightest = 0.0;
    for (const glm::vec3& texel : map.table.texels) {
      brightest = std::max(brightest, static_cast<double>(texel.g));
    }
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const double expected = bilinear(map.table, placeOf(glm::dvec3(directions[i]), map.rotation)).g;
      // One float rounding of the coordinate crosses 1e-7 of the map, 2e-4 texels of the largest.
      ASSERT_NEAR(static_cast<double>(answers.radiances[i].g), expected, 1e-3 * brightest) << map.name;
    }
  }
  // At the poles any column may answer.
  const Named random = maps()[1];
  for (const glm::vec3& radiance : ask(random.table, 0.0, {glm::vec3(0.0f, 1.0f, 0.0f), glm::vec3(0.0f, -1.0f, 0.0f)}).radiances) {
    EXPECT_TRUE(std::isfinite(radiance.g) && radiance.b == 1.0f);
  }
  // Four texels around the horizon: -z in the middle, +x to its right.
  std::vector<glm::vec3> texels(12, glm::vec3(0.0f));
  for (std::size_t x = 0; x < 4; ++x) {
    texels[4 + x] = glm::vec3(static_cast<float>(x));
  }
  const light::EnvironmentTable compass = light::makeEnvironment(texels, {4, 3}, 1.0);
  const float s = std::sqrt(0.5f);
  const std::vector<glm::vec3> corners{{s, 0.0f, -s}, {s, 0.0f, s}, {-s, 0.0f, s}, {-s, 0.0f, -s}};
  const Answers straight = ask(compass, 0.0, corners);
  const Answers turned = ask(compass, 0.25, corners); // +90 degrees about +y takes -z to -x
  const std::array<float, 4> expectedStraight{2.0f, 3.0f, 0.0f, 1.0f};
  const std::array<float, 4> expectedTurned{3.0f, 0.0f, 1.0f, 2.0f};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(straight.radiances[i].g, expectedStraight[i], 1e-5f);
    EXPECT_NEAR(turned.radiances[i].g, expectedTurned[i], 1e-5f);
  }
}

TEST(EnvironmentMap, BlackMapHasPdfZero) {
  const light::EnvironmentTable black = light::makeEnvironment(std::vector<glm::vec3>(8, glm::vec3(0.0f)), {4, 2}, 1.0);
  const Answers answers = ask(black, 0.0, {});
  EXPECT_TRUE(std::all_of(answers.densities.begin(), answers.densities.end(), [](const glm::vec4& d) { return d.w == 0.0f; }));
}

} // namespace
} // namespace tyndall::test
