// SPDX-License-Identifier: Apache-2.0
#include "scene/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tyndall::scene {
namespace {

/// The determinant of the linear part relative to the product of its columns' lengths: 0 = flat, 1 = orthogonal.
double relativeDeterminant(const glm::dmat4& matrix) {
  const glm::dmat3 linear(matrix);
  const double lengths = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
  return lengths > 0.0 ? std::abs(glm::determinant(linear)) / lengths : 0.0;
}

glm::dmat4 stepMatrix(const TransformStep& step) {
  glm::dmat4 translation(1.0);
  translation[3] = glm::dvec4(step.translate, 1.0);
  // Rodrigues: R = cos I + sin [a]x + (1 - cos) a a^T, so that +90 degrees about +z takes +x to +y.
  const double angle = glm::radians(step.rotate.degrees);
  const glm::dvec3 a = step.rotate.axis;
  const glm::dmat3 cross(0.0, a.z, -a.y, -a.z, 0.0, a.x, a.y, -a.x, 0.0);
  const glm::dmat3 rotation =
      std::cos(angle) * glm::dmat3(1.0) + std::sin(angle) * cross + (1.0 - std::cos(angle)) * glm::outerProduct(a, a);
  glm::dmat4 scaling(1.0);
  for (int axis = 0; axis < 3; ++axis) {
    scaling[axis][axis] = step.scale[axis];
  }
  return translation * glm::dmat4(rotation) * scaling * step.matrix; // one of them differs from the identity
}

} // namespace

void Reader::matrix(std::string_view key, glm::dmat4& target, std::string_view) {
  const json::Value* value = take(key);
  if (value == nullptr) {
    return;
  }
  const std::vector<json::Value>& items = value->items;
  const auto isNumber = [](const json::Value& item) {
    return item.kind == json::Kind::Number && std::abs(item.number) <= kLargestLength;
  };
  if (items.size() != 16 || !std::all_of(items.begin(), items.end(), isNumber)) {
    return reject(*value, key, "16 numbers, row by row, none beyond 1e9");
  }
  glm::dmat4 read;
  for (std::size_t i = 0; i < 16; ++i) {
    read[static_cast<int>(i % 4)][static_cast<int>(i / 4)] = items[i].number; // GLM: [column][row]
  }
  if (glm::transpose(read)[3] != glm::dvec4(0.0, 0.0, 0.0, 1.0)) {
    context_.findings.error(items[12].position, pathOf(key),
                            "must end with the row 0, 0, 0, 1: numbers stand row by row, and a translation stands at "
                            "the end of the first three rows");
    return;
  }
  target = read;
}

glm::dmat4 Reader::composed(const json::Value& steps, const std::string& path) {
  glm::dmat4 product(1.0);
  for (std::size_t i = 0; i < steps.items.size(); ++i) {
    const json::Value& item = steps.items[i];
    const std::string stepPath = fmt::format("{}.{}", path, i);
    TransformStep step;
    readObject(item, stepPath, step);
    if (context_.findings.errorIn(stepPath)) {
      continue;
    }
    if (item.members.size() != 1) {
      context_.findings.error(item.position, stepPath,
                              "must have one of translate, rotate, scale or matrix; "
                              "put further steps into objects of their own");
      continue;
    }
    product = stepMatrix(step) * product;
    if (relativeDeterminant(stepMatrix(step)) < 1e-12) {
      context_.findings.error(item.position, stepPath,
                              "flattens space (it cannot be inverted); no factor may be 0, and "
                              "the rows of a matrix must be independent");
    }
  }
  const double size = std::cbrt(std::abs(glm::determinant(glm::dmat3(product))));
  if (!context_.findings.errorIn(path) && !(size > 1e-12 && size < 1e12)) {
    context_.findings.error(steps.position, path,
                            fmt::format("scales by {:.3g} in all; keep it between 1e-12 and 1e12", size));
  }
  return product;
}

void Reader::transform(std::string_view key, glm::dmat4& targetFromSource, std::string_view) {
  const json::Value* value = take(key);
  if (value != nullptr && isList(*value, pathOf(key))) {
    targetFromSource = composed(*value, pathOf(key));
  }
}

void Reader::transforms(std::string_view key, std::vector<glm::dmat4>& targetFromSource, std::string_view) {
  const json::Value* value = take(key);
  if (value == nullptr || !isList(*value, pathOf(key))) {
    return;
  }
  targetFromSource.assign(value->items.size(), glm::dmat4(1.0));
  for (std::size_t i = 0; i < targetFromSource.size(); ++i) {
    const std::string path = fmt::format("{}.{}", pathOf(key), i);
    if (isList(value->items[i], path)) {
      targetFromSource[i] = composed(value->items[i], path);
    }
  }
}

} // namespace tyndall::scene
