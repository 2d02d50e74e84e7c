#include "core/stop.h"

#include <atomic>

namespace fanbeam::core {
namespace {

std::atomic<int> requested{0};
static_assert(std::atomic<int>::is_always_lock_free);  // or a signal handler could not use it

}  // namespace

void request_stop(int signal) noexcept {
  int none = 0;
  requested.compare_exchange_strong(none, signal);
}

int stop_signal() noexcept { return requested.load(std::memory_order_relaxed); }

void throw_if_stopped() {
  if (stop_signal() != 0) throw Stopped();
}

void forget_stop() noexcept { requested = 0; }

}  // namespace fanbeam::core
