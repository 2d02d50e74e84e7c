#include "scenes/trajectory/ils_approach.h"

#include <cmath>
#include <glm/mat3x3.hpp>
#include <utility>
#include <vector>

#include "core/errors.h"
#include "core/number_range.h"
#include "scenes/trajectory/dryden.h"
#include "scenes/trajectory/trajectory_ils_path.h"
#include "scenes/trajectory/trajectory_kinematics.h"
#include "scenes/trajectory/trajectory_turbulence.h"

namespace fanbeam::scenes {
namespace {

constexpr double kStep_s = 0.02;
constexpr double kDerotation_s = 4.0;
constexpr double kCalmBelow_m = 30.0;
// Lukla (VNLK) rises by 11.85 % from end to end, the steepest part of Courchevel (LFLJ) by 18.6 %
// [recalled].
constexpr double kSteepestRunway = 0.2;

void check(const IlsApproach& approach) {
  core::ProblemList problems;
  try {
    terrain::check_geodetic(approach.threshold, "threshold");
  } catch (const core::InputError& error) {
    problems.append(error.problems());
  }
  const double bearing_deg = core::degrees(approach.runway_bearing_rad);
  const double course_deg =
      core::degrees(approach.localiser_course_rad.value_or(approach.runway_bearing_rad));
  core::check_range(problems, "runway_bearing_deg", bearing_deg, {-360.0, 360.0});
  core::check_range(problems, "localiser_course_deg", course_deg, {-360.0, 360.0});
  if (!problems.has_errors())
    core::check_range(problems, "localiser_course_deg less bearing",
                      core::degrees(core::wrap_pi_rad(core::radians(course_deg - bearing_deg))),
                      {-30.0, 30.0});
  core::check_range(problems, "runway_slope", approach.runway_slope,
                    {-kSteepestRunway, kSteepestRunway});
  core::check_range(problems, "crossing_distance_m", approach.crossing_distance_m.value_or(0.0),
                    {0.0, 20e3});
  core::check_range(problems, "glide_path_deg", core::degrees(approach.glide_path_rad),
                    {1.0, 10.0});
  if (approach.runway_slope + std::tan(approach.glide_path_rad) < std::tan(core::radians(0.9)))
    problems.error(core::ErrorClass::range, {}, "runway_slope",
                   core::number_text(approach.runway_slope),
                   "a runway less steep than the glide path");
  core::check_range(problems, "threshold_crossing_height_m", approach.threshold_crossing_height_m,
                    {5.0, 50.0});
  core::check_range(problems, "start_distance_m", approach.start_distance_m, {0.0, 100e3});
  core::check_range(problems, "speed_mps", approach.speed_mps, {15.0, 150.0});
  core::check_range(problems, "wind_speed_mps", approach.wind_speed_mps, {0.0, 40.0});
  core::check_range(problems, "wind_from_deg", core::degrees(approach.wind_from_rad),
                    {-360.0, 360.0});
  core::check_range(problems, "turbulence_wind_20ft_mps", approach.turbulence_wind_20ft_mps,
                    {0.0, 60.0});
  core::check_range(problems, "angle_of_attack_deg", core::degrees(approach.angle_of_attack_rad),
                    {-10.0, 20.0});
  core::check_range(problems, "largest_bank_deg", core::degrees(approach.largest_bank_rad),
                    {1.0, 45.0});
  core::check_range(problems, "decision_height_m", approach.decision_height_m, {20.0, 300.0});
  core::check_range(problems, "flare_height_m", approach.flare_height_m, {1.0, 50.0});
  core::check_range(problems, "touchdown_sink_mps", approach.touchdown_sink_mps, {0.1, 3.0});
  core::check_range(problems, "touchdown_pitch_deg", core::degrees(approach.touchdown_pitch_rad),
                    {-5.0, 15.0});
  core::check_range(problems, "height_on_ground_m", approach.height_on_ground_m, {0.0, 15.0});
  core::check_range(problems, "rollout_deceleration_mps2", approach.rollout_deceleration_mps2,
                    {0.5, 5.0});
  core::check_range(problems, "begin_s", approach.begin_s, {-1e12, 1e12});
  problems.throw_if_errors();
}

// The way to go at every step.
struct Progress {
  std::vector<double> to_go_m;
  double touchdown_s = 0.0;  // since the beginning; behind the end when not reached
};

double stepped_in_the_air_m(const IlsPath& path, double to_go_m) {
  const double k1 = path.ground_speed_mps(to_go_m);
  const double k2 = path.ground_speed_mps(to_go_m - 0.5 * kStep_s * k1);
  const double k3 = path.ground_speed_mps(to_go_m - 0.5 * kStep_s * k2);
  const double k4 = path.ground_speed_mps(to_go_m - kStep_s * k3);
  return to_go_m - kStep_s * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
}

Progress fly(const IlsApproach& approach, const IlsPath& path) {
  Progress progress;
  const double last_m = approach.end == ApproachEnd::decision_height ? path.decision_to_go_m()
                                                                     : path.touchdown_to_go_m();
  double to_go_m = approach.start_distance_m;
  for (; to_go_m >= last_m; to_go_m = stepped_in_the_air_m(path, to_go_m))
    progress.to_go_m.push_back(to_go_m);
  const double speed_mps = path.runway_speed_mps();
  const auto steps = static_cast<double>(progress.to_go_m.size());
  progress.touchdown_s = steps * kStep_s + (to_go_m - path.touchdown_to_go_m()) / speed_mps;
  if (approach.end != ApproachEnd::full_stop) return progress;

  const double stop_s = progress.touchdown_s + speed_mps / approach.rollout_deceleration_mps2;
  for (double time_s = steps * kStep_s; time_s <= stop_s;
       time_s = static_cast<double>(progress.to_go_m.size()) * kStep_s) {
    const double rolling_s = time_s - progress.touchdown_s;
    progress.to_go_m.push_back(
        path.touchdown_to_go_m() -
        rolling_s * (speed_mps - 0.5 * approach.rollout_deceleration_mps2 * rolling_s));
  }
  return progress;
}

// Nose up when the main wheels touch, against the horizon.
double touchdown_pitch_rad(const IlsApproach& approach) {
  return std::atan(approach.runway_slope) + approach.touchdown_pitch_rad;
}

struct AirMotion {
  double heading_rad = 0.0;
  double path_rad = 0.0;
  double speed_mps = 0.0;
};

AirMotion through_air(const IlsApproach& approach, const glm::dvec3& v_N_mps) {
  const double north_mps = v_N_mps.x + approach.wind_speed_mps * std::cos(approach.wind_from_rad);
  const double east_mps = v_N_mps.y + approach.wind_speed_mps * std::sin(approach.wind_from_rad);
  const double level_mps = std::hypot(north_mps, east_mps);
  return {std::atan2(east_mps, north_mps), std::atan2(-v_N_mps.z, level_mps),
          std::hypot(level_mps, v_N_mps.z)};
}

core::Attitude attitude_in_the_air(const IlsApproach& approach, const IlsPath& path, double to_go_m,
                                   const glm::dvec3& v_N_mps, const glm::dvec3& a_N_mps2) {
  const AirMotion air = through_air(approach, v_N_mps);
  const double flare = smooth_step((path.flare_to_go_m() - to_go_m) /
                                   (path.flare_to_go_m() - path.touchdown_to_go_m()));
  const double track_rad = std::atan2(v_N_mps.y, v_N_mps.x);
  const double crab_rad = core::wrap_pi_rad(air.heading_rad - track_rad);
  return {
      (1.0 - flare) * coordinated_roll_rad(v_N_mps, a_N_mps2),
      std::lerp(air.path_rad + approach.angle_of_attack_rad, touchdown_pitch_rad(approach), flare),
      track_rad + (1.0 - flare) * crab_rad};
}

// Adds turbulence to positions and attitudes.
void shake(const IlsApproach& approach, const terrain::LocalFrame& frame, const IlsPath& path,
           const Progress& progress, const std::vector<glm::dvec3>& velocities,
           std::vector<core::Geodetic>& positions, std::vector<core::Attitude>& attitudes) {
  if (approach.turbulence_wind_20ft_mps == 0.0) return;
  DrydenGusts gusts(approach.seed, kStep_s);
  GustResponse response;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double wheels_m = path.wheel_height_m(progress.to_go_m[i]);
    if (wheels_m <= 0.0) return;
    const double airspeed_mps = through_air(approach, velocities[i]).speed_mps;
    const glm::dvec3 gust_mps =
        gusts.next(dryden_scales(wheels_m, approach.turbulence_wind_20ft_mps), airspeed_mps);
    const GustResponse::Disturbance disturbed = response.next(gust_mps, airspeed_mps, kStep_s);
    const double share = smooth_step(wheels_m / kCalmBelow_m);
    const double track_rad = std::atan2(velocities[i].y, velocities[i].x);
    const double c = std::cos(track_rad);
    const double s = std::sin(track_rad);
    const glm::dvec3 offset_m = share * disturbed.offset_m;
    const glm::dvec3 offset_N_m{c * offset_m.x - s * offset_m.y, s * offset_m.x + c * offset_m.y,
                                offset_m.z};
    positions[i] = frame.to_geodetic(frame.to_local_m(positions[i]) +
                                     frame.north_east_down_at(positions[i]) * offset_N_m);
    attitudes[i].roll_rad += share * disturbed.angles.roll_rad;
    attitudes[i].pitch_rad += share * disturbed.angles.pitch_rad;
    attitudes[i].heading_rad += share * disturbed.angles.heading_rad;
  }
}

}  // namespace

