// Rows of recorded flights that no aircraft could have flown are blamed, and they alone.
#include "scenes/trajectory/track_check.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "core/units.h"
#include "scenes/trajectory/track_order.h"
#include "terrain/local_frame.h"
#include "tests/shared_data.h"

namespace fanbeam::scenes {
namespace {

using core::radians;

// An approach as transponders tell it: 70 m/s along 84 deg on a 3 deg path, rows `step_s` apart,
// heights rounded to 25 ft; with attitude when asked.
RawTrack approach(std::size_t rows, double step_s, bool with_attitude = false) {
  RawTrack track;
  track.file = "flight.csv";
  const core::Geodetic begin{radians(47.25), radians(11.1), 1500.0};
  for (std::size_t i = 0; i < rows; ++i) {
    TrackRow row;
    row.time_s = step_s * static_cast<double>(i);
    row.position = terrain::geodesic_point(begin, radians(84.0), 70.0 * row.time_s);
    const double height_m = 1500.0 - 70.0 * row.time_s * std::tan(radians(3.0));
    row.position.height_m =
        with_attitude ? height_m : 25.0 * core::kFoot_m * std::round(height_m / 7.62);
    row.pitch_rad = radians(1.0);
    row.heading_rad = radians(84.0);
    row.row = static_cast<std::int32_t>(i + 1);
    row.line = static_cast<std::int32_t>(i + 2);
    track.rows.push_back(row);
  }
  track.has_roll = track.has_pitch = track.has_heading = with_attitude;
  return track;
}

struct Checked {
  RawTrack track;
  std::vector<core::Problem> problems;
};

Checked checked(RawTrack track, OutlierPolicy policy = OutlierPolicy::error,
                const std::string& height_unit = "ft") {
  TrajectoryColumns columns;
  columns.outliers = policy;
  columns.height.unit = height_unit;
  core::ProblemList problems;
  check_track(track, columns, {}, problems);
  return {std::move(track), problems.all()};
}

// "E-RANGE@58 height" of every error.
std::set<std::string> errors(const std::vector<core::Problem>& problems) {
  std::set<std::string> told;
  for (const core::Problem& problem : problems) {
    UNSCOPED_INFO(core::to_string(problem));
    if (!problem.is_error()) continue;
    CHECK(problem.place.file == "flight.csv");
    told.insert(problem.code + "@" + std::to_string(problem.place.line) + " " + problem.field);
  }
  return told;
}

std::set<std::string> codes(const std::vector<core::Problem>& problems) {
  std::set<std::string> told;
  for (const core::Problem& problem : problems) told.insert(problem.code);
  return told;
}

void move_north(TrackRow& row, double distance_m) {
  row.position.latitude_rad += distance_m / 6371e3;
}

}  // namespace

TEST_CASE("A row at 35 925 ft among 1000 m is blamed alone, by row, line, value and expectation",
          "[track_check]") {
  RawTrack track = approach(60, 5.0);
  track.rows[29].position.height_m = 35925.0 * core::kFoot_m;
  const Checked result = checked(track);
  REQUIRE(errors(result.problems) == std::set<std::string>{"E-RANGE@31 row 30, height"});
  const core::Problem& problem = result.problems.front();
  CHECK(problem.value.find("10949.9 m (35925 ft), climb or descent of 199") == 0);
  CHECK(problem.expected.find("rows 29 and 31") != std::string::npos);
  CHECK(problem.expected.find("outliers = \"reject\"") != std::string::npos);
  CHECK(checked(approach(60, 5.0)).problems.empty());
}

TEST_CASE("One, two or three wrong rows in a run are blamed, not their neighbours; at the ends too",
          "[track_check]") {
  for (const double step_s : {0.0625, 1.0, 5.0}) {
    for (const std::size_t count : {1U, 2U, 3U}) {
      for (const std::size_t first :
           {std::size_t{0}, std::size_t{1}, std::size_t{25}, 60 - count}) {
        INFO(count << " rows from row " << first + 1 << ", " << step_s << " s apart");
        std::set<std::string> expected_position, expected_height;
        RawTrack beside = approach(60, step_s, step_s < 1.0);
        RawTrack above = beside;
        for (std::size_t i = first; i < first + count; ++i) {
          const std::string row = std::to_string(i + 2) + " row " + std::to_string(i + 1);
          move_north(beside.rows[i], 3000.0);
          above.rows[i].position.height_m += 4000.0;
          expected_position.insert("E-RANGE@" + row + ", position");
          expected_height.insert("E-RANGE@" + row + ", height");
        }
        CHECK(errors(checked(beside).problems) == expected_position);
        CHECK(errors(checked(above).problems) == expected_height);
      }
    }
  }
}

TEST_CASE("A wrong clock reading is blamed, not the rows that follow", "[track_check]") {
  // Still in order: the row is where the aircraft was 4 s before or after.
  RawTrack track = approach(200, 0.5, true);
  track.rows[80].time_s += 0.4;
  track.rows[80].position = track.rows[88].position;
  CHECK(errors(checked(track).problems) == std::set<std::string>{"E-RANGE@82 row 81, position"});
  // Out of order: too late, too early, standing.
  for (const double shift_s : {500.0, -30.0}) {
    RawTrack disordered = approach(60, 5.0);
    disordered.rows[20].time_s += shift_s;
    CHECK(rows_out_of_order(disordered.rows) == std::vector<std::size_t>{20});
    core::ProblemList problems;
    TrajectoryColumns columns;
    bring_into_order(disordered, columns, problems);
    CHECK(errors(problems.all()) == std::set<std::string>{"E-TIME@22 time_s"});
    columns.outliers = OutlierPolicy::reject;
    bring_into_order(disordered, columns, problems);
    CHECK(disordered.rows.size() == 59);
    REQUIRE(disordered.rejected.size() == 1);
    CHECK(disordered.rejected[0].first_row == 21);
    CHECK(disordered.rejected[0].why == "time");
  }
}

TEST_CASE("A wrong heading, pitch or roll is blamed by its name", "[track_check]") {
  for (const double step_s : {0.0625, 1.0}) {
    RawTrack track = approach(100, step_s, true);
    track.rows[40].heading_rad = radians(264.0);
    track.rows[60].pitch_rad = radians(85.0);
    track.rows[61].pitch_rad = radians(85.0);
    CHECK(errors(checked(track).problems) == std::set<std::string>{"E-RANGE@42 row 41, heading",
                                                                   "E-RANGE@62 row 61, pitch",
                                                                   "E-RANGE@63 row 62, pitch"});
  }
  RawTrack rolled = approach(100, 0.0625, true);
  rolled.rows[40].roll_rad = radians(170.0);
  CHECK(errors(checked(rolled).problems) == std::set<std::string>{"E-RANGE@42 row 41, roll"});
  // Through north and over the date line nothing jumps.
  RawTrack north = approach(100, 0.0625, true);
  for (std::size_t i = 0; i < north.rows.size(); ++i) {
    north.rows[i].heading_rad = radians(i % 2 == 0 ? 359.9 : 0.1);
    north.rows[i].position.longitude_rad += radians(180.0 - 11.1);
    if (north.rows[i].position.longitude_rad > core::kPi)
      north.rows[i].position.longitude_rad -= 2.0 * core::kPi;
  }
  CHECK(checked(north).problems.empty());
}

TEST_CASE("Rejected rows are left out, counted and listed; the flight is that of the others",
          "[track_check]") {
  RawTrack track = approach(60, 5.0);
  const RawTrack good = track;
  track.rows[10].position.height_m = 9000.0;
  move_north(track.rows[11], 20e3);
  move_north(track.rows[40], -20e3);
  const Checked result = checked(track, OutlierPolicy::reject);
  REQUIRE(result.problems.size() == 1);
  CHECK(result.problems[0].code == "W-OUTLIER");
  CHECK(result.problems[0].place.line == 12);
  CHECK(result.problems[0].value == "3");
  REQUIRE(result.track.rejected.size() == 3);
  CHECK(result.track.rejected[0].why == "height");
  CHECK(result.track.rejected[1].first_row == 12);
  CHECK(result.track.rejected[2].first_time_s == 200.0);
  REQUIRE(result.track.rows.size() == 57);
  for (const TrackRow& row : result.track.rows) {
    const TrackRow& same = good.rows.at(static_cast<std::size_t>(row.row - 1));
    CHECK(row.position.height_m == same.position.height_m);
    CHECK(row.position.latitude_rad == same.position.latitude_rad);
  }
  const Checked kept = checked(track, OutlierPolicy::keep);
  CHECK(kept.problems.empty());
  CHECK(kept.track.rows.size() == 60);
}

TEST_CASE("A position that stands while the flight goes on is stale, a parked aircraft is not",
          "[track_check]") {
  const auto held = [](std::size_t rows) {
    RawTrack track = approach(120, 1.0);
    for (std::size_t i = 51; i < 51 + rows; ++i) {
      track.rows[i].position.latitude_rad = track.rows[50].position.latitude_rad;
      track.rows[i].position.longitude_rad = track.rows[50].position.longitude_rad;
    }
    return track;
  };
  // 70 m are within the 120 m that the smoothing takes for noise; 1400 m are not.
  CHECK(codes(checked(held(1)).problems) == std::set<std::string>{"W-STALE"});
  CHECK(errors(checked(held(20)).problems) ==
        std::set<std::string>{"E-RANGE@53 rows 52 to 71, position"});
  const Checked rejected = checked(held(20), OutlierPolicy::reject);
  CHECK(rejected.track.rows.size() == 100);
  REQUIRE(rejected.track.rejected.size() == 1);
  CHECK(rejected.track.rejected[0].why == "stale");
  CHECK(rejected.track.rejected[0].count == 20);

  RawTrack parked = approach(60, 1.0);
  for (TrackRow& row : parked.rows) row.position = parked.rows[0].position;
  CHECK(checked(parked).problems.empty());
}

TEST_CASE("What is odd but possible is a warning with its worst row", "[track_check]") {
  // 400 m/s: faster than airliners in any jet stream, slower than the fastest jets.
  RawTrack fast = approach(60, 5.0);
  for (TrackRow& row : fast.rows)
    row.position = terrain::geodesic_point({radians(47.25), radians(11.1), 9000.0}, radians(84.0),
                                           400.0 * row.time_s);
  CHECK(codes(checked(fast).problems) == std::set<std::string>{"W-SPEED"});
  // From 70 m/s to 600 m/s backwards, within a row: 330 m/s2 over the two seconds before and after.
  RawTrack kicked = approach(200, 0.1, true);
  for (std::size_t i = 100; i < 200; ++i)
    kicked.rows[i].position =
        terrain::geodesic_point(kicked.rows[100].position, radians(84.0 + 180.0),
                                600.0 * (kicked.rows[i].time_s - kicked.rows[100].time_s));
  CHECK(errors(checked(kicked).problems).size() == 1);
  RawTrack steep = approach(60, 1.0, true);
  steep.rows[30].pitch_rad = radians(50.0);
  CHECK(codes(checked(steep).problems) == std::set<std::string>{"W-PITCH"});
  RawTrack gap = approach(200, 0.0625, true);
  for (std::size_t i = 100; i < 200; ++i) {
    gap.rows[i].time_s += 10.0;
    gap.rows[i].position = terrain::geodesic_point(gap.rows[i].position, radians(84.0), 700.0);
    gap.rows[i].position.height_m -= 700.0 * std::tan(radians(3.0));
  }
  CHECK(codes(checked(gap).problems) == std::set<std::string>{"W-GAP"});
}

TEST_CASE("Wrong units are told once, and nothing is left out for them", "[track_check]") {
  RawTrack track = approach(300, 5.0);
  for (TrackRow& row : track.rows) row.time_s *= 1e-3;  // milliseconds taken for seconds
  for (const OutlierPolicy policy : {OutlierPolicy::error, OutlierPolicy::reject}) {
    const Checked result = checked(track, policy);
    REQUIRE(result.problems.size() == 1);
    CHECK(result.problems[0].code == "E-RANGE");
    CHECK(result.problems[0].value.find("median ground speed 7") != std::string::npos);
    CHECK(result.problems[0].expected.find("units of time") != std::string::npos);
    CHECK(result.track.rows.size() == 300);
  }
}

TEST_CASE("Turns, hovering, pedal turns and rough air are flown without a word", "[track_check]") {
  for (const double step_s : {0.05, 1.0, 5.0}) {
    INFO(step_s << " s");
    // 60 deg of bank at 60 m/s: 17 m/s2, a circle of 212 m.
    RawTrack turning = approach(400, step_s, true);
    RawTrack hovering = turning;
    for (TrackRow& row : turning.rows) {
      const double angle_rad = 17.0 / 60.0 * row.time_s;
      row.position = terrain::geodesic_point({radians(47.25), radians(11.1), 800.0}, angle_rad,
                                             60.0 * 60.0 / 17.0);
      row.heading_rad = core::wrap_pi_rad(angle_rad + radians(90.0));
      row.roll_rad = radians(60.0);
    }
    CHECK(errors(checked(turning).problems).empty());
    // In place within half a metre, turning by 60 deg/s.
    for (TrackRow& row : hovering.rows) {
      row.position = terrain::geodesic_point({radians(47.25), radians(11.1), 800.0},
                                             radians(137.0) * row.row, 0.5);
      row.heading_rad = core::wrap_pi_rad(radians(60.0) * row.time_s);
    }
    CHECK(errors(checked(hovering).problems).empty());
  }
  // Rolling by 20 deg and heaving by 0.5 g, twice a second, seen 20 times a second.
  RawTrack rough = approach(400, 0.05, true);
  for (TrackRow& row : rough.rows) {
    const double phase_rad = 4.0 * core::kPi * row.time_s;
    row.roll_rad = radians(20.0) * std::sin(phase_rad);
    row.position.height_m += 0.5 * 9.81 / (16.0 * core::kPi * core::kPi) * std::sin(phase_rad);
  }
  CHECK(errors(checked(rough).problems).empty());
}

TEST_CASE("Real flights pass: an airliner, calibration aircraft, a simulator", "[track_check]") {
  const auto real = [](const std::string& file, TrajectoryColumns columns) {
    const auto path = tests::shared_data(file);
    core::ProblemList problems;
    if (!path) return problems;
    RawTrack track = read_track_csv(*path, columns, problems);
    check_track(track, columns, {}, problems);
    return problems;
  };
  TrajectoryColumns transponder;
  transponder.time.name = "time_unix_s";
  transponder.latitude.name = "lat_deg";
  transponder.longitude.name = "lon_deg";
  transponder.height.name = "alt_geom_ft";
  CHECK(real("trajectories/kden_rwy26_dal1812.csv", transponder).all().empty());
  transponder.height.name = "alt_baro_ft";
  for (const char* airport : {"eddm_ils", "lfmn_ils", "lfkj", "lpma"})
    CHECK_FALSE(real("trajectories/" + std::string(airport) + "_calibration.csv", transponder)
                    .has_errors());
  TrajectoryColumns simulator;
  simulator.time.name = "sim_time_s";
  simulator.latitude.name = "lat_deg";
  simulator.longitude.name = "lon_deg";
  simulator.height.name = "alt_ft";
  simulator.heading.name = "heading_true_deg";
  CHECK(real("flightgear/bikf10.csv", simulator).all().empty());
}

TEST_CASE("Real flight: a helicopter whose position stands for up to 37 s", "[track_check]") {
  const auto path = tests::shared_data("trajectories/rega_helicopter_st_gallen.csv");
  if (!path) return;
  TrajectoryColumns columns;
  columns.time.name = "time_unix_s";
  columns.latitude.name = "lat_deg";
  columns.longitude.name = "lon_deg";
  columns.height.name = "alt_baro_ft";
  core::ProblemList problems;
  RawTrack track = read_track_csv(*path, columns, problems);
  check_track(track, columns, {}, problems);
  std::vector<int> lines;
  for (const core::Problem& problem : problems.all())
    if (problem.is_error()) lines.push_back(problem.place.line);
  CHECK(lines == std::vector<int>{24, 69, 83});
}

}  // namespace fanbeam::scenes
