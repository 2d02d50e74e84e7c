#include "core/parallel.h"

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

struct ThreadLimit::Arena {
  explicit Arena(int count) : threads(count), arena(count) {}
  int threads;
  tbb::task_arena arena;
};

namespace {

thread_local ThreadLimit::Arena* innermost = nullptr;

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
  const int limit = innermost != nullptr ? innermost->threads : tbb::info::default_concurrency();
  const std::size_t threads = std::min(count, static_cast<std::size_t>(limit));
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
  const auto loop = [&] {
    // Of its own: a host that cancels the group around it would leave bodies out without a word.
    tbb::task_group_context whole(tbb::task_group_context::isolated);
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(std::size_t{0}, count, std::size_t{1}, body, tbb::simple_partitioner(),
                        whole);
    });
  };
  if (innermost == nullptr) return loop();
  innermost->arena.execute(loop);
}
#endif

}  // namespace

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  const StopToken token = StopScope::current();
  run_all(count, [&](std::size_t i) {
    const StopScope scope(token);
    throw_if_stopped();
    body(i);
  });
}

ThreadLimit::ThreadLimit(int threads)
    : arena_(threads > 0 ? std::make_unique<Arena>(threads) : nullptr), before_(innermost) {
  if (arena_) innermost = arena_.get();
}

ThreadLimit::~ThreadLimit() { innermost = before_; }

int ThreadLimit::threads() {
  if (innermost != nullptr) return innermost->threads;
  return std::max(1, tbb::info::default_concurrency());
}

}  // namespace fanbeam::core
