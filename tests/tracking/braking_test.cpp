// Targets that brake, and the acceleration that the tracker of a road is told to expect.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "tests/tracking/highway_scenes.h"
#include "tracking/metrics/error_statistics.h"

using namespace fanbeam;
using namespace fanbeam::tracking;
using namespace fanbeam::tests;

// With the default, for steady traffic, the car leaves its track within half a second of touching
// the brake, and starts another one every third of a second.
TEST_CASE("A car that brakes as hard as expected stays one track", "[tracker]") {
  for (const double braking_mps2 : {4.0, 8.0}) {
    core::HighwayTarget target = car("A", 120.0, 3.5, 30.0, 12.6);
    target.accelerations = {{0.8, 2.4, {-braking_mps2, 0.0}}};
    const core::HighwayScenario scenario = scene(3.0, kRoadSpeed_mps, {target});
    double furthest_m = 0.0;
    for (int run = 0; run < 20; ++run) {
      ScenarioScore score;
      std::set<int> ids;
      track_scene(scenario, {}, road_tracker(highway_radar(), kRoadSpeed_mps, braking_mps2), run,
                  [&](const Frame& frame) {
                    score.add(scenario, frame);
                    for (const Track& track : frame.tracker->tracks()) {
                      if (!track.confirmed) continue;
                      ids.insert(track.id);
                      const double error_m = polar(track.state).range_m - frame.truth[0].range_m;
                      furthest_m = std::max(furthest_m, std::abs(error_m));
                    }
                  });
      CHECK(ids.size() == 1);
      CHECK(score.mot.switches() == 0);
      CHECK(score.mot.mota() >= 0.98);
    }
    INFO("braking at " << braking_mps2 << " m/s2");
    CHECK(furthest_m < 0.1);
  }
}
