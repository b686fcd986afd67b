// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tyndall::bench {

/// How a program ran, with all that it started and waited for.
struct ProcessOutcome {
  int exitCode = -1; ///< -1: a signal ended it, or it took longer than it might
  bool timedOut = false;
  double wall = 0.0;           ///< [s]
  double cpu = 0.0;            ///< [s] user and system time
  std::uint64_t peakBytes = 0; ///< resident, of the largest process
  std::string output;          ///< stdout
  std::string errors;          ///< stderr
};

/// Runs a program from start to end. It dies with its caller.
/// @param command program (a path, or a name to be found) and arguments.
/// @param environment "NAME=value" entries beside the caller's own.
/// @param limitSeconds it is ended when it takes longer [s]
/// @throws Error if no process can be started. A program that cannot be found exits with 127.
ProcessOutcome runProcess(const std::vector<std::string>& command, const std::vector<std::string>& environment,
                          double limitSeconds);

/// The last line of a text that is not blank, for messages.
std::string lastLine(const std::string& text);

} // namespace tyndall::bench
