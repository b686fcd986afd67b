// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

/// What a key of the scene file may hold.
namespace tyndall::scene {

/// Numbers from min to max; an open minimum is itself not allowed.
struct Range {
  double min;
  double max;
  std::string_view unit = "";
  bool openMin = false;
};

struct WholeRange {
  std::uint32_t min;
  std::uint32_t max;
};

/// The words of a scene file for the values of an enum.
template <class Enum>
using Names = std::span<const std::pair<std::string_view, Enum>>;

// The device works in float relative to the scene's centre: these keep every product well inside its range.
inline constexpr double kLargestLength = 1e9;      ///< scene units
inline constexpr double kLargestLight = 1e15;      ///< any light unit
inline constexpr double kLargestExtinction = 1e10; ///< 1 / scene unit

inline constexpr Range kLight{0.0, kLargestLight};
inline constexpr Range kFraction{0.0, 1.0};
inline constexpr Range kExtinction{0.0, kLargestExtinction, "1 / scene unit"};
inline constexpr Range kPositiveLength{0.0, kLargestLength, "scene units", true};
inline constexpr Range kIor{1.0, 4.0};
inline constexpr Range kMetal{0.0, 100.0}; ///< eta and k of metals: below 20 in visible light
inline constexpr Range kKelvin{0.0, 1e6, "kelvin", true};

/// The range of a phase function's parameter, by its name in phase/list.h.
constexpr Range phaseParameterRange(std::string_view name) {
  if (name == "g" || name == "g1" || name == "g2") {
    return {-0.9999, 0.9999}; // beyond it a float cannot hold the lobe
  }
  if (name == "weight") {
    return kFraction;
  }
  if (name == "alpha") {
    return {0.0, 1000.0};
  }
  if (name == "diameter") {
    return {5.0, 50.0, "micrometres"}; // where the fit of Jendersie and d'Eon (2023) holds
  }
  return {0.0, 0.0}; // an unknown name: phase_test fails on it
}

} // namespace tyndall::scene
