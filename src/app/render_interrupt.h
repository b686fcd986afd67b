// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace tyndall::app {

/// From now on the first SIGINT or SIGTERM sets the flag instead of ending the program; a second one ends it.
const std::atomic<bool>& catchInterrupts();

} // namespace tyndall::app
