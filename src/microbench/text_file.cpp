// SPDX-License-Identifier: Apache-2.0
#include "microbench/text_file.h"

#include "base/error.h"
#include "base/file.h"

#include <fstream>

namespace tyndall::microbench {

void writeTextFile(const std::filesystem::path& path, const std::string& text) {
  writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream file(temporary);
    file << text;
    if (!file.flush()) {
      fail("{}: cannot be written; is the disk full?", path.string());
    }
  });
}

} // namespace tyndall::microbench
