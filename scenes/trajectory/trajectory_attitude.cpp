#include "scenes/trajectory/trajectory_attitude.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/constants.h"
#include "core/number_range.h"
#include "scenes/trajectory/trajectory_kinematics.h"
#include "scenes/trajectory/trajectory_smoothing.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {
namespace {

using core::ErrorClass;

constexpr double kLongestGap_s = 60.0;
// Two rows a day apart would make a million poses that nobody flew.
constexpr double kMostBridged_s = 6.0 * 3600.0;
constexpr double kVelocityHalfWindow_s = 0.5;

void check(const AttitudeAssumptions& assumed) {
  core::ProblemList problems;
  const PathSmoothing& smoothing = assumed.smoothing;
  core::check_range(problems, "angle_of_attack_deg", core::degrees(assumed.angle_of_attack_rad),
                    {-10.0, 20.0});
  core::check_range(problems, "slowest_mps", assumed.slowest_mps, {0.1, 50.0});
  core::check_range(problems, "step_s", assumed.step_s, {0.01, 1.0});
  core::check_range(problems, "position_noise_m", smoothing.position_noise_m, {0.01, 1000.0});
  core::check_range(problems, "height_noise_m", smoothing.height_noise_m, {0.01, 1000.0});
  core::check_range(problems, "horizontal_jerk_density_m2_per_s5",
                    smoothing.horizontal_jerk_density_m2_per_s5, {1e-6, 1e3});
  core::check_range(problems, "vertical_jerk_density_m2_per_s5",
                    smoothing.vertical_jerk_density_m2_per_s5, {1e-6, 1e3});
  problems.throw_if_errors();
}

std::vector<double> times_of(const RawTrack& track) {
  std::vector<double> times_s;
  times_s.reserve(track.rows.size());
  for (const TrackRow& row : track.rows) times_s.push_back(row.time_s);
  return times_s;
}

// Position, velocity and acceleration of a smoothed track at any time inside it.
class SmoothPath {
 public:
  SmoothPath(const RawTrack& track, const std::vector<double>& times_s,
             const PathSmoothing& smoothing)
      : times_s_(times_s), frame_(foot_point(track.rows.front().position)) {
    // The foot points on the ellipsoid, so that poles and the date line are ordinary places, and
    // the height by itself, because its noise is another.
    std::array<std::vector<double>, 3> foot_m;
    std::vector<double> height_m;
    for (const TrackRow& row : track.rows) {
      const glm::dvec3 local_m = frame_.to_local_m(foot_point(row.position));
      for (int axis = 0; axis < 3; ++axis) foot_m[axis].push_back(local_m[axis]);
      height_m.push_back(row.position.height_m);
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
      foot_[axis] = smoothed(times_s, foot_m[axis], smoothing.position_noise_m,
                             smoothing.horizontal_jerk_density_m2_per_s5);
    height_ = smoothed(times_s, height_m, smoothing.height_noise_m,
                       smoothing.vertical_jerk_density_m2_per_s5);
  }

  struct State {
    core::Geodetic position;
    glm::dvec3 v_N_mps;
    glm::dvec3 a_N_mps2;
  };

  // In the step that begins with row `row`, `s` of it on.
  State at(std::size_t row, double s) const {
    const double step_s = times_s_[row + 1] - times_s_[row];
    glm::dvec3 foot_m, rate_mps, acceleration_mps2;
    for (int axis = 0; axis < 3; ++axis) {
      const auto& series = foot_[static_cast<std::size_t>(axis)];
      const SmoothPoint point = between(series[row], series[row + 1], step_s, s);
      foot_m[axis] = point.value;
      rate_mps[axis] = point.rate_per_s;
      acceleration_mps2[axis] = point.acceleration_per_s2;
    }
    const SmoothPoint height = between(height_[row], height_[row + 1], step_s, s);
    State state;
    state.position = frame_.to_geodetic(foot_m);
    state.position.height_m = height.value;
    const glm::dmat3 here_from_local = glm::transpose(frame_.north_east_down_at(state.position));
    const double stretch = 1.0 + height.value / core::kMeanEarthRadius_m;
    state.v_N_mps = stretch * (here_from_local * rate_mps);
    state.a_N_mps2 = stretch * (here_from_local * acceleration_mps2);
    state.v_N_mps.z = -height.rate_per_s;
    state.a_N_mps2.z = -height.acceleration_per_s2;
    return state;
  }

 private:
  const std::vector<double>& times_s_;
  terrain::LocalFrame frame_;
  std::array<std::vector<SmoothPoint>, 3> foot_;
  std::vector<SmoothPoint> height_;
};

double angle_between(double from_rad, double to_rad, double s) {
  return from_rad + s * core::wrap_pi_rad(to_rad - from_rad);
}

// The attitude of a smoothed path, recorded angles first.
class AttitudeSource {
 public:
  AttitudeSource(const RawTrack& track, const AttitudeAssumptions& assumed)
      : track_(track), assumed_(assumed) {}

