// Keeps out packets that come twice, late, or from another time, by the simulator's own clock.
//
// A packet at most a second ahead of the last one is taken, or as far as goes with the time since that one
// came: a simulator that draws less than once a second sends no more often. One that is not ahead of it is late, or
// came twice; but a clock that stands while packets go on coming is a paused simulator, whose
// aircraft stands too. Two late ones in a row, of which the second follows from the first and is as much
// later, are the clock put back by less than a second, or after a stray packet from ahead: the second counts.
// Anything else is a jump: it waits, and counts when the next packet follows
// from it; then both do. So no single packet, whatever its time, locks out those that follow (hard case
// F12), and a restart is followed on its second packet. Pure.
#pragma once

#include <algorithm>
#include <optional>

#include "feeds/aircraft_state.h"

namespace fanbeam::live {

class ClockGate {
 public:
  // none, late or jump. Finite times; `arrived_s` rises.
  feeds::PacketFault take(double clock_s, double arrived_s) {
    constexpr double kStep_s = 1.0, kPaused_s = 0.02, kFaster = 1.5, kAsMuchLater = 0.5;
    const double step_s = std::max(kStep_s, kFaster * (arrived_s - arrived_s_));
    const auto follows = [&](double ahead_s) { return ahead_s > 0.0 && ahead_s <= step_s; };
    const double ahead_s = last_s_ ? clock_s - *last_s_ : kStep_s;
    const bool paused = ahead_s == 0.0 && arrived_s - arrived_s_ >= kPaused_s;
    const bool on = follows(ahead_s) || paused;
    after_jump_ = !on && follows(clock_s - jumped_s_.value_or(clock_s));
    if (!on && !after_jump_) {
      if (!(ahead_s <= 0.0 && ahead_s >= -kStep_s)) {
        jumped_s_ = clock_s;
        return feeds::PacketFault::jump;
      }
      // Packets that were only held back come all at once.
      const bool put_back =
          late_ && clock_s > late_->clock_s &&
          arrived_s - late_->arrived_s >= kAsMuchLater * (clock_s - late_->clock_s);
      late_ = {clock_s, arrived_s};
      if (!put_back) return feeds::PacketFault::late;
    }
    last_s_ = clock_s;
    arrived_s_ = arrived_s;
    jumped_s_.reset();
    late_.reset();
    return feeds::PacketFault::none;
  }
  // Whether the packet asked about last follows from one that was called a jump.
  bool after_jump() const { return after_jump_; }

 private:
  struct Late {
    double clock_s = 0.0, arrived_s = 0.0;
  };
  std::optional<double> last_s_, jumped_s_;
  std::optional<Late> late_;  // since a packet was taken
  double arrived_s_ = 0.0;
  bool after_jump_ = false;
};

}  // namespace fanbeam::live
