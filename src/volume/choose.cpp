// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "volume/load.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <tuple>

namespace tyndall::volume {
namespace {

/// What a grid's name says that it holds.
enum class Role { Density, Smoke, Temperature, Flame, Other, Unknown };

struct RoleWord {
  std::string_view word; ///< lower case; found anywhere in the name
  Role role;
};

/// In order of precedence: "flame_density" is a density, "smoke_temperature" a temperature.
constexpr std::array kRoleWords{
    RoleWord{"density", Role::Density},         RoleWord{"extinction", Role::Density},
    RoleWord{"temperature", Role::Temperature}, RoleWord{"heat", Role::Temperature},
    RoleWord{"kelvin", Role::Temperature},      RoleWord{"flame", Role::Flame},
    RoleWord{"fire", Role::Flame},              RoleWord{"burn", Role::Flame},
    RoleWord{"emission", Role::Flame},          RoleWord{"emissive", Role::Flame},
    RoleWord{"incandescence", Role::Flame},     RoleWord{"velocity", Role::Other},
    RoleWord{"pressure", Role::Other},          RoleWord{"divergence", Role::Other},
    RoleWord{"vorticity", Role::Other},         RoleWord{"curl", Role::Other},
    RoleWord{"fuel", Role::Other},              RoleWord{"collision", Role::Other},
    RoleWord{"obstacle", Role::Other},
    RoleWord{"surface", Role::Other},           RoleWord{"levelset", Role::Other},
    RoleWord{"level_set", Role::Other},         RoleWord{"distance", Role::Other},
    RoleWord{"colour", Role::Other},            RoleWord{"color", Role::Other},
    RoleWord{"shadow", Role::Other},            RoleWord{"soot", Role::Smoke},
    RoleWord{"smoke", Role::Smoke},             RoleWord{"fog", Role::Smoke},
    RoleWord{"cloud", Role::Smoke},             RoleWord{"scatter", Role::Smoke},
};

/// Names too short to look for inside others.
constexpr std::array kWholeNames{
    RoleWord{"temp", Role::Temperature}, RoleWord{"t", Role::Temperature}, RoleWord{"vel", Role::Other},
    RoleWord{"v", Role::Other},          RoleWord{"sdf", Role::Other},     RoleWord{"phi", Role::Other},
    RoleWord{"cd", Role::Other},         RoleWord{"dens", Role::Density},  RoleWord{"d", Role::Smoke},
    RoleWord{"rho", Role::Density},      RoleWord{"uv", Role::Other},      RoleWord{"id", Role::Other},
};

/// The words of a name: "Vel.x" -> "vel", "x".
std::vector<std::string> tokens(const std::string& name) {
  std::vector<std::string> result(1);
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) {
      result.emplace_back();
    } else {
      result.back() += char(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  return result;
}

Role roleOf(const std::string& name) {
  std::string lower = name;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  for (const RoleWord& entry : kRoleWords) {
    if (lower.find(entry.word) != std::string::npos) {
      return entry.role;
    }
  }
  for (const std::string& token : tokens(name)) {
    for (const RoleWord& entry : kWholeNames) {
      if (token == entry.word) {
        return entry.role;
      }
    }
  }
  return Role::Unknown;
}

struct Candidate {
  const GridInfo* grid;
  int score;          ///< higher is better
  const char* because;
};

Candidate densityCandidate(const GridInfo& grid) {
  switch (roleOf(grid.name)) {
  case Role::Density: return {&grid, 60, "by its name"};
  case Role::Smoke: return {&grid, 50, "by its name"};
  case Role::Unknown:
    if (grid.gridClass == "fog volume") {
      return {&grid, 40, "as a fog volume"};
    }
    return grid.gridClass == "level set" ? Candidate{&grid, 30, "as a level set, made into fog"}
                                         : Candidate{&grid, 35, "as the largest scalar grid"};
  case Role::Other:
    return grid.gridClass == "level set" ? Candidate{&grid, 20, "as a level set, made into fog"}
                                         : Candidate{&grid, 10, "as nothing in the file fits better"};
  case Role::Temperature:
  case Role::Flame: break;
  }
  return {&grid, 0, ""};
}

Candidate emissionCandidate(const GridInfo& grid) {
  const Role role = roleOf(grid.name);
  return {&grid, role == Role::Temperature ? 2 : role == Role::Flame ? 1 : 0, "by its name"};
}

/// The best candidate with a score above 0: filled before empty, then score, then size, then file order.
template <class Rate> Candidate best(const FileInfo& info, const Rate& rate) {
  Candidate winner{nullptr, 0, ""};
  for (const GridInfo& grid : info.grids) {
    const Candidate next = grid.scalar ? rate(grid) : Candidate{nullptr, 0, ""};
    if (next.score == 0) {
      continue;
    }
    const auto rank = [](const Candidate& c) {
      return std::tuple(!c.grid->empty(), c.score, c.grid->activeVoxels);
    };
    if (winner.grid == nullptr || rank(next) > rank(winner)) {
      winner = next;
    }
  }
  return winner;
}

std::vector<std::string> describedNames(const FileInfo& info, bool scalarOnly) {
  std::vector<std::string> names;
  for (const GridInfo& grid : info.grids) {
    if (!scalarOnly || grid.scalar) {
      names.push_back(fmt::format("'{}' ({})", grid.name, grid.scalar ? grid.type : grid.whyNot));
    }
  }
  return names;
}

} // namespace

GridChoice chooseGrids(const FileInfo& info) {
  if (info.grids.empty()) {
    fail("{}: holds no grids; export the volume again with its density grid", info.path);
  }
  const std::vector<std::string> scalars = describedNames(info, true);
  if (scalars.empty()) {
    fail("{}: no grid in it can be rendered: {}; export a scalar grid such as 'density' from the program that made it",
         info.path, joinNames(describedNames(info, false)));
  }
  const Candidate density = best(info, densityCandidate);
  const Candidate emission = best(info, emissionCandidate);
  GridChoice choice;
  if (density.grid != nullptr) {
    choice.density = density.grid->name;
    const char* because = scalars.size() == 1 ? "as the only scalar grid" : density.because;
    choice.reason = fmt::format("density from grid '{}', chosen {}", choice.density, because);
    if (density.grid->empty()) {
      choice.reason += " (it is empty)";
    }
  } else {
    choice.reason = "no grid is a density";
  }
  if (emission.grid != nullptr) {
    choice.temperature = emission.grid->name;
    choice.reason += fmt::format("; emission from grid '{}'", choice.temperature);
  }
  if (scalars.size() > 1) {
    choice.reason += fmt::format("; the file has {}", joinNames(scalars));
  }
  return choice;
}

} // namespace tyndall::volume
