// What a run sets on its scene: where traffic stands, and what it may be called.
#include "datasets/run_conditions.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <iomanip>
#include <memory>
#include <sstream>
#include <string>

#include "core/constants.h"
#include "core/errors.h"
#include "tests/terrain/ascii_grid.h"

using namespace fanbeam;

namespace {

constexpr double kNorth_m_per_deg = 111264.0, kEast_m_per_deg = 68678.0;  // at 52 degrees north

// A runway of 1500 m to the north, whose end 36 is the origin, and one to the east that begins 60 m beside it,
// 1290 m behind that.
std::string field_with(const std::string& more) {
  return R"([scene]
name = "field"
title = "Two runways"
origin = { latitude_deg = 52.0, longitude_deg = 10.0, height_m = 50.0 }
vertical_datum = "scene"

[terrain]
generator = "plane"
material = "short_grass"
west_m = 1800.0
east_m = 1800.0
south_m = 4000.0
north_m = 4600.0
spacing_m = 50.0

[[runway]]
first = { name = "36", latitude_deg = 52.0, longitude_deg = 10.0, elevation_m = 50.0 }
second = { name = "18", latitude_deg = 52.0134815, longitude_deg = 10.0, elevation_m = 50.0 }
width_m = 30.0
surface = "concrete"

[[runway]]
first = { name = "09", latitude_deg = 52.011594, longitude_deg = 10.000874, elevation_m = 50.0 }
second = { name = "27", latitude_deg = 52.011594, longitude_deg = 10.020385, elevation_m = 50.0 }
width_m = 30.0
surface = "concrete"
)" + more;
}

std::string approach(const std::string& end) {
  return "[trajectory.ils]\nrunway = \"36\"\nstart_distance_m = 3000.0\nspeed_mps = 60.0\nend = "
         "\"" +
         end + "\"\n";
}

// Of one run, with traffic as told.
class Field {
 public:
  Field(const std::string& more, const std::string& traffic, const std::string& flight = "") {
    folder_.write("flight.csv", flight);
    folder_.write("scene.toml", field_with(more));
    core::ProblemList problems;
    campaign_ = datasets::read_campaign(
        folder_.write("campaign.toml", "[campaign]\nname = \"x\"\nscenes = [\".\"]\n" + traffic),
        problems);
    session_ = std::make_unique<session::Session>(
        folder_.path(), session::Setup{.shipped = FANBEAM_SOURCE_DIR}, problems);
    problems.throw_if_errors();
  }
  void set() {
    datasets::set_conditions(*session_, campaign_, datasets::Drawer(campaign_).draw(0),
                             *session_->opened());
  }
  // Set, the van is so far to the east and north.
  void check_van_at(double east_m, double north_m) {
    set();
    for (const renderer::PointTarget& target : session_->scene()->world.targets) {
      if (target.name != "van") continue;
      const glm::dvec3 at_m = target.path.front().position_m;
      CHECK(at_m.x ==
            Approx(east_m).margin(0.5).epsilon(0.0));  // places are given to a tenth of a metre
      CHECK(at_m.y == Approx(north_m).margin(0.5).epsilon(0.0));
      return;
    }
    FAIL("no van");
  }

 private:
  tests::TemporaryFolder folder_;
  datasets::Campaign campaign_;
  std::unique_ptr<session::Session> session_;
};

constexpr const char* kVan = "[[traffic]]\nname = \"van\"\nalong_m = 300\nacross_m = 20\n";

// Downwind to the south, a half circle to the left, and the last 1.8 km to the north.
std::string circuit() {
  std::ostringstream rows;
  rows << std::setprecision(12) << "time_s,latitude_deg,longitude_deg,height_m\n";
  constexpr double kSpeed_mps = 60.0, kRadius_m = 750.0, kDownwind_m = 6000.0;
  constexpr double kTurn_m = core::kPi * kRadius_m, kWhole_m = kDownwind_m + kTurn_m + 1800.0;
  for (int second = 0; second * kSpeed_mps < kWhole_m; ++second) {
    const double flown_m = second * kSpeed_mps, turned_m = flown_m - kDownwind_m;
    const double angle_rad = turned_m / kRadius_m;
    double east_m = -2 * kRadius_m, north_m = -2000.0 - turned_m;
    if (turned_m > kTurn_m) {
      east_m = 0.0;
      north_m = -2000.0 + turned_m - kTurn_m;
    } else if (turned_m > 0.0) {
      east_m = -kRadius_m * (1.0 + std::cos(angle_rad));
      north_m = -2000.0 - kRadius_m * std::sin(angle_rad);
    }
    rows << second << ',' << 52.0 + north_m / kNorth_m_per_deg << ','
         << 10.0 + east_m / kEast_m_per_deg << ",150\n";
  }
  return rows.str();
}

}  // namespace

// The flight that rolls out ends 1.3 km behind its threshold: 200 m from the other end, 60 m from another runway.
TEST_CASE("Traffic stands behind the threshold of the landing, wherever the flight ends",
          "[run_conditions]") {
  for (const char* end : {"decision_height", "touchdown", "full_stop"}) {
    INFO(end);
    Field(approach(end), kVan).check_van_at(20.0, 300.0);
  }
}

// From its first position to its last, this one flies against its landing.
TEST_CASE("A circuit lands where its last kilometre leads", "[run_conditions]") {
  Field("[trajectory]\nfile = \"flight.csv\"\nvertical_datum = \"scene\"\n", kVan, circuit())
      .check_van_at(20.0, 300.0);
}

TEST_CASE("Traffic of a scene that is looked at from one place stands at the nearest threshold",
          "[run_conditions]") {
  const std::string at = "at = { latitude_deg = 52.03, longitude_deg = 10.0 }\n";
  Field("[trajectory.fixed]\n" + at + "above_ground_m = 100.0\nheading_deg = 180.0\n", kVan)
      .check_van_at(-20.0, 1200.0);
}

// It moved that target, in the runs with traffic alone.
TEST_CASE("Traffic of the name of a scene's own target is refused with all else that is wrong",
          "[run_conditions]") {
  const std::string targets =
      "[[target]]\nname = \"truck\"\nat = { runway = \"36\", behind_threshold_m = 900.0 }\n"
      "rcs = { shape = \"constant\", rcs_dBsm = 10.0 }\n"
      "[[target]]\nname = \"van\"\nat = { runway = \"36\", behind_threshold_m = 800.0 }\n"
      "rcs = { shape = \"constant\", rcs_dBsm = 10.0 }\n";
  Field field(targets + approach("touchdown"),
              "[parameters]\nweather.visibility_m = 200\nweather.temperature_C = -50\n"
              "[[traffic]]\nname = \"truck\"\n[[traffic]]\nname = \"car\"\n"
              "[[traffic]]\nname = \"van\"\npresent = 0\n");
  CHECK_THROWS_WITH(field.set(), Catch::Contains("E-REF traffic.name = \"truck\"") &&
                                     Catch::Contains("E-REF traffic.name = \"van\"") &&
                                     Catch::Contains("the targets of field") &&
                                     Catch::Contains("E-RANGE temperature_C") &&
                                     !Catch::Contains("\"car\""));
}
