// SPDX-License-Identifier: Apache-2.0
#include "bench/process.h"

#include "base/error.h"

#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>

namespace tyndall::bench {
namespace {

/// A file in memory that a program writes to: never full, unlike a pipe that nobody reads.
class Capture {
public:
  Capture() : descriptor_(memfd_create("tyndall-bench", MFD_CLOEXEC)) {
    if (descriptor_ < 0) {
      fail("a program's output cannot be kept: {}; free some memory", std::strerror(errno));
    }
  }
  ~Capture() { close(descriptor_); }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  int descriptor() const { return descriptor_; }
  std::string text() const {
    std::string text;
    char block[4096];
    for (off_t at = 0;;) {
      const ssize_t got = pread(descriptor_, block, sizeof(block), at);
      if (got <= 0) {
        return text;
      }
      text.append(block, static_cast<std::size_t>(got));
      at += got;
    }
  }

private:
  int descriptor_;
};

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> result;
  for (std::string& word : words) {
    result.push_back(word.data());
  }
  result.push_back(nullptr);
  return result;
}

/// After fork, in a process of one thread.
[[noreturn]] void become(char* const* command, char* const* environment, const Capture& out, const Capture& err) {
  setpgid(0, 0); // so that what it starts can be ended with it
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  dup2(out.descriptor(), STDOUT_FILENO);
  dup2(err.descriptor(), STDERR_FILENO);
  for (char* const* entry = environment; *entry != nullptr; ++entry) {
    putenv(*entry);
  }
  execvp(command[0], command);
  constexpr char kText[] = "the program could not be started: is it there, and executable?\n";
  (void)!write(STDERR_FILENO, kText, sizeof(kText) - 1);
  _exit(127);
}

/// Waits until the process has ended. @return false if it had to be ended.
bool waitFor(pid_t process, double limitSeconds) {
  const int handle = static_cast<int>(syscall(SYS_pidfd_open, process, 0));
  if (handle < 0) {
    fail("a program cannot be watched: {}", std::strerror(errno));
  }
  pollfd watched{handle, POLLIN, 0};
  const int milliseconds = limitSeconds < 2e6 ? static_cast<int>(1e3 * limitSeconds) : -1;
  int ready = poll(&watched, 1, milliseconds);
  while (ready < 0 && errno == EINTR) {
    ready = poll(&watched, 1, milliseconds);
  }
  close(handle);
  if (ready == 0) {
    kill(-process, SIGKILL);
  }
  return ready != 0;
}

double seconds(const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); }

} // namespace

ProcessOutcome runProcess(const std::vector<std::string>& command, const std::vector<std::string>& environment,
                          double limitSeconds) {
  TYNDALL_CHECK(!command.empty());
  std::vector<std::string> words = command;
  std::vector<std::string> entries = environment;
  const std::vector<char*> arguments = pointers(words);
  const std::vector<char*> variables = pointers(entries);
  const Capture out;
  const Capture err;
  const auto start = std::chrono::steady_clock::now();
  const pid_t process = fork();
  if (process < 0) {
    fail("{} cannot be started: {}; free some memory", command.front(), std::strerror(errno));
  }
  if (process == 0) {
    become(arguments.data(), variables.data(), out, err);
  }
  ProcessOutcome outcome;
  outcome.timedOut = !waitFor(process, limitSeconds);
  int status = 0;
  rusage usage{};
  wait4(process, &status, 0, &usage);
  outcome.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  outcome.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  outcome.cpu = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  outcome.peakBytes = std::uint64_t(usage.ru_maxrss) * 1024u;
  outcome.output = out.text();
  outcome.errors = err.text();
  if (WIFSIGNALED(status)) {
    outcome.errors += outcome.timedOut ? "it took too long\n" : fmt::format("signal {} ended it\n", WTERMSIG(status));
  }
  return outcome;
}

std::string lastLine(const std::string& text) {
  const std::size_t end = text.find_last_not_of(" \n\r\t");
  if (end == std::string::npos) {
    return {};
  }
  const std::size_t begin = text.find_last_of('\n', end);
  return text.substr(begin == std::string::npos ? 0 : begin + 1,
                     end - (begin == std::string::npos ? 0 : begin + 1) + 1);
}

} // namespace tyndall::bench
