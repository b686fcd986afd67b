// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"

#include <string>

namespace tyndall::app {

/// Exit codes of the program; docs/command-line.md explains them to users.
inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;        ///< bad input or environment, an unsound picture, a comparison that fails
inline constexpr int kWrongUsage = 2;    ///< the command line itself; of `compare` also input that it cannot use
inline constexpr int kValidation = 3;    ///< the Vulkan validation layer objected
inline constexpr int kInterrupted = 130; ///< Ctrl-C: the picture has fewer samples than asked for

/// What every command opens its device with: validation if TYNDALL_VALIDATION is set to anything but 0, and a
/// pipeline cache in the user's cache folder.
/// @param select index or part of the name; empty = the fastest kind.
gpu::DeviceOptions deviceOptions(const std::string& select);

/// `code`, or kValidation if the validation layer had anything to say about this device.
int withValidation(const gpu::Device& device, int code);

} // namespace tyndall::app
