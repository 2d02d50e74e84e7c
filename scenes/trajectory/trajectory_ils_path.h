// Private to the ILS approach: the line in space that it follows, as a function of the way to go.
#pragma once

#include "core/geodetic.h"
#include "scenes/trajectory/ils_approach.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {

class IlsPath {
 public:
  // `approach` is already checked value by value. Throws InputError E-RANGE when start, turn, flare
  // and touchdown do not follow in this order.
  IlsPath(const IlsApproach& approach, const terrain::LocalFrame& frame);

  // `to_go_m` is the length of the ground track to the threshold, negative beyond it.
  core::Geodetic position(double to_go_m) const;
  // Course relative to the runway.
  double relative_course_rad(double to_go_m) const;
  // Wheels above the runway's plane.
  double wheel_height_m(double to_go_m) const;

  double decision_to_go_m() const { return decision_to_go_m_; }
  double flare_to_go_m() const { return flare_to_go_m_; }
  double touchdown_to_go_m() const { return touchdown_to_go_m_; }
  // Over the ground at touchdown.
  double runway_speed_mps() const { return runway_speed_mps_; }

  // Over the ground, under the approach's wind.
  double ground_speed_mps(double to_go_m) const;

 private:
  struct Plan {
    double before_threshold_m = 0.0;
    double right_m = 0.0;
  };

  Plan plan(double to_go_m) const;
  Plan turned(double turn_to_go_m) const;
  double glide_height_m(double to_go_m) const;  // reference point above the threshold
  double glide_wheel_height_m(double to_go_m) const;
  double glide_to_go_at(double height_m) const;  // of the reference point above the threshold
  double to_go_at(double wheel_height_m) const;
  double ground_speed_on_m(double relative_course_rad) const;
  void lay_turn();
  void lay_flare();

  IlsApproach approach_;
  terrain::LocalFrame frame_;
  double radius_m_ = 0.0;    // of curvature along the approach
  double offset_rad_ = 0.0;  // localiser course less runway bearing
  double airspeed_mps_ = 0.0;
  double runway_speed_mps_ = 0.0;
  double decision_to_go_m_ = 0.0;
  double turn_end_to_go_m_ = 0.0;
  double turn_length_m_ = 0.0;
  double flare_to_go_m_ = 0.0;
  double touchdown_to_go_m_ = 0.0;
  double slope_at_flare_ = 0.0;
  double slope_at_touchdown_ = 0.0;
};

}  // namespace fanbeam::scenes
