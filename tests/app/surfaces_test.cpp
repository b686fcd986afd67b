// SPDX-License-Identifier: Apache-2.0
// Surfaces as a user meets them: what is said about them, that nothing on the way changes a bit of the picture, and
// extremes that a scene may hold.
#include "app/program.h"
#include "film/exr.h"
#include "support/fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ostream>

namespace tyndall::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A ball of tea in glass on a floor, beside a shining ball; lengths times `s`, everything moved by `o` along x and z.
std::string room(double s, double o = 0.0) {
  const auto point = [&](double x, double y, double z) {
    return "[" + std::to_string(o + s * x) + ", " + std::to_string(s * y) + ", " + std::to_string(o + s * z) + "]";
  };
  const auto number = [](double value) { return std::to_string(value); };
  return R"({"camera": {"position": )" + point(0, 1, 4) + R"(, "target": )" + point(0, 0.5, 0) + R"(},
"media": [{"name": "tea", "type": "homogeneous", "extinction": )" +
         number(2.0 / s) +
         R"(, "shape": {"type": "objects"}}],
"materials": [{"name": "glass", "type": "dielectric"}, {"name": "lamp", "type": "diffuse", "emission": 5}],
"objects": [
{"type": "quad", "origin": )" +
         point(-5, 0, 5) + R"(, "edge_u": [)" + number(10 * s) + R"(, 0, 0], "edge_v": [0, 0, )" + number(-10 * s) +
         R"(]},
{"type": "sphere", "centre": )" +
         point(0, 0.5, 0) + R"(, "radius": )" + number(0.5 * s) +
         R"(, "material": "glass", "medium": "tea"},
{"type": "sphere", "centre": )" +
         point(1, 1, 1) + R"(, "radius": )" + number(0.25 * s) + R"(, "material": "lamp"}]})";
}

class Surfaces : public testing::Test {
protected:
  /// A tiny picture `name`.exr of `name`.json with its statistics.
  Outcome render(const std::string& scene, const std::string& name, const std::string& options = "",
                 int samples = 16) const {
    writeFile(folder_ / (name + ".json"), scene);
    return run("render " + name + ".json --size 24x18 --spp " + std::to_string(samples) + " --stats " + name +
               ".stats -o " + name + ".exr " + options);
  }
  Outcome run(const std::string& line) const { return runProgram(wordsOf(line, ""), folder_.path()); }
  nlohmann::json statistics(const std::string& name) const {
    return nlohmann::json::parse(bytesOf(folder_ / (name + ".stats")));
  }
  film::Image picture(const std::string& name) const { return film::readExr(folder_ / (name + ".exr")); }

  TemporaryFolder folder_;
};

double mean(const film::Image& image) {
  double sum = 0.0;
  for (const float value : image.channels.at("G")) {
    EXPECT_TRUE(std::isfinite(value));
    sum += value;
  }
  return sum / double(image.window.pixelCount());
}

bool sameBits(const film::Image& a, const film::Image& b) {
  return a.channels.size() == b.channels.size() &&
         std::equal(a.channels.begin(), a.channels.end(), b.channels.begin(), [](const auto& x, const auto& y) {
           return x.first == y.first && x.second.size() == y.second.size() &&
                  std::memcmp(x.second.data(), y.second.data(), x.second.size() * sizeof(float)) == 0;
         });
}

TEST_F(Surfaces, AreCountedInTheStatisticsAndByInfo) {
  const Outcome outcome = render(room(1), "a");
  ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("scattering events per sample"));
  const nlohmann::json statistics = this->statistics("a");
  EXPECT_EQ(statistics["estimator"]["name"], "path");
  EXPECT_EQ(statistics["surfaces"]["triangles"], 2);
  EXPECT_EQ(statistics["surfaces"]["spheres"], 2);
  EXPECT_EQ(statistics["surfaces"]["primitives"], 4);
  EXPECT_EQ(statistics["surfaces"]["interiors"], 1);
  EXPECT_EQ(statistics["surfaces"]["emitters"], 1);
  EXPECT_EQ(statistics["pipeline"]["Textures"], "left out");
  EXPECT_EQ(statistics["pipeline"]["Interiors"], "on");
  const double events = statistics["paths"]["mean_events_per_sample"];
  EXPECT_GT(events, 0.5); // half of the rays meet the floor or the ball
  EXPECT_LT(events, statistics["paths"]["most_events_of_one"].get<double>());
  const nlohmann::json info = nlohmann::json::parse(run("info --json a.json").output);
  EXPECT_EQ(info["surfaces"], statistics["surfaces"]);
  EXPECT_GE(statistics["device_bytes"]["planned"], info["surfaces"]["device_bytes"]);
  EXPECT_THAT(run("info a.json").output, HasSubstr("2 triangles, 2 spheres, 1 interior, 1 emitter, "));
}

TEST_F(Surfaces, DepthCountsTheEventsOfAPath) {
  // Inside a box whose walls reflect half, each further event adds light: the series 1 + 1/2 + 1/4 + ...
  const std::string box = R"({"camera": {"position": [0, 0, 0.2], "target": [0, 0, 0]},
"materials": [{"name": "grey", "type": "diffuse", "colour": 0.5, "emission": 1, "two_sided": true}],
"objects": [{"type": "box", "min": [-1, -1, -1], "max": [1, 1, 1], "material": "grey"}]})";
  const std::pair<const char*, double> kExpected[] = {{"1", 1.5}, {"2", 1.75}, {"3", 1.875}, {"unlimited", 2.0}};
  for (const auto& [depth, radiance] : kExpected) {
    ASSERT_EQ(render(box, "a", std::string("--depth ") + depth).exitCode, 0);
    // The only noise is that of finding light in two ways; 4 of its standard errors.
    EXPECT_NEAR(mean(picture("a")), radiance, 0.006 * radiance) << depth;
    EXPECT_EQ(picture("a").metadata.at("depth"), depth);
  }
}

