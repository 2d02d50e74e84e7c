// Ctrl-C and kill end long work cleanly: what is half done is dropped, what is on disk is whole.
#pragma once

#include "core/stop.h"

namespace fanbeam::apps {

// While it lives, SIGINT and SIGTERM stop the work of its thread (core/stop.h) instead of ending
// the process; a signal that was ignored stays so, as for a job in the background. The second of a
// kind ends the process at once.
class StopOnSignals {
 public:
  StopOnSignals();
  ~StopOnSignals();
  StopOnSignals(const StopOnSignals&) = delete;
  StopOnSignals& operator=(const StopOnSignals&) = delete;

 private:
  core::StopToken token_;
  core::StopScope scope_;
};

// Ends the process by the signal that stopped it, so that a shell sees 130 (SIGINT) or 143
// (SIGTERM) and a script knows that it was interrupted. Returns that number if the signal is
// blocked.
int end_by_stop_signal();

}  // namespace fanbeam::apps
