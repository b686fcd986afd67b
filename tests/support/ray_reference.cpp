// SPDX-License-Identifier: Apache-2.0
#include "support/ray_reference.h"

#include "support/ray_reference_media.h"
#include "verify/oracle_phase.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tyndall::test {
namespace {

/// One ray's integral, by pieces without kinks.
class RayIntegral {
public:
  RayIntegral(const Stage& stage, const OracleRay& ray);
  double value();

private:
  struct Piece {
    double begin = 0.0;
    double end = 0.0;
    double depth = 0.0; ///< optical depth from the ray's origin to `begin`
    double value = 0.0;
    double roughness = 0.0; ///< size of its top Legendre coefficients, in the unit of `value`
  };
  /// A medium inside a piece.
  struct Active {
    const LocalMedium* medium;
    const float* corners; ///< of the piece's cell; null: homogeneous
    OracleRay inCell;
    double extinction(double t) const {
      return medium->sigma * (corners == nullptr ? 1.0 : DecodedGrid::densityIn(corners, pointAt(inCell, t)));
    }
    double depth(double a, double b) const {
      return medium->sigma * (corners == nullptr ? b - a : cellDepth(corners, inCell, a, b));
    }
  };
  /// Part of the ray whose light comes through a medium's box.
  struct Shadow {
    const LocalMedium* medium;
    glm::dvec2 span;
    double piecesPerLength;
  };

  void addShadow(const LocalMedium& medium, const OracleRay& local, const LocalLight& light);
  void addPlanes(const OracleRay& local, const Bounds3& box, const glm::dvec2& span);
  void addAngles(const LocalLight& light);
  void enter(double t);
  double depth(double a, double b) const;
  double scattered(double t) const;
  Piece estimate(double begin, double end, double depthBefore);
  void firstPieces(std::vector<Piece>& pieces);

