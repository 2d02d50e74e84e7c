// The ground under runways: one strip, and strips that overlap.
#include "terrain/runway.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/common.hpp>
#include <vector>

namespace fanbeam::terrain {
namespace {

// 3 km between two places, level.
Runway level_runway(glm::dvec2 from_m, glm::dvec2 to_m, double elevation_m) {
  Runway runway;
  runway.ends[0] = {from_m, 0.0, elevation_m};
  runway.ends[1] = {to_m, 0.0, elevation_m};
  return runway;
}

const Runway kNorth = level_runway({0.0, -1500.0}, {0.0, 1500.0}, 100.0);
const Runway kEast = level_runway({-1500.0, 0.0}, {1500.0, 0.0}, 110.0);
constexpr double kNatural_m = 130.0;

Approx near_to(double value_m) { return Approx(value_m).epsilon(0.0).margin(1e-9); }

double height_m(const std::vector<Runway>& runways, double x_m, double y_m) {
  return flattened_height_m(runways, {x_m, y_m}, kNatural_m);
}

TEST_CASE("One runway's strip is its line, then a smooth blend to the natural ground", "[runway]") {
  CHECK(height_m({}, 0.0, 0.0) == kNatural_m);
  CHECK(height_m({kNorth}, 74.0, 900.0) == near_to(100.0));
  CHECK(height_m({kNorth}, 0.0, 1560.0) == near_to(100.0));
  CHECK(height_m({kNorth}, 175.0, 900.0) == kNatural_m);
  // u^2 (3 - 2 u) at 25 m and 50 m of 100 m.
  CHECK(height_m({kNorth}, 100.0, 900.0) == near_to(100.0 * (1.0 - 0.15625) + 130.0 * 0.15625));
  CHECK(height_m({kNorth}, -125.0, 900.0) == near_to(115.0));
}

TEST_CASE("Where strips of two runways cross, the ground depends on no order and has no step",
          "[runway]") {
  for (double x_m = -301.0; x_m <= 301.0; x_m += 7.0)
    for (double y_m = -301.0; y_m <= 301.0; y_m += 7.0)
      if (std::abs(height_m({kNorth, kEast}, x_m, y_m) - height_m({kEast, kNorth}, x_m, y_m)) >
          1e-9)
        FAIL_CHECK("at " << x_m << ", " << y_m);
  for (const std::vector<Runway>& both :
       {std::vector<Runway>{kNorth, kEast}, std::vector<Runway>{kEast, kNorth}}) {
    // In one strip alone its own line counts, in the other's blend too.
    CHECK(height_m(both, 0.0, 900.0) == near_to(100.0));
    CHECK(height_m(both, 20.0, 76.0) == near_to(100.0));
    CHECK(height_m(both, -90.0, 10.0) == near_to(110.0));
    // In both by the distances to their borders: 75 m and 75 m, 75 m and 15 m.
    CHECK(height_m(both, 0.0, 0.0) == near_to(105.0));
    CHECK(height_m(both, 0.0, 60.0) == near_to((75.0 * 100.0 + 15.0 * 110.0) / 90.0));
    // 10 m over the 75 m from border to middle, at most 10/75 in a metre.
    double steepest = 0.0;
    for (int y_m = -200; y_m < 200; ++y_m)
      steepest =
          std::max(steepest, std::abs(height_m(both, 0.0, y_m + 1.0) - height_m(both, 0.0, y_m)));
    CHECK(steepest < 10.0 / 75.0 + 1e-9);
    CHECK(steepest > 0.05);
    // Between both, where the blends meet, and beyond them.
    CHECK(height_m(both, 100.0, 100.0) > 100.0);
    CHECK(height_m(both, 100.0, 100.0) < kNatural_m);
    CHECK(height_m(both, 300.0, 300.0) == kNatural_m);
  }
}

TEST_CASE("Pavements of parallel runways keep their own lines in each other's strips", "[runway]") {
  const Runway beside = level_runway({80.0, -1500.0}, {80.0, 1500.0}, 103.0);
  for (const std::vector<Runway>& both :
       {std::vector<Runway>{kNorth, beside}, std::vector<Runway>{beside, kNorth}}) {
    // 22.5 m of pavement and 7.5 m of shoulder on each side.
    for (const double x_m : {-30.0, 0.0, 20.0, 30.0}) {
      CHECK(height_m(both, x_m, 900.0) == near_to(100.0));
      CHECK(height_m(both, 80.0 + x_m, 900.0) == near_to(103.0));
    }
    CHECK(height_m(both, 40.0, 900.0) == near_to(101.5));
    // No step: 3 m over the 20 m between.
    double before_m = 100.0;
    for (double x_m = 5.0; x_m <= 75.0; x_m += 0.5) {
      const double here_m = height_m(both, x_m, 900.0);
      CHECK(here_m >= before_m - 1e-9);
      CHECK(here_m - before_m < 0.2);
      before_m = here_m;
    }
  }
  // A third that crosses both is their mean with each.
  const std::vector<Runway> three{kNorth, beside, kEast};
  CHECK(height_m(three, 0.0, 0.0) == near_to(105.0));
}

TEST_CASE("The largest step is that of two lines in a place of both strips", "[runway]") {
  CHECK(largest_step_m(kNorth, kEast) == near_to(10.0));
  CHECK(largest_step_m(kEast, kNorth) == near_to(10.0));
  const auto parallel = [](double x_m) {
    return level_runway({x_m, -1500.0}, {x_m, 1500.0}, 103.0);
  };
  CHECK(largest_step_m(kNorth, parallel(140.0)) == near_to(3.0));
  CHECK(largest_step_m(kNorth, parallel(160.0)) == 0.0);
  // A strip far narrower than the steps along the other one.
  Runway narrow = kEast;
  narrow.strip_half_width_m = 1.0;
  CHECK(largest_step_m(kNorth, narrow) == near_to(10.0));
}

// Where rectangles of a length begin behind the threshold of the south end, and how far they reach aside.
struct Marks {
  std::vector<double> from_m;  // of pairs: those on one side
  double farthest_aside_m = 0.0;
};

Marks marks_of(double runway_m, double width_m, double length_m) {
  Runway runway = level_runway({0.0, 0.0}, {0.0, runway_m}, 100.0);
  runway.width_m = width_m;
  runway.shoulder_m = 0.0;
  Marks marks;
  const std::vector<SurfacePatch> patches = runway_patches(runway);
  for (std::size_t i = 1; i < patches.size(); ++i) {  // behind the pavement
    glm::dvec2 low(1e9), high(-1e9);
    for (const glm::dvec2& corner : patches[i].outline_m) {
      low = glm::min(low, corner);
      high = glm::max(high, corner);
      marks.farthest_aside_m = std::max(marks.farthest_aside_m, std::abs(corner.x));
    }
    const bool of_south_end = low.y < runway_m / 2 && low.x > 0.5;
    if (of_south_end && std::abs(high.y - low.y - length_m) < 1e-6)
      marks.from_m.push_back(std::round(low.y));
  }
  return marks;
}

// ICAO Annex 14 Vol. I, 5.2.6.3 (number of pairs) and 5.2.6.5 (150 m apart, none within 50 m of the aiming
// point).
TEST_CASE("Touchdown zones have the pairs of the landing length, none beside the aiming point",
          "[runway]") {
  using Places = std::vector<double>;
  CHECK(marks_of(3000.0, 45.0, 22.5).from_m == Places{150, 300, 600, 750, 900});
  CHECK(marks_of(3000.0, 45.0, 45.0).from_m == Places{400});
  CHECK(marks_of(2000.0, 45.0, 22.5).from_m == Places{150, 450, 600});
  CHECK(marks_of(2000.0, 45.0, 45.0).from_m == Places{300});
  CHECK(marks_of(1300.0, 45.0, 22.5).from_m == Places{150, 450});
  CHECK(marks_of(1000.0, 45.0, 22.5).from_m == Places{150});
  CHECK(marks_of(850.0, 45.0, 22.5).from_m == Places{150});
}

TEST_CASE("Markings of narrow runways stay on the pavement", "[runway]") {
  for (const double width_m : {5.0, 10.0, 18.0, 23.0, 26.0, 30.0, 45.0, 60.0, 200.0}) {
    INFO(width_m);
    CHECK(marks_of(3000.0, width_m, 30.0).farthest_aside_m ==
          near_to(width_m / 2));  // side stripes
  }
  // From 0.9 m of the centre line a stripe of 1.8 m every 3.6 m, while there is room.
  CHECK(marks_of(3000.0, 5.0, 30.0).from_m.empty());
  CHECK(marks_of(3000.0, 10.0, 30.0).from_m.size() == 1);
  CHECK(marks_of(3000.0, 18.0, 30.0).from_m.size() == 2);
  CHECK(marks_of(3000.0, 23.0, 30.0).from_m.size() == 3);
  // Aiming points reach 14.5 m aside, touchdown zones 12 m.
  CHECK(marks_of(3000.0, 28.0, 45.0).from_m.empty());
  CHECK(marks_of(3000.0, 30.0, 45.0).from_m.size() == 1);
  CHECK(marks_of(3000.0, 23.0, 22.5).from_m.empty());
  CHECK(marks_of(3000.0, 24.0, 22.5).from_m.size() == 5);
}

}  // namespace
}  // namespace fanbeam::terrain