  core::Attitude at(std::size_t row, double s, const SmoothPath::State& state) {
    const TrackRow& from = track_.rows[row];
    const TrackRow& to = track_.rows[row + 1];
    const double ground_speed_mps = std::hypot(state.v_N_mps.x, state.v_N_mps.y);
    const bool moves = ground_speed_mps >= assumed_.slowest_mps;
    if (moves) track_rad_ = std::atan2(state.v_N_mps.y, state.v_N_mps.x);
    core::Attitude attitude;
    attitude.heading_rad =
        track_.has_heading ? angle_between(from.heading_rad, to.heading_rad, s) : track_rad_;
    if (track_.has_pitch) {
      attitude.pitch_rad = angle_between(from.pitch_rad, to.pitch_rad, s);
    } else {
      const double path_rad = moves ? std::atan2(-state.v_N_mps.z, ground_speed_mps) : 0.0;
      attitude.pitch_rad = path_rad + assumed_.angle_of_attack_rad;
    }
    if (track_.has_roll) {
      attitude.roll_rad = angle_between(from.roll_rad, to.roll_rad, s);
    } else if (moves) {
      attitude.roll_rad = coordinated_roll_rad(state.v_N_mps, state.a_N_mps2);
    }
    return attitude;
  }

  // Heading for a path that begins at rest.
  void begin_with(double track_rad) { track_rad_ = track_rad; }