  const Stage& stage_;
  const OracleRay& ray_;
  double end_ = 0.0;
  std::vector<OracleRay> local_;  ///< the ray seen by each medium
  std::vector<glm::dvec2> spans_; ///< part of the ray in each medium
  std::vector<double> cuts_;
  std::vector<Shadow> shadows_;
  std::vector<Active> active_; ///< media of the piece at hand
};

RayIntegral::RayIntegral(const Stage& stage, const OracleRay& ray) : stage_(stage), ray_(ray) {
  for (const LocalMedium& medium : stage.media) {
    local_.push_back(through(medium.localFromWorld, ray));
    spans_.push_back(medium.span(local_.back(), medium.box.empty() ? kOpaque / medium.sigma : kInfinity));
    if (spans_.back().x < spans_.back().y) {
      cuts_.insert(cuts_.end(), {spans_.back().x, spans_.back().y});
      end_ = std::max(end_, spans_.back().y);
    }
  }
  for (std::size_t m = 0; m < stage.media.size(); ++m) {
    for (const LocalLight& light : stage.lights) {
      addShadow(stage.media[m], local_[m], light);
    }
  }
  for (const LocalLight& light : stage.lights) {
    addAngles(light);
  }
  std::sort(cuts_.begin(), cuts_.end());
}

void RayIntegral::addShadow(const LocalMedium& medium, const OracleRay& local, const LocalLight& light) {
  const glm::dvec2 span = medium.box.empty() ? glm::dvec2(0.0) : medium.shadow(local, light, end_, cuts_);
  if (span.x < span.y) {
    shadows_.push_back({&medium, span, glm::length(local.direction) / medium.longest});
    if (medium.grid) {
      addPlanes(local, medium.box, span);
    }
  }
}

void RayIntegral::addPlanes(const OracleRay& local, const Bounds3& box, const glm::dvec2& span) {
  for (int axis = 0; axis < 3; ++axis) {
    for (double plane = box.min[axis]; local.direction[axis] != 0.0 && plane <= box.max[axis]; plane += 1.0) {
      const double t = (plane - local.origin[axis]) / local.direction[axis];
      if (t > span.x && t < span.y) {
        cuts_.push_back(t);
      }
    }
  }
}

/// Equal steps of the angle seen from a point light.
void RayIntegral::addAngles(const LocalLight& light) {
  const double foot = glm::dot(light.place - ray_.origin, ray_.direction);
  const double distance = glm::distance(light.place, pointAt(ray_, foot));
  for (double angle = 0.0; light.point && angle < 0.5 * std::numbers::pi; angle += stage_.settings.angle) {
    for (const double t : {foot - distance * std::tan(angle), foot + distance * std::tan(angle)}) {
      if (t > 0.0 && t < end_) {
        cuts_.push_back(t);
      }
    }
  }
}

/// Finds the media around x(t), which is inside a piece.
void RayIntegral::enter(double t) {
  active_.clear();
  for (std::size_t m = 0; m < local_.size(); ++m) {
    const LocalMedium& medium = stage_.media[m];
    if (t <= spans_[m].x || t >= spans_[m].y) {
      continue;
    }
    if (!medium.grid) {
      active_.push_back({&medium, nullptr, {}});
      continue;
    }
    // A ray along the box's upper side belongs to its last cells.
    const glm::dvec3 cell = glm::clamp(glm::floor(pointAt(local_[m], t)), medium.box.min, medium.box.max - 1.0);
    if (const float* corners = medium.grid->corners(glm::ivec3(cell))) {
      active_.push_back({&medium, corners, {local_[m].origin - cell, local_[m].direction}});
    }
  }
}

double RayIntegral::depth(double a, double b) const {
  double sum = 0.0;
  for (const Active& active : active_) {
    sum += active.depth(a, b);
  }
  return sum;
}

/// Radiance scattered towards the ray's origin at x(t), per length, before it is dimmed on its way there.
double RayIntegral::scattered(double t) const {
  double sum = 0.0;
  const glm::dvec3 x = pointAt(ray_, t);
  for (const LocalLight& light : stage_.lights) {
    const glm::dvec3 toLight = light.point ? light.place - x : light.place;
    const double distance = glm::length(toLight);
    const OracleRay shadow{x, toLight / distance};
    const double cosine = glm::dot(ray_.direction, shadow.direction);
    double coupling = 0.0;
    for (const Active& active : active_) {
      coupling += active.medium->albedo * active.extinction(t) * phaseOracle(active.medium->values->phase, cosine);
    }
    double depth = coupling > 0.0 ? 0.0 : kInfinity;
    for (std::size_t m = 0; m < local_.size() && depth < kOpaque; ++m) {
      const LocalMedium& medium = stage_.media[m];
      depth += medium.depth(through(medium.localFromWorld, shadow), light.point ? distance : kInfinity);
    }
    sum += depth < kOpaque ? coupling * light.strength / (distance * distance) * std::exp(-depth) : 0.0;
  }
  return sum;
}

RayIntegral::Piece RayIntegral::estimate(double begin, double end, double depthBefore) {
  Piece piece{.begin = begin, .end = end, .depth = depthBefore};
  enter(0.5 * (begin + end));
  const double length = end - begin;
  glm::dvec2 top(0.0);
  for (std::size_t i = 0; i < stage_.rule->nodes.size(); ++i) {
    const double t = begin + stage_.rule->nodes[i] * length;
    const double part = length * stage_.rule->weights[i] * scattered(t) * std::exp(-depthBefore - depth(begin, t));
    piece.value += part;
    top += part * glm::dvec2(stage_.legendre[0][i], stage_.legendre[1][i]);
  }
  // Two of them: a kink may hide from the even or from the odd ones.
  piece.roughness = std::max(std::abs(top.x), std::abs(top.y));
  return piece;
}

void RayIntegral::firstPieces(std::vector<Piece>& pieces) {
  double before = 0.0;
  double t = 0.0;
  for (const double cut : cuts_) {
    if (cut <= t) {
      continue;
    }
    const double end = std::min(cut, end_);
    const double middle = 0.5 * (t + end);
    enter(middle);
    double parts = depth(t, end) / stage_.settings.opticalDepth;
    for (const Shadow& shadow : shadows_) {
      const bool near = middle > shadow.span.x && middle < shadow.span.y;
      parts = near ? std::max(parts, (end - t) * shadow.piecesPerLength) : parts;
    }
    const double begin = t;
    for (double i = 1.0; i <= std::max(1.0, std::ceil(parts)) && !active_.empty() && before < kOpaque; i += 1.0) {
      const double next = begin + (end - begin) * i / std::max(1.0, std::ceil(parts));
      pieces.push_back(estimate(t, next, before));
      before += depth(t, next);
      t = next;
    }
    t = end;
  }
}

double RayIntegral::value() {
  std::vector<Piece> pieces;
  firstPieces(pieces);
  double sum = 0.0;
  for (const Piece& piece : pieces) {
    sum += piece.value;
  }
  while (!pieces.empty()) {
    const Piece piece = pieces.back();
    pieces.pop_back();
    const double middle = 0.5 * (piece.begin + piece.end);
    if (piece.roughness <= stage_.settings.roughness * sum || piece.end - piece.begin < 1e-10 * end_) {
      continue;
    }
    pieces.push_back(estimate(piece.begin, middle, piece.depth));
    const double firstHalf = pieces.back().value;
    pieces.push_back(estimate(middle, piece.end, piece.depth + depth(piece.begin, middle)));
    sum += firstHalf + pieces.back().value - piece.value;
  }
  return sum;
}

} // namespace

std::vector<double> singleScattering(const scene::Scene& scene, const gpu_scene::VolumeSet& volumes,
                                     std::span<const OracleRay> rays, const RayReferenceSettings& settings) {
  const Stage stage = makeStage(scene, volumes, settings);
  std::vector<double> radiances(rays.size());
  tbb::parallel_for(std::size_t(0), rays.size(),
                    [&](std::size_t i) { radiances[i] = RayIntegral(stage, rays[i]).value(); });
  return radiances;
}

} // namespace tyndall::test
