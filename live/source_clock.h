// When a pose was so: by the clock of its source, not by when its packet got through.
//
// A packet is late by what the network and both programs make of it, never early. So the difference
// between arrival and the source's clock is taken at its least over the last two seconds: what is
// left of jitter is that of the quickest packets, and the two clocks may drift (1e-3: 2 ms). A clock
// that stands is a paused simulator: its packets count as of their arrival. One that is a second
// behind, or fell a quarter of a second behind at once and stays there, has been paused or begun anew,
// and counts from there; so does one that goes back, which ClockGate lets through when the clock was put
// back or a stray packet lay ahead.
//
// Rate. A simulator that cannot keep up with time, or was told to run slower or faster, falls behind
// little by little. How much of its time passes in half a second of ours is known of every packet of the
// last two seconds; the median of that is moved by no packet that was held back and by no short pause.
// From a twelfth off (below, jitter would pass for it) until it is within a fiftieth again, its seconds
// count as so much longer or shorter, and the quickest packets of half a second set the time. Another rate is
// known once it holds for most of the two seconds; that it keeps step with time again, of four packets in a row.
// From a tenth to ten times, of packets that come four times a second or more.
// Pure.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/median.h"

namespace fanbeam::live {

class SourceClock {
 public:
  // Seconds of the clock that `arrived_s`, which rises, is of.
  double time_of(double clock_s, double arrived_s) {
    constexpr double kLook_s = 2.0, kLate_s = 0.25, kRestart_s = 1.0, kAlike_s = 0.05;
    const double step_s = last_ ? clock_s - last_->clock_s : 0.0;
    const double waited_s = last_ ? arrived_s - last_->arrived_s : 0.0;
    const bool goes_on = last_ && step_s > 0.0;
    if (!goes_on) recent_.clear();
    // Each step of a fast simulator is ahead of time, evenly; where packets are uneven, its steps are all the more.
    const double ahead_s = goes_on ? step_s - waited_s : 0.0;
    const double uneven_s = std::max(kLate_s, std::min(ahead_s, ahead_s_));
    if (!goes_on || std::abs(ahead_s - ahead_s_) > uneven_s) even_.clear();
    ahead_s_ = ahead_s;
    last_ = {arrived_s, clock_s};
    measure_rate();
    double late_s = recent_.empty() ? 0.0 : arrived_s - quickest_s();
    const bool alike = late_at_once_s_ && std::abs(late_s - *late_at_once_s_) < kAlike_s;
    if (late_s > kRestart_s || (late_s > kLate_s && alike)) {
      recent_.clear();
      even_.clear();
      late_s = 0.0;
    }
    const bool at_once = late_s > kLate_s && late_s - late_s_ > kLate_s / 2;
    late_at_once_s_ = at_once ? std::optional(late_s) : std::nullopt;
    late_s_ = late_s;
    recent_.push_back(*last_);
    while (recent_.front().arrived_s < arrived_s - (rate_ == 1.0 ? kLook_s : kSpan_s))
      recent_.pop_front();
    return quickest_s();
  }
  // Seconds of the source in one of ours.
  double rate() const { return rate_; }

 private:
  static constexpr double kSpan_s = 0.5, kOn = 1.0 / 50.0;
  static constexpr std::ptrdiff_t kEnough = 4;  // packets

  struct Stamp {
    double arrived_s = 0.0, clock_s = 0.0;
  };
  struct Measured {
    double arrived_s = 0.0, rate = 1.0;
  };

  // When the last packet would have arrived, had it been as quick as the quickest of those before it.
  double quickest_s() const {
    double least_s = last_->arrived_s;
    for (const Stamp& one : recent_)
      least_s = std::min(least_s, one.arrived_s + (last_->clock_s - one.clock_s) / rate_);
    return least_s;
  }

  bool is_in_step() const {
    return std::ssize(measured_) >= kEnough &&
           std::all_of(measured_.end() - kEnough, measured_.end(),
                       [](const Measured& one) { return std::abs(one.rate - 1.0) <= kOn; });
  }

  void measure_rate() {
    constexpr double kLook_s = 2.0, kOff = 1.0 / 12.0;
    constexpr double kSlowest = 0.09, kFastest = 11.0;  // a tenth and ten times, and their jitter
    const double now_s = last_->arrived_s;
    even_.push_back(*last_);
    while (even_.size() > 1 && even_[1].arrived_s <= now_s - kSpan_s) even_.pop_front();
    const double span_s = now_s - even_.front().arrived_s;
    if (span_s >= kSpan_s)
      measured_.push_back({now_s, (last_->clock_s - even_.front().clock_s) / span_s});
    while (!measured_.empty() && measured_.front().arrived_s < now_s - kLook_s)
      measured_.pop_front();
    if (rate_ != 1.0 && is_in_step()) measured_.erase(measured_.begin(), measured_.end() - kEnough);
    std::vector<double> rates;
    for (const Measured& one : measured_) rates.push_back(one.rate);
    const double rate = core::median(std::move(rates));
    const bool off = std::abs(rate - 1.0) > (rate_ == 1.0 ? kOff : kOn);
    const bool known = std::ssize(measured_) >= kEnough && rate > kSlowest && rate < kFastest;
    rate_ = known && off ? rate : 1.0;
  }

  std::deque<Stamp> recent_;  // that set the time
  std::deque<Stamp> even_;    // since the clock went evenly, the first half a second ago
  std::deque<Measured> measured_;
  std::optional<Stamp> last_;
  std::optional<double> late_at_once_s_;
  double late_s_ = 0.0;   // the last packet
  double ahead_s_ = 0.0;  // its step of the clock, of the time between packets
  double rate_ = 1.0;
};

// Time of a scene in lockstep, of packets alone: by the source's clock where it tells one, from its first
// packet on; else, and over a jump of that clock, a period a packet.
class LockstepTime {
 public:
  explicit LockstepTime(double period_s) : period_s_(period_s) {}

  double next(const std::optional<double>& clock_s) {
    if (begun_) {
      const double step_s = clock_s ? *clock_s - last_s_ : -1.0;
      time_s_ += step_s >= 0.0 && step_s <= 1.0 ? step_s : period_s_;
    }
    begun_ = true;
    last_s_ = clock_s.value_or(kNever_s);
    return time_s_;
  }

 private:
  double period_s_, time_s_ = 0.0;
  bool begun_ = false;
  static constexpr double kNever_s = -std::numeric_limits<double>::infinity();
  double last_s_ = kNever_s;
};

}  // namespace fanbeam::live
