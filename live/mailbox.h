// The newest poses of a source: a few, so that whoever looks once a frame sees how they move; what
// arrives pushes out the oldest, nothing queues. Who wants each of them (lockstep) has a larger one.
// Thread-safe.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "core/pose.h"

namespace fanbeam::live {

using Clock = std::chrono::steady_clock;

inline double seconds_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

class Mailbox {
 public:
  static constexpr std::size_t kKept = 4, kKeptInLockstep = 256;

  struct Letter {
    core::Pose pose;
    std::vector<std::uint8_t> packet;  // that told it
    Clock::time_point arrived;
    std::optional<double> clock_s;  // of its source, where that is fine enough
    std::uint64_t number = 0;       // from 1 up
  };

  explicit Mailbox(std::size_t kept = kKept) : kept_(kept) {}

  void put(const core::Pose& pose, std::vector<std::uint8_t> packet = {},
           Clock::time_point arrived = Clock::now(), const std::optional<double>& clock_s = {}) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      letters_.push_back({pose, std::move(packet), arrived, clock_s, ++count_});
      if (letters_.size() > kept_) letters_.pop_front();
    }
    came_.notify_all();
  }
  // Those kept that came after the letter of that number, oldest first.
  std::vector<Letter> after(std::uint64_t number) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::vector<Letter> found;
    for (const Letter& letter : letters_)
      if (letter.number > number) found.push_back(letter);
    return found;
  }
  // The same, once there is one or `most` has passed.
  std::vector<Letter> wait_after(std::uint64_t number, std::chrono::milliseconds most) const {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      came_.wait_for(lock, most, [&] { return count_ > number; });
    }
    return after(number);
  }

 private:
  std::size_t kept_;
  mutable std::mutex mutex_;
  mutable std::condition_variable came_;
  std::deque<Letter> letters_;
  std::uint64_t count_ = 0;
};

}  // namespace fanbeam::live
