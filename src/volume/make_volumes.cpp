// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "volume/generate.h"

#include <fmt/format.h>

#include <cstdio>

/// tyndall_make_volumes FOLDER: writes plume.vdb, cloud.vdb and flame.vdb there.
int main(int argc, char** argv) {
  namespace volume = tyndall::volume;
  if (argc != 2) {
    fmt::print(stderr, "usage: tyndall_make_volumes FOLDER\n");
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    volume::writeVolume(folder / "plume.vdb", volume::makePlume());
    volume::writeVolume(folder / "cloud.vdb", volume::makeCloud());
    volume::writeVolume(folder / "flame.vdb", volume::makeFlame());
    for (const char* name : {"plume.vdb", "cloud.vdb", "flame.vdb"}) {
      fmt::print("{}: {} bytes\n", (folder / name).string(), std::filesystem::file_size(folder / name));
    }
  } catch (const std::exception& problem) {
    fmt::print(stderr, "{}\n", problem.what());
    return 1;
  }
  return 0;
}
