#include "scenes/trajectory/trajectory_attitude.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/errors.h"
#include "core/units.h"
#include "scenes/trajectory/trajectory_smoothing.h"
#include "terrain/local_frame.h"
#include "tests/shared_data.h"

namespace fanbeam::scenes {
namespace {

constexpr double kGravity_mps2 = 9.80665;

RawTrack track_of(const std::vector<double>& times_s,
                  const std::vector<core::Geodetic>& positions) {
  RawTrack track;
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    TrackRow row;
    row.time_s = times_s[i];
    row.position = positions[i];
    track.rows.push_back(row);
  }
  return track;
}

// A level left-hand or right-hand circle, seen every `step_s`.
RawTrack circle(const core::Geodetic& centre, double radius_m, double turn_rad_per_s, double step_s,
                double duration_s) {
  std::vector<double> times_s;
  std::vector<core::Geodetic> positions;
  for (double t = 0.0; t <= duration_s; t += step_s) {
    times_s.push_back(t);
    positions.push_back(terrain::geodesic_point(centre, turn_rad_per_s * t, radius_m));
  }
  return track_of(times_s, positions);
}

Trajectory without_problems(const RawTrack& track, const AttitudeAssumptions& assumed = {}) {
  core::ProblemList problems;
  Trajectory trajectory = trajectory_from(track, assumed, problems);
  CHECK(problems.all().empty());
  return trajectory;
}

RawTrack adsb_track(const std::filesystem::path& path, const std::string& height_column,
                    double from_s, double to_s) {
  TrajectoryColumns columns;
  columns.time.name = "time_unix_s";
  columns.latitude.name = "lat_deg";
  columns.longitude.name = "lon_deg";
  columns.height.name = height_column;
  columns.from_time_s = from_s;
  columns.to_time_s = to_s;
  core::ProblemList problems;
  RawTrack track = read_track_csv(path, columns, problems);
  problems.throw_if_errors();
  return track;
}

struct Statistics {
  double mean = 0.0;
  double deviation = 0.0;
};

Statistics statistics_of(const std::vector<double>& values) {
  Statistics result;
  for (const double value : values) result.mean += value / static_cast<double>(values.size());
  for (const double value : values)
    result.deviation += (value - result.mean) * (value - result.mean);
  result.deviation = std::sqrt(result.deviation / static_cast<double>(values.size()));
  return result;
}

// Sum of the geodesics between neighbours at height 0.
double ground_length_m(const Trajectory& trajectory) {
  const std::vector<core::Pose>& poses = trajectory.poses();
  double length_m = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i)
    length_m += terrain::geodesic_between(poses[i - 1].position, poses[i].position).length_m;
  return length_m;
}

double path_angle_deg(const core::Pose& pose) {
  return core::degrees(std::atan2(-pose.v_N_mps.z, std::hypot(pose.v_N_mps.x, pose.v_N_mps.y)));
}

}  // namespace

TEST_CASE("A parabola comes through the smoother unchanged", "[trajectory_attitude]") {
  // No jerk: whatever the noise assumed, data without noise must be reproduced, uneven times too.
  std::vector<double> times_s;
  std::vector<double> values;
  for (int i = 0; i < 60; ++i) {
    const double t = 4.0 * i + 1.5 * std::sin(3.0 * i);
    times_s.push_back(t);
    values.push_back(20.0 + 70.0 * t - 0.15 * t * t);
  }
  const std::vector<SmoothPoint> points = smoothed(times_s, values, 40.0, 1e-6);
  // The weak assumption of rest before the first sample is worth 1e-5 of the speed.
  CHECK(points[30].value == Approx(values[30]).epsilon(0.0).margin(0.2));
  CHECK(points[30].rate_per_s == Approx(70.0 - 0.3 * times_s[30]).epsilon(0.0).margin(2e-2));
  CHECK(points[30].acceleration_per_s2 == Approx(-0.3).epsilon(0.0).margin(2e-3));
}

TEST_CASE("Between two smoothed points runs the quintic through both", "[trajectory_attitude]") {
  const auto quintic = [](double t) {
    return SmoothPoint{1 + t * (2 + t * (-3 + t * (0.5 + t * (0.25 - 0.1 * t)))),
                       2 + t * (-6 + t * (1.5 + t * (1.0 - 0.5 * t))),
                       -6 + t * (3 + t * (3.0 - 2.0 * t))};
  };
  const SmoothPoint at = between(quintic(1.0), quintic(3.0), 2.0, 0.35);
  CHECK(at.value == Approx(quintic(1.7).value).epsilon(1e-13));
  CHECK(at.rate_per_s == Approx(quintic(1.7).rate_per_s).epsilon(1e-13));
  CHECK(at.acceleration_per_s2 == Approx(quintic(1.7).acceleration_per_s2).epsilon(1e-12));
}

