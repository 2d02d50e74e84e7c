// Where the aircraft is at the middle of a frame, from poses that arrive unevenly.
//
// Between two poses the path is a cubic through both positions and velocities, and the attitude
// turns on the short arc. After the newest one the aircraft goes on with its velocity, and with its
// acceleration and turn as they were since a pose 30 ms before or more, for 0.25 s; then it stands.
//
// Time. Simulators send when a display frame of theirs ends (FlightGear at a nominal 16 Hz: 50, 67
// or 83 ms apart), and networks and busy machines bunch what was sent. A pose counts as of its
// source's clock (live/source_clock.h); all of the picture is late by the way from the simulator to
// here. Where a source tells no fine clock (native-fdm's has steps of a second) what it flew is one, above
// 10 m/s: the way between two poses over the speed that they tell. A simulator that runs slower than time, or faster,
// moves its aircraft by so much less, or more, than the speed that it tells; how much is known after three
// quarters of a second. On the recorded flight
// (tests/live/predictor_test.cpp) one constant apart the error is 0.014 m and 0.001 deg RMS, and with
// every eighth packet held back until half a millisecond before the next, or each by up to 15 ms, within 0.2 m.
//
// Jumps. A pose that the one before cannot have led to (reset, replay, a stray packet) waits; the
// next one decides. If it follows from the waiting one, both are the new flight; if it follows from
// the old flight, the waiting one is dropped and counted. So a single packet never moves the aircraft, and a
// reset is followed on its second packet.
//
// Pauses. A paused simulator goes on telling the speed that it had. Where the place stays the same to the
// last digit from one packet to another, 50 ms or more apart, the aircraft stands, whatever speed is told.
//
// Pure: times are seconds of one clock that the caller reads.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "core/pose.h"
#include "live/source_clock.h"
#include "terrain/local_frame.h"

namespace fanbeam::live {

class Predictor {
 public:
  static constexpr double kCarriedOn_s = 0.25;

  explicit Predictor(const terrain::LocalFrame& frame) : frame_(frame) {}

  // At increasing times of arrival and in the order that they were sent (ClockGate and WayGate see to that), as a clock that
  // goes back begins anew. What then is not later than the last is dropped. Finite poses. `clock_s` of a source that tells one packet's time from the next one's.
  // From another `source` than before it begins anew: that has another clock, and flies what it flies.
  void take(const core::Pose& pose, double arrived_s, const std::optional<double>& clock_s = {},
            std::size_t source = 0);
  // Nothing before the first pose. Times before those known are those of the oldest.
  std::optional<core::Pose> at(double time_s) const;
  // When the newest pose that counts arrived; nothing before the first.
  std::optional<double> newest_s() const;
  // Poses that led nowhere: none before and none after follows from them.
  std::uint64_t strays() const { return strays_; }

 private:
  struct Known {
    double time_s = 0.0, arrived_s = 0.0;
    glm::dvec3 at_m{0.0}, told_mps{0.0};  // of the scene's frame
    core::Pose pose;
    double rate = 1.0;  // the source's seconds, of which the speed is told, in one of ours
    bool stands = false;

    glm::dvec3 v_mps() const { return rate * told_mps; }
  };

  static bool follows(const Known& before, const Known& now);
  double flown_s(const Known& now);
  core::Pose placed(const glm::dvec3& at_m, const glm::dvec3& v_mps, const glm::dquat& q_NB) const;
  core::Pose between(const Known& a, const Known& b, double time_s) const;
  core::Pose after(double ahead_s) const;

  terrain::LocalFrame frame_;
  std::size_t source_ = 0;
  SourceClock clock_;
  std::optional<Known> heard_;  // last, whether it counted or not
  double there_since_s_ = 0.0;  // that its place was told
  double flown_s_ = 0.0;        // the clock of what is flown
  std::deque<Known> flight_;    // oldest first
  std::optional<Known> waiting_;
  std::uint64_t strays_ = 0;
};

}  // namespace fanbeam::live
