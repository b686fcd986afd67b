// SPDX-License-Identifier: Apache-2.0
#include "scene/load.h"

#include "base/file.h"
#include "scene/animation.h"
#include "scene/checks.h"
#include "scene/file_camera.h"
#include "scene/overrides.h"
#include "scene/reader.h"

#include <algorithm>
#include <tuple>

namespace tyndall::scene {
namespace fs = std::filesystem;
namespace {

/// Far above any scene: a file of this size is something else.
constexpr std::uintmax_t kLargestFile = 4u << 20;

Problem problemOf(const Finding& finding, const std::string& name, const std::vector<Override>& overrides) {
  Problem problem{.location = {name, finding.position.line, finding.position.column},
                  .message = finding.path.empty() ? finding.message : finding.path + ": " + finding.message,
                  .warning = finding.warning};
  if (finding.position.override >= 0) {
    problem.location = {inWords(overrides[static_cast<std::size_t>(finding.position.override)]), 0, 0};
  }
  return problem;
}

std::vector<Problem> problemsOf(std::vector<Finding> findings, const std::string& name,
                                const std::vector<Override>& overrides) {
  const auto place = [](const Finding& finding) {
    return std::tuple(finding.position.override, finding.position.line, finding.position.column);
  };
  std::stable_sort(findings.begin(), findings.end(),
                   [&](const Finding& a, const Finding& b) { return place(a) < place(b); });
  std::vector<Problem> problems;
  for (const Finding& finding : findings) {
    problems.push_back(problemOf(finding, name, overrides));
  }
  return problems;
}

LoadResult failed(const SourceLocation& location, const std::string& message) {
  Problem problem;
  problem.location = location;
  problem.message = message;
  LoadResult result;
  result.problems.push_back(problem);
  return result;
}

} // namespace

bool LoadResult::ok() const {
  return std::none_of(problems.begin(), problems.end(), [](const Problem& problem) { return !problem.warning; });
}

LoadResult parseScene(const std::string& text, const std::string& name, const fs::path& folder,
                      const std::vector<Override>& overrides, double frame) {
  json::Parsed parsed = json::parse(text);
  Findings findings;
  for (json::Mistake& mistake : parsed.mistakes) {
    findings.error(mistake.position, "", std::move(mistake.message));
  }
  LoadResult result;
  if (parsed.complete) {
    applyOverrides(overrides, parsed.root, findings);
    Animation animation = animate(parsed.root, overrides, frame, folder, findings);
    ReadContext context{.findings = findings, .folder = folder};
    readRoot(parsed.root, context, result.scene);
    result.scene.animation = std::move(animation);
    checkScene(result.scene, parsed.root, findings);
    resolveFileCamera(result.scene.camera, result.scene.animation.seconds, parsed.root, findings);
  }
  if (result.scene.name.empty()) {
    result.scene.name = fs::path(name).stem().string();
  }
  result.problems = problemsOf(findings.all(), name, overrides);
  if (result.ok()) {
    result.canonical = toJson(result.scene, folder.empty() ? fs::path(".") : folder);
  }
  return result;
}

LoadResult readScene(const fs::path& path, const std::vector<Override>& overrides, double frame) {
  const std::string name = path.string();
  std::error_code ignored;
  if (fs::is_regular_file(path, ignored) && fs::file_size(path, ignored) > kLargestFile) {
    return failed({name, 1, 1}, "is larger than 4 MB, which no scene is; name a .json scene file");
  }
  try {
    return parseScene(readTextFile(path), name, path.parent_path(), overrides, frame);
  } catch (const Error& error) {
    return failed({}, error.what());
  }
}

Scene loadScene(const fs::path& path, const std::vector<Override>& overrides) {
  LoadResult result = readScene(path, overrides);
  if (result.ok()) {
    return std::move(result.scene);
  }
  std::string text;
  for (const Problem& problem : result.problems) {
    const std::string kind = problem.warning ? "warning: " : "";
    text += (text.empty() ? "" : "\n") + std::string(Error(problem.location, kind + problem.message).what());
  }
  throw Error(text);
}

} // namespace tyndall::scene