TEST_CASE("Smoothing keeps a descent's rate through 25 ft steps", "[trajectory_attitude]") {
  // 3.7 m/s in steps of 7.62 m, 1 s apart: the naive rate is 0 or 7.6 m/s.
  std::vector<double> times_s;
  std::vector<double> heights_m;
  for (int i = 0; i < 200; ++i) {
    times_s.push_back(i);
    heights_m.push_back(7.62 * std::round((900.0 - 3.7 * i) / 7.62));
  }
  const std::vector<SmoothPoint> points = smoothed(times_s, heights_m, 5.0, 0.02);
  for (int i = 20; i < 180; ++i)
    CHECK(points[static_cast<std::size_t>(i)].rate_per_s == Approx(-3.7).epsilon(0.0).margin(0.4));
}

TEST_CASE("A steady circle gets the bank of a coordinated turn", "[trajectory_attitude]") {
  const double direction = GENERATE(1.0, -1.0);
  const double turn_rad_per_s = direction * core::radians(3.0);
  const double speed_mps = 70.0;
  const double radius_m = speed_mps / core::radians(3.0);
  const RawTrack track = circle({core::radians(48.0), core::radians(11.0), 900.0}, radius_m,
                                turn_rad_per_s, 5.0, 400.0);
  AttitudeAssumptions assumed;
  assumed.smoothing.position_noise_m = 5.0;  // the track is exact
  const Trajectory trajectory = without_problems(track, assumed);
  CHECK(trajectory.attitude_derived);
  const double roll_deg =
      direction * core::degrees(std::atan(speed_mps * core::radians(3.0) / kGravity_mps2));
  for (double t = 60.0; t < 340.0; t += 7.3) {
    const core::Attitude attitude = core::attitude_from(trajectory.at(t).q_NB);
    // The smoother flattens a circle of this period by its noise bandwidth, here by under 2 %.
    CHECK(core::degrees(attitude.roll_rad) == Approx(roll_deg).epsilon(0.03));
    CHECK(core::degrees(attitude.pitch_rad) == Approx(4.0).epsilon(0.0).margin(0.05));
    const double tangent_rad = turn_rad_per_s * t + direction * core::kPi / 2.0;
    CHECK(std::abs(core::degrees(core::wrap_pi_rad(attitude.heading_rad - tangent_rad))) < 0.5);
  }
}

TEST_CASE("A derived path crosses the pole and the date line", "[trajectory_attitude]") {
  const core::Geodetic before{core::radians(89.95), core::radians(-179.0), 1000.0};
  std::vector<double> times_s;
  std::vector<core::Geodetic> positions;
  for (int i = 0; i <= 20; ++i) {
    times_s.push_back(8.0 * i);
    positions.push_back(terrain::geodesic_point(before, 0.0, 70.0 * 8.0 * i));
  }
  const Trajectory trajectory = without_problems(track_of(times_s, positions));
  CHECK(ground_length_m(trajectory) == Approx(70.0 * 160.0).epsilon(1e-3));
  const core::Pose end = trajectory.at(140.0);
  CHECK(core::degrees(core::attitude_from(end.q_NB).heading_rad) ==
        Approx(180.0).epsilon(0.0).margin(0.05));
  CHECK(core::degrees(core::attitude_from(end.q_NB).roll_rad) ==
        Approx(0.0).epsilon(0.0).margin(0.1));
}

TEST_CASE("An aircraft that stops keeps its heading, one that starts has it before",
          "[trajectory_attitude]") {
  const core::Geodetic stand{core::radians(48.0), core::radians(11.0), 450.0};
  std::vector<double> times_s;
  std::vector<core::Geodetic> positions;
  for (int i = 0; i <= 120; ++i) {
    times_s.push_back(i);
    const double rolled_m = 10.0 * std::clamp(i - 40.0, 0.0, 40.0);
    positions.push_back(terrain::geodesic_point(stand, core::radians(75.0), rolled_m));
  }
  const Trajectory trajectory = without_problems(track_of(times_s, positions));
  for (const double t : {0.0, 60.0, 120.0})
    CHECK(core::degrees(core::attitude_from(trajectory.at(t).q_NB).heading_rad) ==
          Approx(75.0).epsilon(0.0).margin(0.1));
  CHECK(core::degrees(core::attitude_from(trajectory.at(0.0).q_NB).pitch_rad) ==
        Approx(4.0).epsilon(0.0).margin(0.01));
}

