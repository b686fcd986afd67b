// SPDX-License-Identifier: Apache-2.0
#include "app/commands.h"
#include "app/device_options.h"
#include "app/frames.h"
#include "app/mesh_input.h"
#include "app/reference_check.h"
#include "base/error.h"
#include "scene/load.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <tuple>

namespace tyndall::app {
namespace {

namespace fs = std::filesystem;

/// Whether `known`, maybe of another frame, is the same one.
bool sameProblem(const scene::Problem& known, const scene::Problem& problem) {
  return known.location.line == problem.location.line && known.location.column == problem.location.column &&
         known.message.ends_with(problem.message);
}

/// Those of all frames that have a key, each once.
std::vector<scene::Problem> problemsOfText(const std::string& path) {
  const scene::LoadResult result = scene::readScene(path);
  std::vector<scene::Problem> problems = result.problems;
  for (const double frame : scene::keyFrames(result.scene.animation)) {
    for (scene::Problem& problem : scene::readScene(path, {}, frame).problems) {
      if (std::none_of(problems.begin(), problems.end(),
                       [&](const scene::Problem& known) { return sameProblem(known, problem); })) {
        problem.message = inFrame(frame, problem.message);
        problems.push_back(std::move(problem));
      }
    }
  }
  return problems;
}

/// The text's own problems and those of the files that it names, in file order.
std::vector<scene::Problem> problemsOf(const std::string& path) {
  std::vector<scene::Problem> problems = problemsOfText(path);
  const bool readable = std::none_of(problems.begin(), problems.end(),
                                     [](const scene::Problem& problem) { return problem.location.file.empty(); });
  if (readable) {
    const std::vector<scene::Problem> more = checkReferences(path);
    problems.insert(problems.end(), more.begin(), more.end());
  }
  std::stable_sort(problems.begin(), problems.end(), [](const scene::Problem& a, const scene::Problem& b) {
    return std::tuple(a.location.line, a.location.column) < std::tuple(b.location.line, b.location.column);
  });
  return problems;
}

int checkCommand(const std::string& path) {
  if (path.ends_with(".vdb")) {
    fail("{}: is a volume, not a scene; see what it holds with: tyndall info {}", path, path);
  }
  if (isMesh(path)) {
    fail("{}", meshAdvice(path));
  }
  if (!path.ends_with(".json")) {
    fail("{}: is not a scene; name a .json file", path);
  }
  const std::vector<scene::Problem> problems = problemsOf(path);
  std::size_t errors = 0;
  for (const scene::Problem& problem : problems) {
    errors += problem.warning ? 0 : 1;
    const std::string kind = problem.warning ? "warning: " : "error: ";
    fmt::print(stderr, "{}\n", Error(problem.location, kind + problem.message).what());
  }
  if (errors > 0) {
    fmt::print("{}: {} error(s), {} warning(s)\n", path, errors, problems.size() - errors);
    return kFailed;
  }
  fmt::print("{}: sound{}\n", path, problems.empty() ? "" : fmt::format(", {} warning(s)", problems.size()));
  return kDone;
}

} // namespace

void addCheckCommand(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("check", "Find every mistake in a scene (.json) and in the files it names, without rendering");
  auto path = std::make_shared<std::string>();
  command->add_option("scene", *path, "Scene (.json)")->required()->type_name("FILE");
  command->callback([path, &action] { action = [path] { return checkCommand(*path); }; });
}

} // namespace tyndall::app
