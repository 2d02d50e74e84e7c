// Where the aircraft is at the middle of a frame, from poses that arrive unevenly.
//
// Between the two newest poses the path is a cubic through both positions and velocities, and the
// attitude turns on the short arc. After the newest one the aircraft goes on with its velocity, its
// acceleration and its turn as they were between those two, for 0.25 s; then it stands.
//
// Time. Simulators send when a display frame of theirs ends (FlightGear at a nominal 16 Hz: 50, 67
// or 83 ms apart), and native-fdm's own clock has steps of a second: a pose counts as of its
// arrival, so that all of the picture is late by the way from the simulator to here. On the recorded
// flight (tests/live/predictor_test.cpp) that constant apart the error is 0.05 m
// and 0.001 deg RMS.
//
// Jumps. A pose that the one before cannot have led to (reset, replay, a stray packet) waits; the
// next one decides. If it follows from the waiting one, both are the new flight; if it follows from
// the old flight, the waiting one is dropped. So a single packet never moves the aircraft, and a
// reset is followed on its second packet.
//
// Pure: times are seconds of one clock that the caller reads.
#pragma once

#include <optional>

#include "core/pose.h"
#include "terrain/local_frame.h"

namespace fanbeam::live {

class Predictor {
 public:
  static constexpr double kCarriedOn_s = 0.25;

  explicit Predictor(const terrain::LocalFrame& frame) : frame_(frame) {}

  // At increasing times; one that is not later than the last is dropped. Finite poses.
  void take(const core::Pose& pose, double arrived_s);
  // Nothing before the first pose. Times before the two newest poses are those of the older one.
  std::optional<core::Pose> at(double time_s) const;
  // Of the newest pose that counts; nothing before the first.
  std::optional<double> newest_s() const;

 private:
  struct Known {
    double time_s = 0.0;
    glm::dvec3 at_m{0.0}, v_mps{0.0};  // of the scene's frame
    core::Pose pose;
  };

  static bool follows(const Known& before, const Known& now);
  core::Pose placed(const glm::dvec3& at_m, const glm::dvec3& v_mps, const glm::dquat& q_NB) const;
  core::Pose between(double share) const;
  core::Pose after(double ahead_s) const;

  terrain::LocalFrame frame_;
  std::optional<Known> before_, newest_, waiting_;
};

}  // namespace fanbeam::live
