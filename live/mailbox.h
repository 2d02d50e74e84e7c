// The newest poses of where the aircraft is told from: a few, so that whoever looks once a frame sees how
// they move; what arrives pushes out the oldest, nothing queues. Who wants each of them (lockstep) has a
// larger one. Of several sources the one named first leads: another one's poses count while those before
// it have been silent for half a second. Where another leads, one counts from its second packet within that time,
// so that no single packet takes the lead. Thread-safe.
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
  static constexpr double kSilent_s = 0.5;

  struct Letter {
    core::Pose pose;
    std::vector<std::uint8_t> packet;  // that told it
    Clock::time_point arrived;
    std::optional<double> clock_s;  // of its source, where that is fine enough
    std::size_t source = 0;         // its place among several
    std::uint64_t number = 0;       // from 1 up
  };

  explicit Mailbox(bool in_lockstep = false) : kept_(in_lockstep ? kKeptInLockstep : kKept) {}

  void put(const core::Pose& pose, std::vector<std::uint8_t> packet = {},
           Clock::time_point arrived = Clock::now(), const std::optional<double>& clock_s = {},
           std::size_t source = 0) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (heard_.size() <= source) heard_.resize(source + 1);
      Heard& heard = heard_[source];
      const bool other_leads = !letters_.empty() && letters_.back().source != source &&
                               is_heard(letters_.back().source, arrived);
      heard.steady = is_heard(source, arrived) || !other_leads;
      heard.last = arrived;
      if (!heard.steady) return;
      for (std::size_t before = 0; before < source; ++before)
        if (heard_[before].steady && is_heard(before, arrived)) return;
      letters_.push_back({pose, std::move(packet), arrived, clock_s, source, ++count_});
      if (letters_.size() > kept_) letters_.pop_front();
    }
    came_.notify_all();
  }
  // Of the newest letter; nothing before the first.
  std::optional<std::size_t> leading() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return letters_.empty() ? std::nullopt : std::optional(letters_.back().source);
  }
  // How many came so far.
  std::uint64_t count() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return count_;
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
  struct Heard {
    std::optional<Clock::time_point> last;
    bool steady = false;  // may lead
  };

  bool is_heard(std::size_t source, Clock::time_point now) const {
    return heard_[source].last && seconds_between(*heard_[source].last, now) < kSilent_s;
  }

  std::size_t kept_;
  mutable std::mutex mutex_;
  mutable std::condition_variable came_;
  std::deque<Letter> letters_;
  std::vector<Heard> heard_;  // by source
  std::uint64_t count_ = 0;
};

}  // namespace fanbeam::live
