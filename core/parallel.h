// A parallel loop over indices whose results cannot depend on the number of threads: each index is
// handled once, by one thread, and must write only what belongs to it.
#pragma once

#include <cstddef>
#include <functional>

namespace fanbeam::core {

// Runs body(i) for every i in [0, count), on oneTBB's workers. Exceptions of the body reach the
// caller; a request to stop does as Stopped (core/stop.h). May be called from inside a task of
// oneTBB: a thread that waits for the loop does nothing else meanwhile, so that thread_local
// variables of a body and of the caller keep their values over it.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

// Limits every parallel loop of the process while it lives. 0 means as many threads as the machine
// has.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;
  int threads() const { return threads_; }

 private:
  void* control_;
  int threads_;
};

}  // namespace fanbeam::core
