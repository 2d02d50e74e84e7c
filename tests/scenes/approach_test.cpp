// What fanbeam doctor tells of an approach, against paths whose figures are known.
#include "scenes/doctor/approach.h"

#include <cmath>

#include "core/units.h"
#include "tests/scenes/problem_checks.h"

namespace fanbeam::tests {
namespace {

// Metres of a degree on WGS 84 at 52 deg.
constexpr double kLatitude_m = 111267.0;
constexpr double kLongitude_m = 68678.0;

std::string flight_file(double right_m, double glide_deg, double end_m) {
  std::string rows = "time_s,latitude_deg,longitude_deg,height_m,roll_deg,pitch_deg,heading_deg\n";
  for (double t = 0.0; 2400.0 - 50.0 * t >= end_m; t += 1.0) {
    const double before_m = 2400.0 - 50.0 * t;
    rows += core::number_text(t) + "," + core::number_text(52.0 - before_m / kLatitude_m) + "," +
            core::number_text(10.0 + right_m / kLongitude_m) + "," +
            core::number_text(70.0 + before_m * std::tan(core::radians(glide_deg))) + ",0,0,0\n";
  }
  return rows;
}

}  // namespace

TEST_CASE("An instrument approach crosses the threshold as its keys say", "[approach]") {
  const TemporaryFolder folder;
  const std::unique_ptr<scenes::Scene> scene =
      good_scene(folder, replaced(kSmallScene, "start_distance_m = 1500.0",
                                  "start_distance_m = 2000.0\nglide_path_deg = 3.5\n"
                                  "threshold_crossing_height_m = 16.0"));
  const auto approach = scenes::approach_of(*scene);
  REQUIRE(approach);
  CHECK(approach->runway == "36");
  CHECK(approach->passes_threshold);
  CHECK(approach->height_m == Approx(16.0).epsilon(0.0).margin(0.1));
  CHECK(approach->right_m == Approx(0.0).epsilon(0.0).margin(0.1));
  CHECK(core::degrees(approach->glide_path_rad) == Approx(3.5).epsilon(0.0).margin(0.01));
  CHECK(approach->fitted_from_m == Approx(2000.0).epsilon(0.0).margin(5.0));
}

TEST_CASE("A recorded approach that ends early is told where it ends", "[approach]") {
  const TemporaryFolder folder;
  folder.write("flight.csv", flight_file(40.0, 4.0, 600.0));
  const std::unique_ptr<scenes::Scene> scene =
      good_scene(folder, file_trajectory("vertical_datum = \"scene\"\n"));
  const auto approach = scenes::approach_of(*scene);
  REQUIRE(approach);
  CHECK(approach->runway == "36");
  CHECK_FALSE(approach->passes_threshold);
  CHECK(approach->before_threshold_m == Approx(600.0).epsilon(0.0).margin(1.0));
  // The threshold lies at 50 m.
  CHECK(approach->height_m ==
        Approx(20.0 + 600.0 * std::tan(core::radians(4.0))).epsilon(0.0).margin(0.1));
  CHECK(approach->right_m == Approx(40.0).epsilon(0.0).margin(0.2));
  CHECK(core::degrees(approach->glide_path_rad) == Approx(4.0).epsilon(0.0).margin(0.03));
}

TEST_CASE("Standing and climbing out are no approach", "[approach]") {
  const TemporaryFolder folder;
  folder.write("flight.csv", flight_file(0.0, -3.0, 100.0));
  // Climbing towards the threshold: higher the nearer.
  const std::unique_ptr<scenes::Scene> climbing =
      good_scene(folder, file_trajectory("vertical_datum = \"scene\"\nheight_offset_m = 200.0\n"));
  CHECK_FALSE(scenes::approach_of(*climbing));
  const std::unique_ptr<scenes::Scene> standing = good_scene(
      folder, replaced(kSmallScene, kIls,
                       "[trajectory.fixed]\nat = { latitude_deg = 51.99, longitude_deg = 10.0 }\n"
                       "above_ground_m = 60.0\n"));
  CHECK_FALSE(scenes::approach_of(*standing));
}

}  // namespace fanbeam::tests
