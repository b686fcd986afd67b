// SPDX-License-Identifier: Apache-2.0
#include "scene/file_reference.h"

#include "base/error.h"

#include <unistd.h>

namespace tyndall::scene {
namespace fs = std::filesystem;
namespace {

bool isSequence(const std::string& name) { return name.find_first_of("#%") != std::string::npos; }

/// A file in the same folder whose name is near, as it would have to be written; empty if none is.
std::string nearestFile(const fs::path& path, const std::string& name) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (auto entry = fs::directory_iterator(path.parent_path().empty() ? "." : path.parent_path(), ignored);
       !ignored && entry != fs::directory_iterator(); entry.increment(ignored)) {
    names.push_back(entry->path().filename().string());
  }
  const std::string nearest = nearestName(path.filename().string(), names);
  return nearest.empty() ? "" : (fs::path(name).parent_path() / nearest).string();
}

} // namespace

FileReference resolveFile(const std::string& name, const fs::path& folder) {
  if (name.find('\0') != std::string::npos) {
    return {name, "a file name cannot hold the character 0"};
  }
  FileReference result{.path = (folder / name).lexically_normal(), .problem = {}};
  std::error_code ignored;
  const fs::path parent = result.path.parent_path().empty() ? fs::path(".") : result.path.parent_path();
  if (!fs::is_directory(parent, ignored)) {
    result.problem = fmt::format("there is no folder {}; file names are relative to {}", parent.string(),
                                 folder.empty() ? "the working folder" : "the scene file's folder");
  } else if (isSequence(result.path.filename().string())) {
    return result;
  } else if (!fs::exists(result.path, ignored)) {
    const std::string nearest = nearestFile(result.path, name);
    result.problem = nearest.empty()
                         ? fmt::format("there is no file {}; put it there or correct the name", result.path.string())
                         : fmt::format("there is no file {}; did you mean \"{}\"?", result.path.string(), nearest);
  } else if (!fs::is_regular_file(result.path, ignored)) {
    result.problem = fmt::format("{} is not a file; name a file", result.path.string());
  } else if (::access(result.path.c_str(), R_OK) != 0) {
    result.problem = fmt::format("{} cannot be read; check its permissions", result.path.string());
  }
  return result;
}

std::string relativeName(const std::string& file, const fs::path& folder) {
  const fs::path absolute = fs::absolute(file).lexically_normal();
  const fs::path from = fs::absolute(folder.empty() ? fs::path(".") : folder).lexically_normal();
  return absolute.lexically_relative(from).generic_string();
}

void mapFileNames(json::Value& value, bool isName, const std::function<std::string(const json::Value&)>& replacement) {
  if (isName && value.kind == json::Kind::String) {
    value.text = replacement(value);
  }
  for (json::Value& item : value.items) {
    mapFileNames(item, false, replacement);
  }
  for (json::Member& member : value.members) {
    mapFileNames(member.value, member.key == "file", replacement);
  }
}

} // namespace tyndall::scene
