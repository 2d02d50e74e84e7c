// The baseline that ghosts and merged beats make of one triangle, and what removes them.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/random.h"
#include "tests/tracking/highway_scenes.h"
#include "tests/tracking/simulated.h"

using namespace fanbeam;
using namespace fanbeam::tracking;
using namespace fanbeam::tests;

namespace {

struct Rates {
  double missed = 0.0, ghosts_per_frame = 0.0;
};

// Six cars straight ahead, range uniform in 10 to 200 m, speed within 60 m/s; a match within 1 m and
// 1 m/s.
Rates rates_of(Scheme scheme) {
  constexpr int kFrames = 1000, kCars = 6;
  SimulationSettings settings;
  settings.scheme = scheme;
  Rates rates;
  for (int frame = 0; frame < kFrames; ++frame) {
    std::vector<core::HighwayTarget> cars;
    for (int i = 0; i < kCars; ++i) {
      const auto words = core::random_words(run_key(frame, 1012), static_cast<std::uint64_t>(i), 0);
      cars.push_back(car("", 10.0 + 190.0 * core::uniform_from(words[0]), 0.0,
                         120.0 * core::uniform_from(words[1]) - 60.0));
    }
    const auto seen = simulated_frame(scene(0.0, 0.0, cars), highway_radar(), settings, 5,
                                      static_cast<std::uint32_t>(frame), 0);
    const auto match = [](const RadarMeasurement& one, const core::HighwayTarget& target) {
      return std::abs(one.range_m - target.position_m[0]) <= 1.0 &&
             std::abs(one.range_rate_mps - target.velocity_mps[0]) <= 1.0;
    };
    for (const auto& target : cars)
      rates.missed += std::none_of(seen.begin(), seen.end(),
                                   [&](const auto& one) { return match(one, target); });
    for (const auto& one : seen)
      rates.ghosts_per_frame += std::none_of(
          cars.begin(), cars.end(), [&](const auto& target) { return match(one, target); });
  }
  return {rates.missed / (kFrames * kCars), rates.ghosts_per_frame / kFrames};
}

}  // namespace

TEST_CASE("Six targets: a sorted triangle misses two in three, two stages one in two hundred",
          "[highway][statistics]") {
  const Rates sorted = rates_of(Scheme::sorted_triangle), all = rates_of(Scheme::triangle);
  const Rates slopes = rates_of(Scheme::two_slopes), stages = rates_of(Scheme::two_stage);
  INFO("sorted " << sorted.missed << ", " << sorted.ghosts_per_frame << "; all " << all.missed
                 << ", " << all.ghosts_per_frame << "; two slopes " << slopes.missed << ", "
                 << slopes.ghosts_per_frame << "; two stages " << stages.missed << ", "
                 << stages.ghosts_per_frame);
  // Published 0.660 and 3.79, 18.8; frames of six dependent targets: 4 standard deviations.
  CHECK(sorted.missed == Approx(0.660).epsilon(0.0).margin(0.035));
  CHECK(sorted.ghosts_per_frame == Approx(3.79).epsilon(0.1));
  CHECK(all.missed <= 0.001);
  CHECK(all.ghosts_per_frame == Approx(18.8).epsilon(0.1));
  CHECK(slopes.missed <= 0.03);
  CHECK(stages.missed <= 0.005);
  CHECK(stages.ghosts_per_frame <= 0.02);
}

TEST_CASE(
    "A coded stretch keeps targets of different speeds, and of one speed by the triangle's beats",
    "[highway]") {
  SimulationSettings settings;
  settings.scheme = Scheme::coded;
  const auto seen = [&](double other_mps) {
    const auto two = scene(0.0, 0.0, {car("A", 40.0, 0.0, -10.0), car("B", 90.0, 0.0, other_mps)});
    return simulated_frame(two, highway_radar(), settings, 6, 0, 0);
  };
  const auto apart = seen(5.0);
  REQUIRE(apart.size() == 2);
  CHECK(apart[0].range_m == Approx(40.0).epsilon(0.0).margin(0.01));
  CHECK(apart[1].range_m == Approx(90.0).epsilon(0.0).margin(0.01));
  // In one cell of speed, where the stretch tells a range between them: neither that nor crossed pairs.
  const auto together = seen(-10.2);
  REQUIRE(together.size() == 2);
  CHECK(together[0].range_m + together[1].range_m == Approx(130.0).epsilon(0.0).margin(0.02));
  CHECK(std::abs(together[0].range_m - together[1].range_m) ==
        Approx(50.0).epsilon(0.0).margin(0.02));
}