 private:
  const RawTrack& track_;
  const AttitudeAssumptions& assumed_;
  double track_rad_ = 0.0;
};

double first_track_rad(const SmoothPath& path, std::size_t rows, double slowest_mps) {
  for (std::size_t row = 0; row + 1 < rows; ++row) {
    const glm::dvec3 v = path.at(row, 0.0).v_N_mps;
    if (std::hypot(v.x, v.y) >= slowest_mps) return std::atan2(v.y, v.x);
  }
  return 0.0;
}

std::vector<core::Pose> derived_poses(const RawTrack& track, const AttitudeAssumptions& assumed) {
  const std::vector<double> times_s = times_of(track);
  const SmoothPath path(track, times_s, assumed.smoothing);
  AttitudeSource attitudes(track, assumed);
  attitudes.begin_with(first_track_rad(path, times_s.size(), assumed.slowest_mps));
  const double duration_s = times_s.back() - times_s.front();
  const double steps = std::ceil(duration_s / assumed.step_s);
  if (steps > static_cast<double>(kMostTrackRows))
    core::throw_input_error(ErrorClass::limit, "derived poses", steps,
                            "at most " + std::to_string(kMostTrackRows) +
                                "; choose a part of the flight or a longer step");
  // Equal steps that end with the last row.
  const auto count = static_cast<std::size_t>(steps);
  std::vector<core::Pose> poses;
  poses.reserve(count + 1);
  std::size_t row = 0;
  for (std::size_t k = 0; k <= count; ++k) {
    core::Pose pose;
    pose.time_s = std::lerp(times_s.front(), times_s.back(), static_cast<double>(k) / steps);
    while (row + 2 < times_s.size() && times_s[row + 1] <= pose.time_s) ++row;
    const double s = (pose.time_s - times_s[row]) / (times_s[row + 1] - times_s[row]);
    const SmoothPath::State state = path.at(row, s);
    pose.position = state.position;
    pose.v_N_mps = state.v_N_mps;
    pose.q_NB = core::quaternion_from(attitudes.at(row, s, state));
    poses.push_back(pose);
  }
  return poses;
}

core::Pose recorded_pose(const TrackRow& row) {
  core::Pose pose;
  pose.time_s = row.time_s;
  pose.position = row.position;
  pose.q_NB = core::quaternion_from({row.roll_rad, row.pitch_rad, row.heading_rad});
  return pose;
}

std::vector<core::Pose> recorded_poses(const RawTrack& track) {
  std::vector<core::Pose> poses;
  std::vector<core::Geodetic> positions;
  poses.reserve(track.rows.size());
  positions.reserve(track.rows.size());
  for (const TrackRow& row : track.rows) {
    poses.push_back(recorded_pose(row));
    positions.push_back(row.position);
  }
  const terrain::LocalFrame frame(positions.front());
  const std::vector<glm::dvec3> velocities =
      velocities_N_mps(times_of(track), positions, frame, kVelocityHalfWindow_s);
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i].v_N_mps = velocities[i];
  return poses;
}

void check_times(const RawTrack& track) {
  if (track.rows.empty())
    core::throw_input_error(ErrorClass::range, "track", "no row", "at least one row");
  for (std::size_t i = 1; i < track.rows.size(); ++i)
    if (!(track.rows[i].time_s > track.rows[i - 1].time_s))
      core::throw_input_error(ErrorClass::time, "track row " + std::to_string(i + 1),
                              core::number_text(track.rows[i].time_s) + " s",
                              "later than the row before");
}

void check_gaps(const RawTrack& track, core::ProblemList& problems) {
  std::size_t gaps = 0;
  double longest_s = 0.0;
  double all_s = 0.0;
  core::Place place{track.file};
  for (std::size_t i = 1; i < track.rows.size(); ++i) {
    const double step_s = track.rows[i].time_s - track.rows[i - 1].time_s;
    if (step_s > kLongestGap_s) {
      ++gaps;
      all_s += step_s;
    }
    if (step_s <= longest_s) continue;
    longest_s = step_s;
    place.line = track.rows[i].line;
  }
  if (all_s > kMostBridged_s)
    core::throw_input_error(ErrorClass::limit, "gaps of more than 60 s, together",
                            core::number_text(all_s) + " s",
                            "at most " + core::number_text(kMostBridged_s) +
                                " s to be bridged: choose a part of the flight");
  if (gaps > 0)
    problems.warning("GAP", place, "rows more than 60 s apart", std::to_string(gaps),
                     "bridged by a smooth curve; the longest, before this one, lasts " +
                         core::number_text(longest_s) + " s");
}

}  // namespace

Trajectory trajectory_from(const RawTrack& track, const AttitudeAssumptions& assumptions,
                           core::ProblemList& problems) {
  check(assumptions);
  check_times(track);
  const bool recorded = track.has_roll && track.has_pitch && track.has_heading;
  const bool fixed = track.rows.size() == 1;
  if (fixed && !recorded)
    problems.warning("ATTITUDE", {}, "fixed pose", "not all angles recorded",
                     "the others are taken as 0");
  if (!recorded) check_gaps(track, problems);
  Trajectory trajectory(recorded || fixed ? recorded_poses(track)
                                          : derived_poses(track, assumptions));
  trajectory.attitude_derived = !recorded;
  trajectory.rejected = track.rejected;
  return trajectory;
}

}  // namespace fanbeam::scenes