TEST_F(Surfaces, CropsSeedsAndResumedRendersAreTheSamePicture) {
  ASSERT_EQ(render(room(1), "whole", "--mergeable --quiet").exitCode, 0);
  ASSERT_EQ(render(room(1), "left", "--mergeable --quiet --crop 0,0,11,18").exitCode, 0);
  ASSERT_EQ(render(room(1), "right", "--mergeable --quiet --crop 11,0,24,18").exitCode, 0);
  ASSERT_EQ(run("merge left.exr.part right.exr.part -o joined.exr").exitCode, 0);
  EXPECT_TRUE(sameBits(picture("joined"), picture("whole")));
  ASSERT_EQ(render(room(1), "seeded", "--quiet --seed 1").exitCode, 0);
  EXPECT_FALSE(sameBits(picture("seeded"), picture("whole"))); // so the comparison can fail
  ASSERT_EQ(render(room(1), "grown", "--quiet --resume").exitCode, 0);
  ASSERT_EQ(run("render grown.json --size 24x18 --spp 48 --quiet --resume -o grown.exr").exitCode, 0);
  ASSERT_EQ(run("render grown.json --size 24x18 --spp 48 --quiet -o atonce.exr").exitCode, 0);
  EXPECT_TRUE(sameBits(picture("grown"), picture("atonce")));
}

TEST_F(Surfaces, LayersAndTransparencyKnowSurfaces) {
  const std::string ball = R"({"camera": {"type": "orthographic", "position": [0, 0, 5], "height": 4},
"lights": [{"type": "constant", "radiance": 1}], "objects": [{"type": "sphere"}]})";
  ASSERT_EQ(render(ball, "a", "--quiet --transparent --aov depth,albedo").exitCode, 0);
  const film::Image image = picture("a");
  const std::size_t middle = 9 * 24 + 12;
  EXPECT_EQ(image.channels.at("A")[middle], 1.0f);
  EXPECT_EQ(image.channels.at("A")[0], 0.0f);
  EXPECT_EQ(image.channels.at("G")[0], 0.0f);
  EXPECT_NEAR(image.channels.at("depth.Z")[middle], 4.0, 0.05); // the pixel is a quarter of a unit wide
}

TEST_F(Surfaces, ScenesOfEverySizeAndPlaceGiveOnePicture) {
  ASSERT_EQ(render(room(1), "unit", "--quiet").exitCode, 0);
  const double expected = mean(picture("unit"));
  EXPECT_GT(expected, 0.05);
  const std::pair<const char*, std::string> kOthers[] = {
      {"centimetres", room(1e-2)}, {"enormous", room(1e6)}, {"far from the origin", room(1, 1e5)}};
  for (const auto& [what, scene] : kOthers) {
    ASSERT_EQ(render(scene, "other", "--quiet").exitCode, 0) << what;
    // The same random numbers; a path that rounding sends another way may change a pixel, not the mean.
    EXPECT_NEAR(mean(picture("other")), expected, 2e-3 * expected) << what;
  }
}

struct Extreme {
  const char* what;
  const char* members; ///< of the scene, beside a floor of material "m"
  double least, most;  ///< of the mean radiance
};

