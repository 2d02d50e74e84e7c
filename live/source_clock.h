// When a pose was so: by the clock of its source, not by when its packet got through.
//
// A packet is late by what the network and both programs make of it, never early. So the difference
// between arrival and the source's clock is taken at its least over the last two seconds: what is
// left of jitter is that of the quickest packets, and the two clocks may drift (1e-3: 2 ms). A clock
// that stands is a paused simulator: its packets count as of their arrival. One that is a second
// behind, or a quarter of a second twice alike, has been paused or begun anew, and counts from there; so
// does one that goes back, which ClockGate lets through when the clock was put back or a stray packet lay ahead.
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
    const double behind_s = arrived_s - clock_s;
    if (last_s_ && clock_s <= *last_s_) recent_.clear();
    last_s_ = clock_s;
    if (!recent_.empty()) {
      const double late_s = behind_s - recent_.front().behind_s;
      const bool alike = late_behind_s_ && std::abs(behind_s - *late_behind_s_) < kAlike_s;
      if (late_s > kRestart_s || (late_s > kLate_s && alike)) recent_.clear();
      late_behind_s_ = late_s > kLate_s ? std::optional(behind_s) : std::nullopt;
    }
    // Those that a later one is quicker than can never be the least again.
    while (!recent_.empty() && recent_.back().behind_s >= behind_s) recent_.pop_back();
    recent_.push_back({arrived_s, behind_s});
    while (recent_.front().arrived_s < arrived_s - kLook_s) recent_.pop_front();
    return clock_s + recent_.front().behind_s;
  }

 private:
  struct Packet {
    double arrived_s = 0.0, behind_s = 0.0;
  };
  std::deque<Packet> recent_;  // by arrival, and by how far behind, least first
  std::optional<double> last_s_, late_behind_s_;
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
