// SPDX-License-Identifier: Apache-2.0
#include "app/render_interrupt.h"

#include <csignal>

namespace tyndall::app {
namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch nothing else");

void onSignal(int) { interrupted = true; }

} // namespace

const std::atomic<bool>& catchInterrupts() {
  struct sigaction action {};
  action.sa_handler = onSignal;
  action.sa_flags = static_cast<int>(SA_RESETHAND); // the second one takes the default way
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM}) {
    sigaction(signal, &action, nullptr);
  }
  return interrupted;
}

} // namespace tyndall::app