void PrintTo(const Extreme& extreme, std::ostream* stream) { *stream << extreme.what; }

class ExtremeSurfaces : public Surfaces, public testing::WithParamInterface<Extreme> {};

TEST_P(ExtremeSurfaces, GiveASoundPicture) {
  const Extreme& extreme = GetParam();
  const Outcome outcome = render(extreme.members, "a", "--quiet", 192); // glass is known to 1e-4 by then
  ASSERT_EQ(outcome.exitCode, 0) << outcome.output << outcome.errors;
  const nlohmann::json counters = statistics("a")["counters"];
  EXPECT_EQ(counters["nonfinite_samples"], 0);
  EXPECT_EQ(counters["negative_samples"], 0);
  const double radiance = mean(picture("a"));
  EXPECT_GE(radiance, extreme.least);
  EXPECT_LE(radiance, extreme.most);
}

// In even light of radiance 1 what loses nothing cannot be seen; behind glass of index 1.5, radiance is 2.25 times it.
constexpr const char* kEven = R"("lights": [{"type": "constant", "radiance": 1}])";
const std::string kInGlass = std::string("{") + kEven + R"(, "camera": {"position": [0, 0, 0], "target": [1, 0, 0]},
"materials": [{"name": "m", "type": "dielectric"}], "objects": [{"type": "sphere", "material": "m"}]})";
const std::string kSmooth = std::string("{") + kEven + R"(, "materials": [{"name": "m", "type": "dielectric",
"roughness": 1e-5}], "objects": [{"type": "sphere", "material": "m"}]})";
const std::string kNoGlass = std::string("{") + kEven + R"(, "materials": [{"name": "m", "type": "dielectric",
"ior": 1, "roughness": 0.5}], "objects": [{"type": "sphere", "material": "m"}]})";
const std::string kHole = std::string("{") + kEven + R"(, "materials": [{"name": "m", "type": "diffuse", "colour": 0,
"opacity": 0}], "objects": [{"type": "sphere", "material": "m"}]})";
const std::string kMirror = std::string("{") + kEven + R"(, "materials": [{"name": "m", "type": "conductor",
"colour": 1}], "objects": [{"type": "sphere", "material": "m"}]})";
const std::string kBlinding = R"({"camera": {"position": [0, 0, 0], "target": [1, 0, 0]}, "materials": [{"name": "m",
"type": "diffuse", "colour": 0, "emission": 1e12, "two_sided": true}], "objects": [{"type": "sphere", "material": "m"}]})";
const std::string kGrain = R"({"camera": {"position": [0, 0, 0], "target": [1, 0, 0]}, "materials": [{"name": "m",
"type": "diffuse", "colour": 0, "emission": 3, "two_sided": true}], "objects": [{"type": "sphere", "radius": 1e-6,
"material": "m"}, {"type": "quad", "origin": [-1, -9, 1]}]})";
const std::string kDark =
    R"({"lights": [{"type": "point", "position": [0, 3, 3], "intensity": 0}], "objects": [{"type": "sphere"}]})";
const std::string kInTheWall = R"({"media": [{"name": "fog", "type": "homogeneous", "shape": {"type": "objects"}}],
"materials": [{"name": "m", "type": "null"}], "lights": [{"type": "point", "position": [1, 0, 0], "intensity": 4},
{"type": "point", "position": [1, 1, 1], "intensity": 4}],
"objects": [{"type": "box", "min": [-1, -1, -1], "max": [1, 1, 1], "material": "m", "medium": "fog"}]})";

const Extreme kExtremes[] = {
    {"camera inside glass", kInGlass.c_str(), 2.249, 2.251},
    {"glass of roughness 1e-5", kSmooth.c_str(), 0.9995, 1.0005},
    {"glass of index 1", kNoGlass.c_str(), 0.9999, 1.0001},
    {"opacity 0", kHole.c_str(), 0.9999, 1.0001},
    {"a perfect mirror", kMirror.c_str(), 0.9999, 1.0001},
    {"radiance 1e12", kBlinding.c_str(), 0.9999e12, 1.0001e12},
    {"camera inside a grain of 1e-6", kGrain.c_str(), 2.9997, 3.0003},
    {"lights of no intensity", kDark.c_str(), 0.0, 0.0},
    {"lights in the wall and the corner of a container", kInTheWall.c_str(), 1e-3, 10.0},
};
INSTANTIATE_TEST_SUITE_P(All, ExtremeSurfaces, testing::ValuesIn(kExtremes));

} // namespace
} // namespace tyndall::test
