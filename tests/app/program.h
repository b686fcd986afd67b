// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

namespace tyndall::test {

/// How a run of the program ended.
struct Outcome {
  int exitCode = -1;     ///< -1 if a signal ended it
  int signal = 0;        ///< 0 if it exited by itself
  bool timedOut = false; ///< it was ended for taking longer than kTimeoutSeconds
  std::string output;    ///< stdout
  std::string errors;    ///< stderr
};

inline constexpr int kTimeoutSeconds = 30;

/// Runs the built program in `folder`. @param environment additional "NAME=value" entries.
Outcome runProgram(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                   const std::vector<std::string>& environment = {});

/// Starts the built program in `folder` and leaves it running; for waitpid.
pid_t startProgram(std::vector<std::string> arguments, const std::filesystem::path& folder);

/// Words of a command line; {in} becomes the path of `inputs`. No quoting.
std::vector<std::string> wordsOf(const std::string& line, const std::filesystem::path& inputs);

/// Names of everything in the folder, sorted.
std::vector<std::string> namesIn(const std::filesystem::path& folder);

void writeFile(const std::filesystem::path& path, const std::string& bytes);
std::string bytesOf(const std::filesystem::path& path);

} // namespace tyndall::test
