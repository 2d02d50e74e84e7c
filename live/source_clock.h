// When a pose was so: by the clock of its source, not by when its packet got through.
//
// A packet is late by what the network and both programs make of it, never early. So the difference
// between arrival and the source's clock is taken at its least over the last two seconds: what is
// left of jitter is that of the quickest packets, and the two clocks may drift (1e-3: 2 ms). A clock
// that stands is a paused simulator: its packets count as of their arrival. One that is a second
// behind, or a quarter of a second twice alike after it fell behind at once, has been paused or begun anew, and
// counts from there; so does one that goes back, which ClockGate lets through when the clock was put back or a stray
// packet lay ahead. One that falls behind little by little is a simulator that cannot keep up with time, or
// that was told to run slower or faster: from a twelfth on its seconds count as longer or shorter ones,
// by the slope of arrival over its clock in the last second, known after half a second.
// Pure.
#pragma once

#include <cmath>
#include <deque>
#include <optional>

namespace fanbeam::live {

class SourceClock {
 public:
  // Seconds of the clock that `arrived_s`, which rises, is of.
  double time_of(double clock_s, double arrived_s) {
    constexpr double kLook_s = 2.0, kLate_s = 0.25, kRestart_s = 1.0, kAlike_s = 0.05;
    const double step_s = last_ ? clock_s - last_->clock_s : 0.0;
    const double waited_s = last_ ? arrived_s - last_->arrived_s : 0.0;
    if (last_ && step_s <= 0.0) {
      recent_.clear();
      lately_.clear();
    }
    last_ = {arrived_s, clock_s};
    if (std::abs(step_s - waited_s) > kLate_s) lately_.clear();
    run_s_ += std::max(step_s, 0.0) / rate_;
    const double behind_s = arrived_s - run_s_;
    if (!recent_.empty()) {
      const double late_s = behind_s - recent_.front().behind_s;
      const bool alike = late_behind_s_ && std::abs(behind_s - *late_behind_s_) < kAlike_s;
      const bool restarted = late_s > kRestart_s || (late_s > kLate_s && alike);
      const bool at_once = behind_s - behind_s_ > kLate_s / 2;
      late_behind_s_ = late_s > kLate_s && at_once ? std::optional(behind_s) : std::nullopt;
      if (restarted) {
        recent_.clear();
        lately_.clear();
      }
    }
    behind_s_ = behind_s;
    // Those that a later one is quicker than can never be the least again.
    while (!recent_.empty() && recent_.back().behind_s >= behind_s) recent_.pop_back();
    recent_.push_back({arrived_s, behind_s});
    while (recent_.front().arrived_s < arrived_s - kLook_s) recent_.pop_front();
    measure_rate();
    return run_s_ + recent_.front().behind_s;
  }
  // Seconds of the source in one of ours, as the last packets came.
  double rate() const { return rate_; }

 private:
  struct Packet {
    double arrived_s = 0.0, behind_s = 0.0;
  };
  struct Stamp {
    double arrived_s = 0.0, clock_s = 0.0;
  };

  void measure_rate() {
    constexpr double kLook_s = 1.0, kEnough_s = 0.5, kAsGood = 1.0 / 12.0;
    constexpr double kSlowest = 0.1, kFastest = 10.0;
    constexpr std::size_t kEnough = 4;
    lately_.push_back(*last_);
    while (lately_.front().arrived_s < last_->arrived_s - kLook_s) lately_.pop_front();
    rate_ = 1.0;
    if (lately_.size() < kEnough || last_->arrived_s - lately_.front().arrived_s < kEnough_s)
      return;
    double arrived_s = 0.0, clock_s = 0.0, squares = 0.0, products = 0.0;
    for (const Stamp& one : lately_) {
      arrived_s += one.arrived_s / static_cast<double>(lately_.size());
      clock_s += one.clock_s / static_cast<double>(lately_.size());
    }
    for (const Stamp& one : lately_) {
      squares += (one.arrived_s - arrived_s) * (one.arrived_s - arrived_s);
      products += (one.arrived_s - arrived_s) * (one.clock_s - clock_s);
    }
    const double rate = products / squares;
    if (std::abs(rate - 1.0) > kAsGood && rate > kSlowest && rate < kFastest) rate_ = rate;
  }

  std::deque<Packet> recent_;  // by arrival, and by how far behind, least first
  std::deque<Stamp> lately_;   // since the clock went evenly
  std::optional<Stamp> last_;
  std::optional<double> late_behind_s_;
  double rate_ = 1.0;
  double run_s_ = 0.0;     // the clock, in seconds of ours
  double behind_s_ = 0.0;  // of the last packet
};

// Time of a scene in lockstep, of packets alone: by the source's clock where it tells one, from its first
// packet on; else, and over a jump of that clock, a period a packet.
class LockstepTime {
 public:
  explicit LockstepTime(double period_s) : period_s_(period_s) {}

  double next(const std::optional<double>& clock_s) {
    if (begun_) {
      const double step_s = clock_s && last_s_ ? *clock_s - *last_s_ : -1.0;
      time_s_ += step_s >= 0.0 && step_s <= 1.0 ? step_s : period_s_;
    }
    begun_ = true;
    last_s_ = clock_s;
    return time_s_;
  }

 private:
  double period_s_, time_s_ = 0.0;
  bool begun_ = false;
  std::optional<double> last_s_;
};

}  // namespace fanbeam::live
