// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "math/bounds.h"
#include "scene/ranges.h"

/// The keys of what lies in space: steps of a transform, boxes. See fields.h.
namespace tyndall::scene {

/// One step of a transform list; a step has exactly one of its keys.
struct TransformStep {
  struct Rotation {
    glm::dvec3 axis{0.0, 1.0, 0.0};
    double degrees = 0.0;
  };
  glm::dvec3 translate{0.0};
  Rotation rotate;
  glm::dvec3 scale{1.0};
  glm::dmat4 matrix{1.0};
};

template <class V>
void fields(V& v, TransformStep::Rotation& rotation) {
  v.required().direction("axis", rotation.axis, "of the rotation; it turns counterclockwise seen from its tip");
  v.required().number("degrees", rotation.degrees, Range{-1e6, 1e6, "degrees"}, "angle");
}

template <class V>
void fields(V& v, TransformStep& step) {
  v.point("translate", step.translate, "added to the position, scene units");
  v.object("rotate", step.rotate, "about an axis through the origin");
  v.triple("scale", step.scale, Range{-kLargestLength, kLargestLength}, "one factor, or one per axis; not 0");
  v.matrix("matrix", step.matrix, "16 numbers, row by row; the last row is 0 0 0 1");
}

template <class V>
void fields(V& v, Bounds3& bounds) {
  v.required().point("min", bounds.min, "the corner with the smallest coordinates");
  v.required().point("max", bounds.max, "the corner with the largest coordinates");
}

} // namespace tyndall::scene
