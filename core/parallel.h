// A parallel loop over indices whose results cannot depend on the number of threads: each index is
// handled once, by one thread, and must write only what belongs to it.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace fanbeam::core {

// Runs body(i) for every i in [0, count), on oneTBB's workers. Exceptions of the body reach the
// caller; a request to stop the caller's work does as Stopped (core/stop.h). May be called from
// inside a task of oneTBB: a thread that waits for the loop does nothing else meanwhile, so that
// thread_local variables of a body and of the caller keep their values over it. A loop of few bodies
// that have loops of their own leaves threads idle for that reason: those that wait for the outer one.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

// While it lives, loops that this thread starts run on at most so many threads, in an arena of
// their own: nothing else in the process is limited. 0 limits nothing.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;
  // Of the innermost one of this thread, or of the machine.
  static int threads();

  struct Arena;

 private:
  std::unique_ptr<Arena> arena_;
  Arena* before_;
};

}  // namespace fanbeam::core
