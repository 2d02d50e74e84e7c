#include "core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "core/stop.h"

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace fanbeam::core {
namespace {

// The packaged oneTBB is not instrumented: the thread sanitizer has to be told that what the caller
// did comes before every body, and every body before what the caller does next. Nothing is said
// about bodies among each other. The marks are static because a body must not read the caller's
// stack before it has passed the first one.
#ifdef __SANITIZE_THREAD__
char begun, done;
struct LoopOrder {
  LoopOrder() { __tsan_release(&begun); }
  ~LoopOrder() { __tsan_acquire(&done); }
};
struct BodyOrder {
  BodyOrder() { __tsan_acquire(&begun); }
  ~BodyOrder() { __tsan_release(&done); }
};
#else
struct LoopOrder {};
struct BodyOrder {};
#endif

}  // namespace

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  const auto ordered_body = [&body](std::size_t i) {
    [[maybe_unused]] const BodyOrder order;
    throw_if_stopped();
    body(i);
  };
  [[maybe_unused]] const LoopOrder order;
  tbb::parallel_for(std::size_t{0}, count, std::size_t{1}, ordered_body, tbb::simple_partitioner());
}

ThreadLimit::ThreadLimit(int threads)
    : control_(nullptr),
      threads_(threads > 0 ? threads : std::max(1, tbb::info::default_concurrency())) {
  control_ = new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                     static_cast<std::size_t>(threads_));
}

ThreadLimit::~ThreadLimit() { delete static_cast<tbb::global_control*>(control_); }

}  // namespace fanbeam::core
