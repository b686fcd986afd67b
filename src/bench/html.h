// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

/// Parts of a page.
namespace tyndall::bench {

std::string heading(const char* tag, const std::string& text);

/// A paragraph.
std::string note(const std::string& text);

/// First row: names of columns.
std::string table(const std::vector<std::vector<std::string>>& rows);

} // namespace tyndall::bench