TEST_CASE("Angles that were recorded are kept, through north too", "[trajectory_attitude]") {
  RawTrack track =
      circle({core::radians(48.0), core::radians(11.0), 900.0}, 2000.0, 0.03, 2.0, 40.0);
  track.has_heading = true;
  for (TrackRow& row : track.rows)
    row.heading_rad = core::wrap_pi_rad(core::radians(350.0 + row.time_s));
  const Trajectory trajectory = without_problems(track);
  CHECK(trajectory.attitude_derived);
  CHECK(core::degrees(core::attitude_from(trajectory.at(11.0).q_NB).heading_rad) ==
        Approx(1.0).epsilon(0.0).margin(1e-6));
}

TEST_CASE("What was assumed or bridged is said", "[trajectory_attitude]") {
  const core::Geodetic place{core::radians(48.0), core::radians(11.0), 450.0};
  core::ProblemList problems;
  const Trajectory fixed = trajectory_from(track_of({5.0}, {place}), {}, problems);
  CHECK(fixed.poses().size() == 1);
  CHECK(problems.all().at(0).code == "W-ATTITUDE");
  const core::Geodetic far_off = terrain::geodesic_point(place, 1.0, 7000.0);
  core::ProblemList gap;
  trajectory_from(track_of({0.0, 100.0}, {place, far_off}), {}, gap);
  CHECK(gap.all().at(0).code == "W-GAP");
  CHECK_THROWS_WITH(trajectory_from(track_of({1.0, 1.0}, {place, place}), {}, gap),
                    Catch::Contains("E-TIME"));
  AttitudeAssumptions wrong;
  wrong.step_s = 0.0;
  wrong.smoothing.height_noise_m = std::nan("");
  CHECK_THROWS_WITH(
      trajectory_from(track_of({1.0}, {place}), wrong, gap),
      Catch::Contains("E-RANGE step_s") && Catch::Contains("E-NONFINITE height_noise_m"));
  CHECK_THROWS_WITH(trajectory_from(track_of({0.0, 1e6}, {place, far_off}), {}, gap),
                    Catch::Contains("E-LIMIT"));
}

