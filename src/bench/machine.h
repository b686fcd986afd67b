// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

namespace tyndall::bench {

/// What the machine is and how busy: processor, cores, system, load.
std::map<std::string, std::string> machineFacts();

/// Now, in UTC, as 2026-01-31 12:00:00.
std::string timeStamp();

} // namespace tyndall::bench
