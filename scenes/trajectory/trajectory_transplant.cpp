#include "scenes/trajectory/trajectory_transplant.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/constants.h"
#include "core/errors.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {
namespace {

constexpr double kFarthest_m = 500e3;
// Nearer than this the direction to the threshold is that of the runway.
constexpr double kNearest_m = 1e-3;

// Azimuth at `position` of the geodesic that comes from the threshold.
double azimuth_away_rad(const RunwayEnd& runway, const core::Geodetic& position) {
  const terrain::GeodesicLine back = terrain::geodesic_between(position, runway.threshold);
  return back.length_m < kNearest_m ? runway.bearing_rad + core::kPi : back.azimuth_rad + core::kPi;
}

core::Pose moved(const core::Pose& pose, const RunwayEnd& from, const RunwayEnd& to) {
  const RunwayRelative relative = relative_to(from, pose.position);
  if (std::hypot(relative.before_threshold_m, relative.right_m) > kFarthest_m)
    core::throw_input_error(core::ErrorClass::range, "distance from the runway",
                            std::hypot(relative.before_threshold_m, relative.right_m),
                            "at most 500000 m");
  core::Pose there = pose;
  there.position = position_from(to, relative);
  double turn_rad = to.bearing_rad - from.bearing_rad;
  if (std::hypot(relative.before_threshold_m, relative.right_m) >= kNearest_m)
    turn_rad = azimuth_away_rad(to, there.position) - azimuth_away_rad(from, pose.position);
  const glm::dquat q_turn = core::quaternion_from({0.0, 0.0, turn_rad});
  there.q_NB = q_turn * pose.q_NB;
  there.v_N_mps = q_turn * pose.v_N_mps;
  return there;
}

void check_bearing(const RunwayEnd& runway, const char* field) {
  terrain::check_geodetic(runway.threshold, field);
  if (!std::isfinite(runway.bearing_rad))
    core::throw_input_error(core::ErrorClass::nonfinite, std::string(field) + ".bearing",
                            runway.bearing_rad, "a finite angle");
}

}  // namespace

RunwayRelative relative_to(const RunwayEnd& runway, const core::Geodetic& position) {
  const terrain::GeodesicLine line = terrain::geodesic_between(runway.threshold, position);
  const double off_centre_rad = line.azimuth_rad - runway.bearing_rad;
  return {-line.length_m * std::cos(off_centre_rad), line.length_m * std::sin(off_centre_rad),
          position.height_m - runway.threshold.height_m};
}

core::Geodetic position_from(const RunwayEnd& runway, const RunwayRelative& relative) {
  const double off_centre_rad = std::atan2(relative.right_m, -relative.before_threshold_m);
  core::Geodetic position =
      terrain::geodesic_point(runway.threshold, runway.bearing_rad + off_centre_rad,
                              std::hypot(relative.before_threshold_m, relative.right_m));
  position.height_m += relative.height_m;
  return position;
}

Trajectory transplant(const Trajectory& flight, const RunwayEnd& from, const RunwayEnd& to,
                      double time_shift_s) {
  check_bearing(from, "from");
  check_bearing(to, "to");
  if (!std::isfinite(time_shift_s))
    core::throw_input_error(core::ErrorClass::nonfinite, "time shift", time_shift_s,
                            "a finite time");
  std::vector<core::Pose> poses = flight.poses();
  for (core::Pose& pose : poses) {
    pose = moved(pose, from, to);
    pose.time_s += time_shift_s;
  }
  Trajectory trajectory(std::move(poses));
  trajectory.attitude_derived = flight.attitude_derived;
  trajectory.rejected = flight.rejected;
  return trajectory;
}

}  // namespace fanbeam::scenes