// Two rows of text kept the reader busy for seconds, making poses by the million.
TEST_CASE("Hours without a row are not bridged", "[trajectory_attitude]") {
  const core::Geodetic place{core::radians(48.0), core::radians(11.0), 450.0};
  const core::Geodetic far_off = terrain::geodesic_point(place, 1.0, 7000.0);
  core::ProblemList problems;
  CHECK_THROWS_WITH(
      trajectory_from(track_of({0.0, 11000.0, 21601.0}, {place, far_off, place}), {}, problems),
      Catch::Contains("E-LIMIT gaps of more than 60 s, together = 21601 s"));
  CHECK(trajectory_from(track_of({0.0, 11000.0, 21600.0}, {place, far_off, place}), {}, problems)
            .poses()
            .size() == 216'001);
}

TEST_CASE("Real flight: the airliner to Denver descends at 3 degrees", "[trajectory_attitude]") {
  const auto path = tests::shared_data("trajectories/kden_rwy26_dal1812.csv");
  if (!path) return;
  // From the intercept of the localiser to before the flare, 21 km.
  const RawTrack track = adsb_track(*path, "alt_geom_ft", 1738784100.0, 1738785279.0);
  const Trajectory trajectory = without_problems(track);
  std::vector<double> angles_deg;
  for (double t = 1738784980.0; t < 1738785240.0; t += 1.0) {
    const core::Pose pose = trajectory.at(t);
    angles_deg.push_back(path_angle_deg(pose));
    const core::Attitude attitude = core::attitude_from(pose.q_NB);
    CHECK(core::degrees(attitude.heading_rad) == Approx(270.6).epsilon(0.0).margin(1.5));
    CHECK(std::abs(core::degrees(attitude.roll_rad)) < 5.0);
    CHECK(core::degrees(attitude.pitch_rad) ==
          Approx(path_angle_deg(pose) + 4.0).epsilon(0.0).margin(1e-6));
  }
  const Statistics angle = statistics_of(angles_deg);
  CAPTURE(angle.mean, angle.deviation);
  // The beam's 3.0 deg at the runway are 3.1 deg against the horizon 11 km before it, the middle.
  CHECK(angle.mean == Approx(-3.1).epsilon(0.0).margin(0.1));
  CHECK(angle.deviation < 0.4);
  // The path stays with what was recorded: within the noise assumed.
  for (const TrackRow& row : track.rows) {
    const core::Geodetic smooth = trajectory.at(row.time_s).position;
    CHECK(terrain::geodesic_between(smooth, row.position).length_m < 120.0);
    CHECK(std::abs(smooth.height_m - row.position.height_m) < 15.0);
  }
}

TEST_CASE("Real flight: the calibration aircraft at Munich flies down runway 08L",
          "[trajectory_attitude]") {
  const auto path = tests::shared_data("trajectories/eddm_ils_calibration.csv");
  if (!path) return;
  // The first run, from 12 km out to before the level pass along the runway.
  const RawTrack track = adsb_track(*path, "alt_baro_ft", 1551741060.0, 1551741330.0);
  // The positions are filled in linearly between fixes that are late by up to 2 s: their speed
  // jumps between 60 and 120 m/s.
  AttitudeAssumptions assumed;
  assumed.smoothing.position_noise_m = 200.0;
  const Trajectory trajectory = without_problems(track, assumed);
  std::vector<double> angles_deg;
  for (double t = 1551741140.0; t < 1551741250.0; t += 1.0) {
    const core::Pose pose = trajectory.at(t);
    angles_deg.push_back(path_angle_deg(pose));
    CHECK(core::degrees(core::attitude_from(pose.q_NB).heading_rad) ==
          Approx(83.45).epsilon(0.0).margin(1.5));
    CHECK(std::abs(core::degrees(core::attitude_from(pose.q_NB).roll_rad)) < 5.0);
  }
  // Glide path 3.0 deg; recorded ground speed and vertical rate give the same within their steps.
  CHECK(statistics_of(angles_deg).mean == Approx(-3.0).epsilon(0.0).margin(0.3));
  // Recorded ground speeds are 175 to 190 kt, 90 to 98 m/s.
  for (double t = 1551741140.0; t < 1551741250.0; t += 1.0) {
    const glm::dvec3 v = trajectory.at(t).v_N_mps;
    CHECK(std::hypot(v.x, v.y) == Approx(95.0).epsilon(0.0).margin(15.0));
  }
}

TEST_CASE("Real flight: the simulator's own attitude is taken as it is", "[trajectory_attitude]") {
  const auto path = tests::shared_data("flightgear/bikf10.csv");
  if (!path) return;
  TrajectoryColumns columns;
  columns.time.name = "sim_time_s";
  columns.latitude.name = "lat_deg";
  columns.longitude.name = "lon_deg";
  columns.height.name = "alt_ft";
  columns.heading = {"heading_true_deg", "deg", false};
  core::ProblemList problems;
  const RawTrack track = read_track_csv(*path, columns, problems);
  CHECK(problems.all().empty());
  const Trajectory trajectory = without_problems(track);
  CHECK_FALSE(trajectory.attitude_derived);
  CHECK(trajectory.poses().size() == 7188);
  // Rows 1 and 2 of the file.
  const core::Pose first = trajectory.at(10.25);
  CHECK(core::degrees(core::attitude_from(first.q_NB).pitch_rad) == Approx(-1.542540613));
  CHECK(core::degrees(core::attitude_from(first.q_NB).roll_rad) == Approx(-0.379545090));
  CHECK(first.position.height_m == Approx(910.687222 * 0.3048));
  // Velocity is not read; the simulator wrote its own in the row of 60.258333 s, in ft/s. The mean
  // over a second differs from it by what it changes in a second.
  const glm::dvec3 v_N_mps = trajectory.at(60.258333).v_N_mps;
  CHECK(v_N_mps.x == Approx(0.109266 * 0.3048).epsilon(0.0).margin(0.05));
  CHECK(v_N_mps.y == Approx(132.809856 * 0.3048).epsilon(0.0).margin(0.05));
  CHECK(v_N_mps.z == Approx(6.932083 * 0.3048).epsilon(0.0).margin(0.05));
}

}  // namespace fanbeam::scenes
