// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace tyndall::microbench {

/// @throws Error
void writeTextFile(const std::filesystem::path& path, const std::string& text);

} // namespace tyndall::microbench
