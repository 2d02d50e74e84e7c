// Ending long work early, as a signal handler may ask for.
//
// Once stop was requested, every parallel loop (parallel.h) throws Stopped before its next body,
// and so does throw_if_stopped: the work unwinds within the time of one body, and what it holds is
// released as after any other exception. The request holds for the whole process until forget_stop,
// which is for tests. Work that nobody asks to stop pays one read of an atomic number per body.
#pragma once

#include <stdexcept>

namespace fanbeam::core {

// Neither bad input nor a bug.
class Stopped : public std::runtime_error {
 public:
  Stopped() : std::runtime_error("stopped on request") {}
};

// Safe in a signal handler. `signal` is kept for whoever tells why; it must not be 0.
void request_stop(int signal) noexcept;

// The signal of the first request, 0 before.
int stop_signal() noexcept;

void throw_if_stopped();

void forget_stop() noexcept;

}  // namespace fanbeam::core
