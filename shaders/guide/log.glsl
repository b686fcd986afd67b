// SPDX-License-Identifier: Apache-2.0
// Writes to the store go into a log, from which the pass `guide_apply` carries them out when the samples of a dispatch are
// through: there all lanes write, here few of them would at a time.
#ifndef TYNDALL_GUIDE_LOG_GLSL
#define TYNDALL_GUIDE_LOG_GLSL

#include "interop/guide.h"

uint logFirst = 0u; // kGuideOrdered: the pixel's first place in the log
uint logged = 0u;

void submit(GuidePtr guide, GuideUpdate update) {
  uint place = logFirst + logged;
  if (kGuideOrdered) {
    ++logged;
  } else {
    place = atomicAdd(guide.at[0].logCounts.at[0], 1u);
    if (place >= guide.at[0].logSize) {
      return; // one sample less to learn from
    }
  }
  guide.at[0].log.at[place] = update;
}

#endif
