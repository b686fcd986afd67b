// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tyndall::app {

/// "1 %", "1%" or "0.01" as 0.01. @param option for the message, e.g. "--max-bias".
/// @throws Error if the text is no number, negative or not finite.
double parseFraction(const std::string& text, const char* option);

/// "512 B", "3.4 MB": decimal units, two to three digits.
std::string inBytes(double bytes);

} // namespace tyndall::app
