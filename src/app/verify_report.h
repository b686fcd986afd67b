// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"
#include "verify/checks.h"

#include <nlohmann/json.hpp>

#include <string>

namespace tyndall::app {

/// The header of the table that verifyLine fills.
std::string verifyHeader();
/// One line on a check; a second one says why it failed or was skipped.
std::string verifyLine(const verify::Result& result);

/// A run of checks.
struct VerifyRun {
  gpu::DeviceInfo device;
  verify::Conditions conditions;
  std::vector<verify::Result> results;
  double seconds = 0.0;

  bool passed() const;
};

/// One sentence: what came of it, on which device and driver.
std::string verifyVerdict(const VerifyRun& run);
/// Everything, for scripts.
nlohmann::ordered_json verifyJson(const VerifyRun& run);

} // namespace tyndall::app
