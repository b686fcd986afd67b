// SPDX-License-Identifier: Apache-2.0
#include "scene/schema.h"

#include "scene/fields.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>

namespace tyndall::scene {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json objectSchema(T& object);

/// The visitor of fields.h that describes the keys of one object.
class Describer {
public:
  Describer& required() {
    required_ = true;
    return *this;
  }
  void applies(bool, std::string when) { when_ = std::move(when); }
  void always() { when_.clear(); }

  template <class Enum>
  bool type(Enum&, Names<Enum> names, std::string_view help) {
    required().choiceOf("type", names, help);
    return true;
  }
  template <class Enum>
  void choice(std::string_view key, Enum& target, Names<Enum> names, std::string_view help) {
    Json& schema = choiceOf(key, names, help);
    for (const auto& [word, value] : names) {
      if (value == target) {
        schema["default"] = word;
      }
    }
  }
  void word(std::string_view key, std::string& target, std::span<const std::string_view> words, std::string_view help) {
    add(key, {{"type", "string"}, {"enum", std::vector<std::string>(words.begin(), words.end())}, {"default", target}},
        help);
  }
  void text(std::string_view key, std::string& target, std::string_view help) {
    add(key, withDefault({{"type", "string"}}, target), help);
  }
  void file(std::string_view key, std::string&, std::string_view help) {
    add(key, {{"type", "string"}, {"minLength", 1}}, help);
  }
  void number(std::string_view key, double& target, const Range& range, std::string_view help) {
    add(key, withDefault(numberIn(range), plain(target)), helpWith(range, help));
  }
  void whole(std::string_view key, std::uint32_t& target, const WholeRange& range, std::string_view help) {
    add(key, withDefault(wholeIn(range), target), help);
  }
  void whole(std::string_view key, std::optional<std::uint32_t>&, const WholeRange& range, std::string_view help) {
    add(key, {{"anyOf", Json::array({{{"type", "null"}}, wholeIn(range)})}, {"default", nullptr}}, help);
  }
  void flag(std::string_view key, bool& target, std::string_view help) {
    add(key, withDefault({{"type", "boolean"}}, target), help);
  }
  void point(std::string_view key, glm::dvec3& target, std::string_view help) {
    add(key, withDefault(listOf(numberIn({-kLargestLength, kLargestLength}), 3), components(target)), help);
  }
  void direction(std::string_view key, glm::dvec3& target, std::string_view help) {
    add(key, withDefault(listOf({{"type", "number"}}, 3), components(target)), help);
  }
  void triple(std::string_view key, glm::dvec3& target, const Range& range, std::string_view help) {
    const Json number = numberIn(range);
    add(key, withDefault({{"anyOf", Json::array({number, listOf(number, 3)})}}, components(target)),
        helpWith(range, help));
  }
  void pair(std::string_view key, glm::uvec2& target, const WholeRange& range, std::string_view help) {
    add(key, withDefault(listOf(wholeIn(range), 2), Json::array({target.x, target.y})), help);
  }
  void matrix(std::string_view key, glm::dmat4&, std::string_view help) {
    add(key, listOf(numberIn({-kLargestLength, kLargestLength}), 16), help);
  }
  void transform(std::string_view key, glm::dmat4&, std::string_view help) { add(key, stepList(), help); }
  void transforms(std::string_view key, std::vector<glm::dmat4>&, std::string_view help) {
    add(key, {{"type", "array"}, {"items", stepList()}}, help);
  }
  void keys(std::string_view key, Track&, std::string_view help) {
    add(key, {{"type", "array"}, {"minItems", 1}, {"items", {{"type", "array"}, {"minItems", 2}, {"maxItems", 2}}}},
        help);
  }
  template <class T>
  void object(std::string_view key, T& target, std::string_view help) {
    add(key, objectSchema(target), help);
  }
  template <class T, class AsView = std::identity>
  void optional(std::string_view key, std::optional<T>&, std::string_view help, AsView asView = {}) {
    T value{};
    auto&& view = asView(value);
    add(key, {{"anyOf", Json::array({{{"type", "null"}}, objectSchema(view)})}, {"default", nullptr}}, help);
  }
  template <class T>
  void list(std::string_view key, std::vector<T>&, std::string_view help) {
    T item{};
    add(key, {{"type", "array"}, {"items", objectSchema(item)}}, help);
  }

  Json finish() {
    Json schema{{"type", "object"}, {"additionalProperties", false}, {"properties", properties_}};
    if (!requiredKeys_.empty()) {
      schema["required"] = requiredKeys_;
    }
    return schema;
  }

private:
  static Json plain(double number) {
    return std::trunc(number) == number && std::abs(number) < 1e15 ? Json(static_cast<std::int64_t>(number))
                                                                   : Json(number);
  }
  static Json components(const glm::dvec3& value) {
    return Json::array({plain(value.x), plain(value.y), plain(value.z)});
  }
  static Json numberIn(const Range& range) {
    return {{"type", "number"},
            {range.openMin ? "exclusiveMinimum" : "minimum", plain(range.min)},
            {"maximum", plain(range.max)}};
  }
  static Json wholeIn(const WholeRange& range) {
    return {{"type", "integer"}, {"minimum", range.min}, {"maximum", range.max}};
  }
  static Json listOf(const Json& item, int count) {
    return {{"type", "array"}, {"items", item}, {"minItems", count}, {"maxItems", count}};
  }
  static Json stepList() {
    TransformStep step;
    Json schema = objectSchema(step);
    schema["minProperties"] = 1;
    schema["maxProperties"] = 1;
    return {{"type", "array"}, {"items", schema}};
  }
  static std::string helpWith(const Range& range, std::string_view help) {
    return range.unit.empty() ? std::string(help) : std::string(range.unit) + ": " + std::string(help);
  }
  /// A required key has no default.
  Json withDefault(Json schema, const Json& value) const {
    if (!required_) {
      schema["default"] = value;
    }
    return schema;
  }

  template <class Enum>
  Json& choiceOf(std::string_view key, Names<Enum> names, std::string_view help) {
    Json words = Json::array();
    for (const auto& name : names) {
      words.push_back(name.first);
    }
    return add(key, {{"type", "string"}, {"enum", words}}, help);
  }

  /// A key that several types share is described by the first of them.
  Json& add(std::string_view key, Json schema, std::string_view help) {
    const bool required = std::exchange(required_, false);
    const std::string name(key);
    if (properties_.contains(name)) {
      std::string text = properties_[name]["description"].get<std::string>();
      properties_[name]["description"] = text + "; also with " + when_;
      return properties_[name];
    }
    if (required && when_.empty()) {
      requiredKeys_.push_back(name);
    }
    const std::string need = required && !when_.empty() ? "required with " : "with ";
    schema["description"] = std::string(help) + (when_.empty() ? "" : " (" + need + when_ + ")");
    return properties_[name] = std::move(schema);
  }

  Json properties_ = Json::object();
  std::vector<std::string> requiredKeys_;
  std::string when_;
  bool required_ = false;
};

template <class T>
Json objectSchema(T& object) {
  Describer describer;
  fields(describer, object);
  return describer.finish();
}

} // namespace

std::string jsonSchema() {
  Scene scene;
  Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "Tyndall scene"}};
  const Json root = objectSchema(scene);
  schema.update(root);
  schema["properties"]["$schema"] = {{"type", "string"}, {"description", "for editors; not used"}};
  return schema.dump(2) + '\n';
}

} // namespace tyndall::scene
