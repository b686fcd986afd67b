// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "material/list.h"
#include "phase/list.h"
#include "scene/ranges.h"
#include "scene/scene.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

/// The words of a scene file for types and choices.
namespace tyndall::scene {

template <class Enum, std::size_t N>
using NameTable = std::array<std::pair<std::string_view, Enum>, N>;

inline constexpr NameTable<Camera::Kind, 3> kCameraTypes{{{"perspective", Camera::Kind::Perspective},
                                                          {"orthographic", Camera::Kind::Orthographic},
                                                          {"file", Camera::Kind::File}}};
inline constexpr NameTable<View, 2> kViews{{{"standard", View::Standard}, {"filmic", View::Filmic}}};
inline constexpr NameTable<MediumShape, 4> kShapeTypes{{{"unbounded", MediumShape::Unbounded},
                                                        {"box", MediumShape::Box},
                                                        {"sphere", MediumShape::Sphere},
                                                        {"objects", MediumShape::Objects}}};
inline constexpr NameTable<Emission::Kind, 2> kEmissionTypes{
    {{"linear", Emission::Kind::Linear}, {"blackbody", Emission::Kind::Blackbody}}};
inline constexpr NameTable<bool, 2> kMediumTypes{{{"homogeneous", true}, {"grid", false}}};
inline constexpr NameTable<Object::Kind, 4> kObjectTypes{{{"mesh", Object::Kind::Mesh},
                                                          {"quad", Object::Kind::Quad},
                                                          {"box", Object::Kind::Box},
                                                          {"sphere", Object::Kind::Sphere}}};
inline constexpr NameTable<Integrator, 4> kIntegrators{{{"path", Integrator::Path},
                                                        {"screen-chains", Integrator::ScreenChains},
                                                        {"mcpg-paper", Integrator::McpgPaper},
                                                        {"mcpg", Integrator::Mcpg}}};
inline constexpr NameTable<GuideWeight, 3> kGuideWeights{{{"accepted", GuideWeight::Accepted},
                                                           {"forgets", GuideWeight::Forgets},
                                                           {"mean", GuideWeight::Mean}}};
inline constexpr NameTable<GuideScore, 2> kGuideScores{{{"path", GuideScore::Path}, {"cache", GuideScore::Cache}}};
inline constexpr NameTable<Interpolation, 2> kInterpolations{
    {{"linear", Interpolation::Linear}, {"step", Interpolation::Step}}};
inline constexpr std::array kMaterialTypes{
#define X(Name, prefix, id, sceneName) std::pair<std::string_view, MaterialId>{sceneName, MaterialId::Name},
    TYNDALL_MATERIAL_LIST(X)
#undef X
};
inline constexpr std::array<std::string_view, 4> kStorages{"auto", "unorm8", "half", "float"};

/// A light's type is the index of its alternative in Light.
inline constexpr NameTable<std::size_t, 6> kLightTypes{
    {{"point", 0}, {"sun", 1}, {"constant", 2}, {"map", 3}, {"sky", 4}, {"spot", 5}}};
static_assert(kLightTypes.size() == std::variant_size_v<Light>);

struct PhaseName {
  std::string_view name;
  PhaseId id;
  std::string_view parameters; ///< in order, blank-separated
};
inline constexpr std::array kPhases{
#define X(Name, prefix, number, sceneName, parameterNames) PhaseName{sceneName, PhaseId::Name, parameterNames},
    TYNDALL_PHASE_LIST(X)
#undef X
};
inline constexpr auto kPhaseTypes = [] {
  NameTable<PhaseId, kPhases.size()> names{};
  for (std::size_t i = 0; i < names.size(); ++i) {
    names[i] = {kPhases[i].name, kPhases[i].id};
  }
  return names;
}();

/// Calls action(name, index) for each parameter of a phase function.
template <class Action>
void forEachParameter(std::string_view parameters, Action action) {
  for (std::size_t index = 0; !parameters.empty(); ++index) {
    const std::size_t end = std::min(parameters.find(' '), parameters.size());
    action(parameters.substr(0, end), index);
    parameters.remove_prefix(std::min(end + 1, parameters.size()));
  }
}

/// The word for a value of a table.
template <class Enum, std::size_t N>
constexpr std::string_view nameOf(const NameTable<Enum, N>& names, Enum wanted) {
  for (const auto& [word, value] : names) {
    if (value == wanted) {
      return word;
    }
  }
  return "";
}

} // namespace tyndall::scene
