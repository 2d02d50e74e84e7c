// Ending long work early: whoever may ask holds a StopSource, whoever works holds its StopToken.
//
// A thread works under a token while a StopScope lives on it. Then every parallel loop that it
// starts (parallel.h) throws Stopped before its next body, on whichever thread that runs, and so
// does throw_if_stopped: the work unwinds within the time of one body, and what it holds is released
// as after any other exception. Bodies that may take long look by throw_if_stopped in between. Work
// under no token is never stopped. Checking costs one read of an atomic number.
#pragma once

#include <atomic>
#include <memory>
#include <stdexcept>
#include <utility>

namespace fanbeam::core {

// Neither bad input nor a bug.
class Stopped : public std::runtime_error {
 public:
  Stopped() : std::runtime_error("stopped on request") {}
};

class StopToken {
 public:
  StopToken() = default;  // nobody asks
  // Why: what the source was given first; 0 before.
  int reason() const noexcept { return reason_ ? reason_->load(std::memory_order_relaxed) : 0; }

 private:
  friend class StopSource;
  explicit StopToken(std::shared_ptr<const std::atomic<int>> reason) : reason_(std::move(reason)) {}
  std::shared_ptr<const std::atomic<int>> reason_;
};

class StopSource {
 public:
  StopSource() : reason_(std::make_shared<std::atomic<int>>(0)) {}
  StopToken token() const { return StopToken(reason_); }
  // Safe in a signal handler. `reason` must not be 0; the first one is kept.
  void request(int reason = 1) noexcept {
    int none = 0;
    reason_->compare_exchange_strong(none, reason);
  }

 private:
  static_assert(std::atomic<int>::is_always_lock_free);  // or a signal handler could not use it
  std::shared_ptr<std::atomic<int>> reason_;
};

// What this thread does while the scope lives is done under `token`; scopes nest, the innermost one
// counts.
class StopScope {
 public:
  explicit StopScope(const StopToken& token) noexcept;  // which must outlive it
  explicit StopScope(StopToken&&) = delete;
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;
  // That of this thread's innermost scope, for a thread that goes on with its work.
  static StopToken current();

 private:
  const StopToken* before_;
};

void throw_if_stopped();

}  // namespace fanbeam::core
