// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench/cost.h"
#include "bench/figure.h"

/// Speed of the parts, and variance times time of the estimators, as a program and not as a test.
namespace tyndall::microbench {

using namespace bench; // figures, their intervals, scenes and what is run in a benchmark's own process

} // namespace tyndall::microbench
