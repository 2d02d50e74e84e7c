#include "core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "core/stop.h"

#ifdef __SANITIZE_THREAD__
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#endif

namespace fanbeam::core {
namespace {

#ifdef __SANITIZE_THREAD__
// The packaged oneTBB is not instrumented: the thread sanitizer cannot see what it puts in order,
// and reports races that are none. Plain threads it understands.
void run_all(std::size_t count, const std::function<void(std::size_t)>& body) {
  std::atomic<std::size_t> next{0};
  std::mutex failing;
  std::exception_ptr failure;
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) body(i);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(failing);
      if (!failure) failure = std::current_exception();
      next = count;
    }
  };
  const std::size_t threads = std::min(
      count, tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < threads; ++i) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
  if (failure) std::rethrow_exception(failure);
}
#else
void run_all(std::size_t count, const std::function<void(std::size_t)>& body) {
  // A thread that waits here for the loop's last bodies takes no task from outside it: that could
  // be another frame, and overwrite what this thread keeps of its own.
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, count, std::size_t{1}, body, tbb::simple_partitioner());
  });
}
#endif

}  // namespace

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  run_all(count, [&body](std::size_t i) {
    throw_if_stopped();
    body(i);
  });
}

ThreadLimit::ThreadLimit(int threads)
    : control_(nullptr),
      threads_(threads > 0 ? threads : std::max(1, tbb::info::default_concurrency())) {
  control_ = new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                     static_cast<std::size_t>(threads_));
}

ThreadLimit::~ThreadLimit() { delete static_cast<tbb::global_control*>(control_); }

}  // namespace fanbeam::core
