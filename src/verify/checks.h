// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "verify/check.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

/// The closed list of checks, and runs of them.
namespace tyndall::verify {

std::span<const Check> allChecks();
std::vector<std::string> checkNames();

/// The checks of these names, in the list's order; all of them without names.
/// @throws Error that names the nearest check for a name that is not known.
std::vector<const Check*> chosenChecks(const std::vector<std::string>& names);

/// False alarms that are granted to each of `count` checks, so that a run of all has the rate kFamilyRate.
double rateOfEach(std::size_t count);

/// Runs them one after the other. @param ended called as each one ends.
std::vector<Result> runChecks(const std::vector<const Check*>& checks, const gpu::Device& device,
                              const Conditions& conditions, const std::function<void(const Result&)>& ended);

} // namespace tyndall::verify
