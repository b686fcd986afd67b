// SPDX-License-Identifier: Apache-2.0
// Pass `guide_apply`: carries logged updates of the chain store out, one invocation for each, or for each window of cells.
//
// In:  the store, the log; kGuideOrdered: the order in which each window's updates are carried out.
// Out: the store; the counter of evicted cells.
#ifndef TYNDALL_GUIDE_APPLY_IO_H
#define TYNDALL_GUIDE_APPLY_IO_H

#include "interop/guide.h"

// SPEC(type, name, id, default), as in the pass that logged.
// clang-format off
#define TYNDALL_GUIDE_APPLY_SPEC(SPEC)                                \
  SPEC(uint, kGuideStates, 0, 4u)    /* of a cell */                  \
  SPEC(bool, kGuideCache,  1, false) /* there is a radiance cache */  \
  SPEC(bool, kGuideMotion, 2, false) /* targets move */               \
  SPEC(bool, kGuideFit,    3, false) /* states are fitted */          \
  SPEC(bool, kGuideOrdered, 4, false) /* by window, in order */
// clang-format on

GPU_BEGIN

// Push constants.
struct GuideApplyInputs {
  GPU_PTR(Guide) guide;
  GPU_PTR(uint) places; // kGuideOrdered: in the log, window after window
  GPU_PTR(uint) first;  // ... of each window's in `places`; one more entry ends the last
  uint count;           // updates; kGuideOrdered: windows
  uint kinds;           // that are carried out, a bit for each
};

GPU_END
#endif