Trajectory fly_ils_approach(const IlsApproach& approach, const terrain::LocalFrame& frame) {
  check(approach);
  const IlsPath path(approach, frame);
  const Progress progress = fly(approach, path);
  const std::size_t count = progress.to_go_m.size();
  std::vector<double> times_s(count);
  std::vector<core::Geodetic> positions(count);
  for (std::size_t i = 0; i < count; ++i) {
    times_s[i] = static_cast<double>(i) * kStep_s;
    positions[i] = path.position(progress.to_go_m[i]);
  }
  constexpr double kNeighbours_s = 1.01 * kStep_s;
  std::vector<glm::dvec3> velocities = velocities_N_mps(times_s, positions, frame, kNeighbours_s);
  const std::vector<glm::dvec3> accelerations = slopes_per_s(times_s, velocities, kNeighbours_s);

  std::vector<core::Attitude> attitudes(count);
  double runway_heading_rad = approach.runway_bearing_rad;
  for (std::size_t i = 0; i < count; ++i) {
    const double rolling_s = times_s[i] - progress.touchdown_s;
    if (rolling_s < 0.0) {
      attitudes[i] =
          attitude_in_the_air(approach, path, progress.to_go_m[i], velocities[i], accelerations[i]);
      runway_heading_rad = attitudes[i].heading_rad;
    } else {
      attitudes[i] = {0.0,
                      std::lerp(touchdown_pitch_rad(approach), std::atan(approach.runway_slope),
                                smooth_step(rolling_s / kDerotation_s)),
                      runway_heading_rad};
    }
  }
  shake(approach, frame, path, progress, velocities, positions, attitudes);
  velocities = velocities_N_mps(times_s, positions, frame, kNeighbours_s);

  std::vector<core::Pose> poses(count);
  for (std::size_t i = 0; i < count; ++i)
    poses[i] = {approach.begin_s + times_s[i], positions[i], core::quaternion_from(attitudes[i]),
                velocities[i]};
  return Trajectory(std::move(poses));
}

}  // namespace fanbeam::scenes
