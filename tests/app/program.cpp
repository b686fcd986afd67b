// SPDX-License-Identifier: Apache-2.0
#include "app/program.h"

#include "support/fixtures.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace tyndall::test {
namespace {

namespace fs = std::filesystem;

/// In the child between fork and exec: only what is safe there.
[[noreturn]] void become(const std::vector<char*>& arguments, const char* folder, const std::string& out,
                         const std::string& err) {
  const int outFile = ::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int errFile = ::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  constexpr int kCannotStart = 127;
  if (outFile < 0 || errFile < 0 || ::chdir(folder) != 0) {
    ::_exit(kCannotStart);
  }
  ::dup2(outFile, STDOUT_FILENO);
  ::dup2(errFile, STDERR_FILENO);
  ::execv(arguments.front(), arguments.data());
  ::_exit(kCannotStart);
}

/// Waits for the child; ends it when its time is over.
void await(pid_t child, Outcome& outcome) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end = Clock::now() + std::chrono::seconds(kTimeoutSeconds);
  int status = 0;
  while (::waitpid(child, &status, WNOHANG) == 0) {
    if (Clock::now() > end && !outcome.timedOut) {
      outcome.timedOut = true;
      ::kill(child, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  outcome.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  outcome.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

} // namespace

Outcome runProgram(const std::vector<std::string>& arguments, const fs::path& folder,
                   const std::vector<std::string>& environment) {
  const TemporaryFolder streams;
  std::vector<std::string> words{"/usr/bin/env"};
  words.insert(words.end(), environment.begin(), environment.end());
  words.emplace_back(TYNDALL_PROGRAM);
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) {
    pointers.push_back(word.data());
  }
  pointers.push_back(nullptr);
  const std::string out = streams / "out";
  const std::string err = streams / "err";
  const pid_t child = ::fork();
  if (child < 0) {
    throw std::runtime_error("cannot start another process");
  }
  if (child == 0) {
    become(pointers, folder.c_str(), out, err);
  }
  Outcome outcome;
  await(child, outcome);
  outcome.output = bytesOf(out);
  outcome.errors = bytesOf(err);
  return outcome;
}

pid_t startProgram(std::vector<std::string> arguments, const std::filesystem::path& folder) {
  arguments.insert(arguments.begin(), TYNDALL_PROGRAM);
  std::vector<char*> words;
  for (std::string& argument : arguments) {
    words.push_back(argument.data());
  }
  words.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    if (::chdir(folder.c_str()) == 0) {
      ::execv(words.front(), words.data());
    }
    ::_exit(127);
  }
  return child;
}

std::vector<std::string> wordsOf(const std::string& line, const fs::path& inputs) {
  const std::string placeholder = "{in}";
  std::vector<std::string> words;
  std::istringstream stream(line);
  for (std::string word; stream >> word; words.push_back(word)) {
    if (const std::size_t at = word.find(placeholder); at != std::string::npos) {
      word.replace(at, placeholder.size(), inputs.string());
    }
  }
  return words;
}

std::vector<std::string> namesIn(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

void writeFile(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
}

std::string bytesOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

} // namespace tyndall::test
