// SPDX-License-Identifier: Apache-2.0
#include "geometry/load_gltf_parts.h"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <ranges>

/// Animations of glTF (glTF 2.0, 3.11 and appendix C): nodes are put to where they are at a time.
namespace tyndall::geometry {
namespace {

/// A sampler's keys. A cubic spline has three values a key: the tangent before, the value, the tangent behind.
struct Curve {
  std::vector<float> times;
  std::vector<float> values;
  std::size_t components = 3;
  bool step = false;
  bool cubic = false;

  bool sound() const { return !times.empty() && values.size() == times.size() * components * (cubic ? 3 : 1); }
  /// @param part of a cubic spline's key: 0, 1 or 2
  double at(std::size_t key, std::size_t component, std::size_t part = 1) const {
    return double(values[(cubic ? 3 * key + part : key) * components + component]);
  }
};

glm::dquat turnAt(const Curve& curve, std::size_t key) {
  return glm::normalize(glm::dquat(curve.at(key, 3), curve.at(key, 0), curve.at(key, 1), curve.at(key, 2)));
}

/// Between a key and the next one, which is `seconds` later. @param t share of the way.
std::vector<double> between(const Curve& curve, std::size_t key, double t, double seconds) {
  std::vector<double> result(curve.components);
  if (curve.components == 4 && !curve.cubic) {
    const glm::dquat turn = glm::slerp(turnAt(curve, key), turnAt(curve, key + 1), t);
    return {turn.x, turn.y, turn.z, turn.w};
  }
  const double t2 = t * t;
  const double t3 = t2 * t;
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = curve.cubic
                    ? (2.0 * t3 - 3.0 * t2 + 1.0) * curve.at(key, i) +
                          seconds * (t3 - 2.0 * t2 + t) * curve.at(key, i, 2) +
                          (3.0 * t2 - 2.0 * t3) * curve.at(key + 1, i) + seconds * (t3 - t2) * curve.at(key + 1, i, 0)
                    : (1.0 - t) * curve.at(key, i) + t * curve.at(key + 1, i);
  }
  return result;
}

std::vector<double> valueAt(const Curve& curve, double seconds) {
  const auto next = std::ranges::upper_bound(curve.times, static_cast<float>(seconds));
  const auto following = static_cast<std::size_t>(next - curve.times.begin());
  const std::size_t key = following == 0 ? 0 : following - 1;
  const bool held = following == 0 || following == curve.times.size() || curve.step;
  const double length = held ? 0.0 : double(curve.times[following]) - double(curve.times[key]);
  if (length > 0.0) {
    return between(curve, key, std::clamp((seconds - double(curve.times[key])) / length, 0.0, 1.0), length);
  }
  std::vector<double> result(curve.components);
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = curve.at(key, i);
  }
  return result;
}

/// What a channel moves of its node; nullptr: something that is passed over.
std::vector<double>* targetOf(tinygltf::Model& source, const tinygltf::AnimationChannel& channel) {
  if (channel.target_node < 0 || static_cast<std::size_t>(channel.target_node) >= source.nodes.size()) {
    return nullptr;
  }
  tinygltf::Node& node = source.nodes[static_cast<std::size_t>(channel.target_node)];
  if (!node.matrix.empty()) {
    return nullptr;
  }
  return channel.target_path == "translation" ? &node.translation
         : channel.target_path == "rotation"  ? &node.rotation
         : channel.target_path == "scale"     ? &node.scale
                                              : nullptr;
}

/// Whether the channel was followed.
bool follow(tinygltf::Model& source, const tinygltf::Animation& animation, const tinygltf::AnimationChannel& channel,
            double seconds) {
  std::vector<double>* target = targetOf(source, channel);
  if (target == nullptr || channel.sampler < 0 ||
      static_cast<std::size_t>(channel.sampler) >= animation.samplers.size()) {
    return false;
  }
  const tinygltf::AnimationSampler& sampler = animation.samplers[static_cast<std::size_t>(channel.sampler)];
  const int components = channel.target_path == "rotation" ? 4 : 3;
  const Curve curve{.times = readFloats(source, sampler.input, 1),
                    .values = readFloats(source, sampler.output, components),
                    .components = static_cast<std::size_t>(components),
                    .step = sampler.interpolation == "STEP",
                    .cubic = sampler.interpolation == "CUBICSPLINE"};
  if (curve.sound()) {
    *target = valueAt(curve, seconds);
  }
  return curve.sound();
}

} // namespace

void poseGltf(tinygltf::Model& source, double seconds, Model& model) {
  std::size_t passed = 0;
  // All at once; of those that move the same, the first one has the last word.
  for (const tinygltf::Animation& animation : source.animations | std::views::reverse) {
    for (const tinygltf::AnimationChannel& channel : animation.channels) {
      passed += follow(source, animation, channel, seconds) ? 0 : 1;
    }
  }
  if (passed > 0) {
    model.warnings.push_back(fmt::format("{} channels of animations are passed over: they move no node's translation, "
                                         "rotation or scale, or have no sound keys.",
                                         passed));
  }
}

} // namespace tyndall::geometry
