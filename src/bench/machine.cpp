// SPDX-License-Identifier: Apache-2.0
#include "bench/machine.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

namespace tyndall::bench {
namespace {

/// The model name of the first processor, where the system says it.
std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) {
      return line.substr(line.find(':') + 2);
    }
  }
  return "unknown";
}

} // namespace

std::map<std::string, std::string> machineFacts() {
  std::map<std::string, std::string> facts{{"processor", processor()},
                                           {"cores", std::to_string(std::thread::hardware_concurrency())}};
  utsname system{};
  if (uname(&system) == 0) {
    facts["system"] = fmt::format("{} {}", system.sysname, system.release);
  }
  double load[1] = {};
  if (getloadavg(load, 1) == 1) {
    facts["load at the start"] = fmt::format("{:.2f}", load[0]);
  }
  facts["Tyndall"] = TYNDALL_VERSION;
  return facts;
}

std::string timeStamp() { return fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::gmtime(std::time(nullptr))); }

} // namespace tyndall::bench
