// Long work that leaves Python's lock alone and ends with Ctrl-C.
#pragma once

#include <functional>

#include "core/stop.h"

namespace fanbeam::bindings {

// Runs `work` without the lock. On Python's main thread, which alone hears of signals, it goes on a
// thread of its own while this one asks for them every twentieth of a second; where a handler raises,
// the work is stopped (core/stop.h) and that exception goes up, whatever the work itself ends with.
void without_lock(const std::function<void(const core::StopToken&)>& work);

}  // namespace fanbeam::bindings
