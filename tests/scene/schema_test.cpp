// SPDX-License-Identifier: Apache-2.0
// The table of keys in fields.h, docs/scene.schema.json, docs/scene-format.md and the reader say the same.
#include "base/file.h"
#include "scene/fields.h"
#include "scene/schema.h"
#include "scene/support.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

namespace tyndall::scene {
namespace {

using nlohmann::json;

/// Key paths of a schema: "media.*.phase.g".
void collectKeys(const json& schema, const std::string& path, std::set<std::string>& keys) {
  if (schema.contains("properties")) {
    for (const auto& [key, inner] : schema["properties"].items()) {
      const std::string inside = path.empty() ? key : path + "." + key;
      keys.insert(inside);
      collectKeys(inner, inside, keys);
    }
  }
  if (schema.contains("items")) {
    collectKeys(schema["items"], path + ".*", keys);
  }
  for (const json& alternative : schema.value("anyOf", json::array())) {
    collectKeys(alternative, path, keys);
  }
}

/// Key paths of a scene file.
void collectUsed(const json& value, const std::string& path, std::set<std::string>& keys) {
  if (value.is_object()) {
    for (const auto& [key, inner] : value.items()) {
      const std::string inside = path.empty() ? key : path + "." + key;
      keys.insert(inside);
      collectUsed(inner, inside, keys);
    }
  }
  for (std::size_t i = 0; value.is_array() && i < value.size(); ++i) {
    collectUsed(value[i], path + ".*", keys);
  }
}

/// Whether `value` meets the few rules of draft-07 that the schema uses; the first breach goes to `why`.
bool meets(const json& schema, const json& value, const std::string& path, std::string& why) {
  const auto breach = [&](const std::string& what) {
    why = path + ": " + what;
    return false;
  };
  if (schema.contains("anyOf")) {
    std::string unused;
    const json& alternatives = schema["anyOf"];
    return std::any_of(alternatives.begin(), alternatives.end(),
                       [&](const json& alternative) { return meets(alternative, value, path, unused); }) ||
           breach("no alternative");
  }
  const std::string type = schema.at("type");
  const bool typed = (type == "object" && value.is_object()) || (type == "array" && value.is_array()) ||
                     (type == "string" && value.is_string()) || (type == "boolean" && value.is_boolean()) ||
                     (type == "null" && value.is_null()) || (type == "number" && value.is_number()) ||
                     (type == "integer" && value.is_number() && value.get<double>() == std::floor(value.get<double>()));
  if (!typed) {
    return breach("type");
  }
  if (schema.contains("enum") && std::count(schema["enum"].begin(), schema["enum"].end(), value) == 0) {
    return breach("enum");
  }
  if (value.is_number() &&
      (value < schema.value("minimum", json(-1e300)) || value > schema.value("maximum", json(1e300)) ||
       value <= schema.value("exclusiveMinimum", json(-1e300)))) {
    return breach("range");
  }
  for (const json& key : schema.value("required", json::array())) {
    if (!value.contains(key)) {
      return breach("required " + key.get<std::string>());
    }
  }
  if (value.is_array() &&
      (value.size() < schema.value("minItems", 0u) || value.size() > schema.value("maxItems", 1000u))) {
    return breach("length");
  }
  for (std::size_t i = 0; value.is_array() && schema.contains("items") && i < value.size(); ++i) {
    if (!meets(schema["items"], value[i], path + "." + std::to_string(i), why)) {
      return false;
    }
  }
  for (auto member = value.begin(); value.is_object() && member != value.end(); ++member) {
    if (!schema["properties"].contains(member.key())) {
      return breach("unknown " + member.key());
    }
    if (!meets(schema["properties"][member.key()], member.value(), path + "." + member.key(), why)) {
      return false;
    }
  }
  return true;
}

TEST(SceneSchema, TheFileIsWhatTheCodeMakes) {
  EXPECT_EQ(readTextFile("docs/scene.schema.json"), jsonSchema())
      << "remake it: scene_schema > docs/scene.schema.json (a program in the tests' build folder)";
}

TEST(SceneSchema, ListsEveryKeyThatTheReaderKnows) {
  std::set<std::string> known;
  collectKeys(json::parse(jsonSchema()), "", known);
  std::set<std::string> used;
  const LoadResult result = test::parse(test::everything());
  ASSERT_TRUE(result.ok());
  collectUsed(json::parse(test::everything()), "", used);
  collectUsed(json::parse(result.canonical), "", used);
  const LoadResult orthographic = test::parse(R"({"camera": {"type": "orthographic", "height": 1}})");
  ASSERT_TRUE(orthographic.ok());
  used.insert("camera.height");
  used.insert({"camera.file", "camera.name"}); // settled while loading: never written
  EXPECT_EQ(used, known);
}

TEST(SceneSchema, AcceptsWhatTheReaderAccepts) {
  const json schema = json::parse(jsonSchema());
  std::string why;
  EXPECT_TRUE(meets(schema, json::parse(test::everything()), "", why)) << why;
  EXPECT_TRUE(meets(schema, json::parse(test::parse(test::everything()).canonical), "", why)) << why;
}

TEST(SceneSchema, RefusesWhatTheReaderRefuses) {
  const json schema = json::parse(jsonSchema());
  const std::vector<Override> broken{{"film.size", "[0, 1]"},           {"film.exposur", "1"},
                                     {"film.view", "\"warm\""},         {"camera.vertical_fov", "0"},
                                     {"media.0.albedo", "1.5"},         {"media.0.phase.weight", "-1"},
                                     {"media.0.phase", "{}"},           {"media.0.storage", "\"x\""},
                                     {"lights.0.position", "[1, 2]"},   {"lights.4.turbidity", "11"},
                                     {"lights.5.outer_angle", "0"},     {"render.depth", "-1"},
                                     {"camera.lens_radius", "-1"},      {"media.0.extinction_colour", "2"},
                                     {"media.0.instances.1.0.scale", "[1, 2]"},     {"materials.1.roughness", "1.5"},
                                     {"materials.0.name", "5"},         {"materials.3.ior", "0.5"},
                                     {"objects.0.instances.0", "[5]"}, {"objects.0.type", "\"torus\""},
                                     {"objects.3.radius", "0"},         {"media", "{}"},
                                     {"animation.tracks.0.keys", "[]"}, {"animation.tracks.0.keys.1", "[1, 2, 3]"},
                                     {"animation.frames_per_second", "0"},
                                     {"render.samples", "1.5"},         {"render.integrator", "\"mcmc\""},
                                     {"guide.score", "\"light\""},      {"guide.loads", "17"},
                                     {"guide.cells.ratio", "1"},        {"guide.scatter_share", "0"},
                                     {"guide.radiance", "[]"}};
  for (const Override& change : broken) {
    std::string pointer = "/" + change.path;
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    json text = json::parse(test::everything());
    text[json::json_pointer(pointer)] = json::parse(change.value);
    std::string why;
    EXPECT_FALSE(meets(schema, text, "", why)) << change.path;
    EXPECT_FALSE(test::parse(text.dump()).ok()) << change.path;
  }
}

TEST(SceneFormatPage, NamesEveryKeyAndEveryWord) {
  const std::string page = readTextFile("docs/scene-format.md");
  std::set<std::string> keys;
  collectKeys(json::parse(jsonSchema()), "", keys);
  for (const std::string& path : keys) {
    const std::string key = path.substr(path.rfind('.') + 1);
    EXPECT_THAT(page, testing::HasSubstr("`" + key + "`")) << path;
  }
  const auto words = [&](const auto& table) {
    for (const auto& entry : table) {
      EXPECT_THAT(page, testing::HasSubstr("`\"" + std::string(entry.first) + "\"`"));
    }
  };
  words(kCameraTypes);
  words(kIntegrators);
  words(kGuideScores);
  words(kGuideWeights);
  words(kInterpolations);
  words(kViews);
  words(kShapeTypes);
  words(kEmissionTypes);
  words(kMediumTypes);
  words(kLightTypes);
  words(kMaterialTypes);
  words(kObjectTypes);
  words(kPhaseTypes);
  for (const std::string_view storage : kStorages) {
    EXPECT_THAT(page, testing::HasSubstr("`\"" + std::string(storage) + "\"`"));
  }
}

TEST(ScenePhases, EveryParameterHasARange) {
  for (const PhaseName& phase : kPhases) {
    std::size_t count = 0;
    forEachParameter(phase.parameters, [&](std::string_view name, std::size_t index) {
      const Range range = phaseParameterRange(name);
      EXPECT_LT(range.min, range.max) << phase.name << "." << name << ": add its range to ranges.h";
      EXPECT_EQ(index, count++);
    });
    EXPECT_LE(count, Phase{}.parameters.size());
  }
}

} // namespace
} // namespace tyndall::scene
