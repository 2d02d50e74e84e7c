// Motion laws of the scenarios, and measurements that are as good and as bad as those of a radar.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <tuple>

#include "core/decibel.h"
#include "core/errors.h"
#include "tests/tracking/highway_scenes.h"
#include "tracking/metrics/error_statistics.h"

using namespace fanbeam;
using namespace fanbeam::tracking;
using namespace fanbeam::tests;

namespace {

struct Row {
  int target;
  double time_s, range_m, rate_mps, azimuth_rad;
  bool in_view;
};

void check_rows(const core::HighwayScenario& scenario, const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    INFO("target " << row.target << " at " << row.time_s << " s");
    const core::HighwayTruth truth =
        truth_at(scenario.targets[static_cast<std::size_t>(row.target)], scenario.radar_speed_mps,
                 highway_radar(), row.time_s);
    CHECK(truth.range_m == Approx(row.range_m).epsilon(0.0).margin(1e-6));
    CHECK(truth.range_rate_mps == Approx(row.rate_mps).epsilon(0.0).margin(1e-6));
    CHECK(truth.azimuth_rad == Approx(row.azimuth_rad).epsilon(0.0).margin(1e-6));
    CHECK(truth.in_view == row.in_view);
  }
}

bool matches(const RadarMeasurement& seen, const core::HighwayTruth& truth) {
  return std::abs(seen.range_m - truth.range_m) <= 1.0 &&
         std::abs(seen.range_rate_mps - truth.range_rate_mps) <= 1.0;
}

}  // namespace

TEST_CASE("Scenarios move as their truth tables say, azimuth to the right", "[highway]") {
  // Rows of the scenario file; its azimuths count to the left.
  check_rows(one_stopped_car(), {{0, 0.5, 136.111111, -27.777778, 0.0, true},
                                 {0, 3.0, 66.666667, -27.777778, 0.0, true}});
  check_rows(six_vehicles(), {{1, 0.0, 62.110305, -5.268405, 0.05960673, true},
                              {1, 6.0, 30.558159, -5.238947, 0.12137841, true},
                              {2, 3.0, 73.759527, 5.215648, -0.05018407, true},
                              {4, 3.0, 20.024679, -48.088808, -0.58754092, true},
                              {4, 3.5, 16.510382, 42.771441, -2.40427556, false}});
  check_rows(slow_crossing(), {{1, 0.0, 60.113975, 0.415877, -0.06158868, true}});
  check_rows(beaming(), {{0, 0.0, 50.0, 0.0, 0.69, true},
                         {1, 0.0, 98.520302, -14.590901, 0.62319933, true},
                         {2, 0.0, 50.0, 0.0, -0.17, true}});
}

TEST_CASE("Accelerations and lane changes are the integrals of each other", "[highway]") {
  core::HighwayTarget target = car("A", 10.0, 0.0, 20.0);
  target.accelerations = {{1.0, 3.0, {2.0, 0.0}}, {2.5, 4.0, {-1.0, 0.5}}};
  target.lane_changes = {{2.0, 5.0, -3.5}};
  // After the first segment: 20 + 4 m/s; after all, both axes.
  const core::RelativeMotion end = relative_motion(target, 5.0, 10.0);
  CHECK(end.velocity_mps[0] == Approx(20.0 + 4.0 - 1.5 - 5.0));
  CHECK(end.velocity_mps[1] == Approx(0.75));
  CHECK(end.position_m[1] == Approx(0.5 * 0.5 * 1.5 * 1.5 + 0.75 * 6.0 - 3.5));
  for (double t_s = 0.05; t_s < 7.0; t_s += 0.1) {
    const auto before = relative_motion(target, 5.0, t_s - 1e-4);
    const auto after = relative_motion(target, 5.0, t_s + 1e-4);
    const auto now = relative_motion(target, 5.0, t_s);
    for (std::size_t axis = 0; axis < 2; ++axis)
      CHECK((after.position_m[axis] - before.position_m[axis]) / 2e-4 ==
            Approx(now.velocity_mps[axis]).epsilon(0.0).margin(1e-3));
  }
  CHECK_FALSE(truth_at(car("B", 0.0, 0.0, 0.0), 0.0, highway_radar(), 0.0).in_view);
}

TEST_CASE("Signal-to-noise ratios and bounds are those of the link budget", "[highway]") {
  // dB at the start of the scenarios; the bounds at 56.45 dB are published with the formulas.
  CHECK(core::dB_from_power(measurement_bound(highway_radar(), 10.0, 150.0, 0.0).signal_to_noise,
                            -300.0) == Approx(49.406).epsilon(0.0).margin(1e-3));
  CHECK(core::dB_from_power(measurement_bound(highway_radar(), 1.5, 58.117897, 0.0).signal_to_noise,
                            -300.0) == Approx(57.638).epsilon(0.0).margin(1e-3));
  const MeasurementBound bound = measurement_bound(highway_radar(), 10.0, 100.0, 0.0);
  CHECK(bound.range_sigma_m == Approx(0.2487e-3).epsilon(1e-3));
  CHECK(bound.range_rate_sigma_mps == Approx(0.4091e-3).epsilon(1e-3));
}

TEST_CASE("A lone car is measured as well as the bound allows", "[highway][statistics]") {
  for (const Scheme scheme : {Scheme::triangle, Scheme::two_slopes, Scheme::two_stage}) {
    SimulationSettings settings;
    settings.scheme = scheme;
    MeanSquare range, rate;
    for (std::uint32_t run = 0; run < 200; ++run)
      for (int frame = 0; frame <= 60; frame += 10) {
        const auto scenario = one_stopped_car();
        const auto truth =
            truth_at(scenario.targets[0], scenario.radar_speed_mps, highway_radar(), frame * 0.05);
        const auto seen = simulated_frame(scenario, highway_radar(), settings, 1, run, frame);
        REQUIRE(seen.size() == 1);
        range.add((seen[0].range_m - truth.range_m) / seen[0].range_sigma_m);
        rate.add((seen[0].range_rate_mps - truth.range_rate_mps) / seen[0].range_rate_sigma_mps);
      }
    // 1400 normal values: 1.9 % in the root mean square.
    CHECK(range.rms() == Approx(1.0).epsilon(0.0).margin(0.06));
    CHECK(rate.rms() == Approx(1.0).epsilon(0.0).margin(0.06));
    CHECK(range.rms() <= 1.15);
    CHECK(rate.rms() <= 1.15);
  }
}

// Noise of 60 dB made measurements with the errors of a bound that does not hold, and tracks of them.
TEST_CASE("A car below 15 dB is not seen, and comes into sight where it reaches them",
          "[highway]") {
  const auto scenario = one_stopped_car();
  core::HighwayRadar radar = highway_radar();
  radar.noise_figure *= std::pow(10.0, 3.6);  // 49.4 dB at 150 m become 13.4, and 15.1 at 136.1 m
  for (const Scheme scheme :
       {Scheme::triangle, Scheme::two_slopes, Scheme::two_stage, Scheme::coded}) {
    SimulationSettings settings;
    settings.scheme = scheme;
    for (const int frame : {0, 5, 9, 10, 20}) {
      INFO("scheme " << static_cast<int>(scheme) << ", frame " << frame);
      CHECK(simulated_frame(scenario, radar, settings, 1, 0, frame).size() ==
            (frame < 10 ? 0U : 1U));
    }
  }
}

TEST_CASE("Six vehicles: one triangle makes ghosts, two slopes and two stages keep the targets",
          "[highway][statistics]") {
  const auto scenario = six_vehicles();
  const auto rates = [&](Scheme scheme) {
    SimulationSettings settings;
    settings.scheme = scheme;
    int instances = 0, missed = 0, ghosts = 0, frames = 0;
    for (std::uint32_t run = 0; run < 20; ++run)
      for (int frame = 0; frame <= 120; ++frame, ++frames) {
        std::vector<core::HighwayTruth> truth;
        for (const auto& target : scenario.targets) {
          truth.push_back(
              truth_at(target, scenario.radar_speed_mps, highway_radar(), frame * 0.05));
          if (!truth.back().in_view) truth.pop_back();
        }
        const auto seen = simulated_frame(scenario, highway_radar(), settings, 2, run, frame);
        instances += static_cast<int>(truth.size());
        for (const auto& one : truth)
          missed += std::none_of(seen.begin(), seen.end(),
                                 [&](const auto& s) { return matches(s, one); });
        for (const auto& s : seen)
          ghosts += std::none_of(truth.begin(), truth.end(),
                                 [&](const auto& one) { return matches(s, one); });
      }
    return std::pair(static_cast<double>(missed) / instances, static_cast<double>(ghosts) / frames);
  };
  CHECK(rates(Scheme::triangle).second > 5.0);
  const auto slopes = rates(Scheme::two_slopes), stages = rates(Scheme::two_stage);
  INFO("two slopes " << slopes.first << ", " << slopes.second << "; two stages " << stages.first
                     << ", " << stages.second);
  CHECK(slopes.first <= 0.03);
  CHECK(stages.first <= 0.01);
  CHECK(stages.second <= 0.02);
}

TEST_CASE("Missed and false measurements come at their rates, the same in every run",
          "[highway][statistics]") {
  SimulationSettings settings;
  settings.detection_probability = 0.8;
  settings.false_per_frame = 2.5;
  int real = 0, all = 0;
  constexpr int kFrames = 4000;
  for (int frame = 0; frame < kFrames; ++frame) {
    const auto seen = simulated_frame(one_stopped_car(), highway_radar(), settings, 3,
                                      static_cast<std::uint32_t>(frame / 50), frame % 50);
    all += static_cast<int>(seen.size());
    const auto truth = truth_at(one_stopped_car().targets[0], kRoadSpeed_mps, highway_radar(),
                                0.05 * (frame % 50));
    real += std::any_of(seen.begin(), seen.end(), [&](const auto& s) { return matches(s, truth); });
    if (frame == 7) {
      const auto again = simulated_frame(one_stopped_car(), highway_radar(), settings, 3, 0, 7);
      REQUIRE(again.size() == seen.size());
      for (std::size_t i = 0; i < seen.size(); ++i) CHECK(again[i].range_m == seen[i].range_m);
    }
  }
  // Four standard deviations.
  CHECK(real / double{kFrames} == Approx(0.8).epsilon(0.0).margin(0.026));
  CHECK((all - real) / double{kFrames} == Approx(2.5).epsilon(0.0).margin(0.1));
  settings.detection_probability = 1.5;
  CHECK_THROWS_AS(simulated_frame(one_stopped_car(), highway_radar(), settings, 3, 0, 0),
                  core::InputError);
}

TEST_CASE("A target is measured in every frame but those of its gap, its neighbour in all",
          "[highway]") {
  const core::HighwayScenario scenario = one_hidden_for_half_a_second();
  for (const Scheme scheme : {Scheme::triangle, Scheme::two_slopes, Scheme::two_stage}) {
    SimulationSettings settings;
    settings.scheme = scheme;
    for (int frame = 0; frame < 30; ++frame) {
      INFO("scheme " << static_cast<int>(scheme) << ", frame " << frame);
      const auto seen = simulated_frame(scenario, highway_radar(), settings, 4, 0, frame);
      CHECK(times_measured(scenario, 0, frame, seen) == (frame >= 10 && frame < 20 ? 0 : 1));
      CHECK(times_measured(scenario, 1, frame, seen) == 1);
    }
  }
}

// The default second slope takes 3 ms.
TEST_CASE("A ramp may take as long as the second slope of a waveform that is not used",
          "[highway]") {
  core::HighwayRadar radar = highway_radar();
  core::HighwayWaveforms& waveforms = radar.waveforms;
  waveforms.triangle_ramp_s = waveforms.fine_ramp_s = waveforms.coded_ramp_s =
      waveforms.two_slopes_ramp_s[1];
  const core::HighwayScenario scenario = one_stopped_car();
  for (const Scheme scheme :
       {Scheme::triangle, Scheme::sorted_triangle, Scheme::two_stage, Scheme::coded}) {
    SimulationSettings settings;
    settings.scheme = scheme;
    INFO(length_of(scheme, waveforms) << " s");
    const auto seen = simulated_frame(scenario, radar, settings, 9, 0, 3);
    CHECK(times_measured(scenario, 0, 3, seen) == 1);
  }
}

TEST_CASE("Merged beats say how wrong they may be, lone ones that they are right", "[highway]") {
  for (const Scheme scheme : {Scheme::triangle, Scheme::two_stage}) {
    SimulationSettings settings;
    settings.scheme = scheme;
    for (const RadarMeasurement& one :
         simulated_frame(one_stopped_car(), highway_radar(), settings, 9, 0, 3)) {
      CHECK(one.range_systematic_m == 0.0);
      CHECK(one.range_rate_systematic_mps == 0.0);
      CHECK(one.azimuth_systematic_rad == 0.0);
    }
  }
  // Two cars of one strength, through each other in 2 s, 33 dB above the noise so that the array has one direction of
  // both. A beat of two is at most 0.6 bin from either, sqrt(3) times what it says, on either ramp.
  const core::HighwayScenario scenario = slow_crossing();
  core::HighwayRadar radar = highway_radar();
  radar.transmitted_W *= 1e-3;
  int merged = 0, lone = 0, beyond = 0;
  for (int frame = 80; frame < 160; ++frame) {
    std::vector<core::HighwayTruth> truth;
    for (const core::HighwayTarget& target : scenario.targets)
      truth.push_back(truth_at(target, scenario.radar_speed_mps, highway_radar(), frame * 0.05));
    for (const auto& one : simulated_frame(scenario, radar, {}, 9, 0, frame)) {
      const auto& own = truth[one.azimuth_rad < -0.03 ? 1 : 0];
      beyond += std::abs(one.range_m - own.range_m) >
                    std::sqrt(6.0) * one.range_systematic_m + 6.0 * one.range_sigma_m ||
                std::abs(one.range_rate_mps - own.range_rate_mps) >
                    std::sqrt(6.0) * one.range_rate_systematic_mps + 6.0 * one.range_rate_sigma_mps;
      (one.range_systematic_m > 0.0 ? merged : lone) += 1;
    }
  }
  CHECK(merged > 40);
  CHECK(lone > 40);
  // Now and then the coarse stage takes a beat of the other car.
  CHECK(beyond <= (merged + lone) / 20);
}

// A sixth of c / (N d), where the array tells two: 0.0278 in the sine of the azimuth; more where cars are weaker, 0.149 where
// 25 dB leave (720 27 / 316)^(1/4) / pi = 0.89 of it. A coded stretch has the array's beam, 8.5 degrees or 0.148.
TEST_CASE("Beats of one frequency merge within a direction, and beyond it with one direction alone",
          "[highway]") {
  const auto cars = [](double apart) {
    // Two standing cars, 30 m away.
    return scene(1.0, 0.0,
                 {car("A", 30.0, 0.0, 0.0),
                  car("B", 30.0 * std::sqrt(1.0 - apart * apart), 30.0 * apart, 0.0)});
  };
  const auto merged = [&](double apart, Scheme scheme, int elements, double weaker = 1.0) {
    core::HighwayRadar radar = highway_radar();
    radar.array_elements = elements;
    radar.transmitted_W *= weaker;
    SimulationSettings settings;
    settings.scheme = scheme;
    const auto seen = simulated_frame(cars(apart), radar, settings, 9, 0, 3);
    return std::any_of(seen.begin(), seen.end(),
                       [](const RadarMeasurement& one) { return one.range_systematic_m > 0.0; });
  };
  const double to_25_dB =
      std::pow(10.0, 2.5) / measurement_bound(highway_radar(), 10.0, 30.0, 0.0).signal_to_noise;
  CHECK(merged(0.12, Scheme::two_stage, 12, to_25_dB));
  CHECK_FALSE(merged(0.18, Scheme::two_stage, 12, to_25_dB));
  for (const auto& [scheme, one, two] :
       {std::tuple{Scheme::two_stage, 0.025, 0.031}, {Scheme::coded, 0.13, 0.17}}) {
    CHECK(merged(one, scheme, 12));
    CHECK_FALSE(merged(two, scheme, 12));
    const auto apart = simulated_frame(
        cars(0.17), highway_radar(),
        [&, scheme = scheme] {
          SimulationSettings settings;
          settings.scheme = scheme;
          return settings;
        }(),
        9, 0, 3);
    REQUIRE(apart.size() == 2);
    CHECK(std::abs(std::sin(apart[0].azimuth_rad) - std::sin(apart[1].azimuth_rad)) ==
          Approx(0.17).epsilon(0.0).margin(0.01));
  }
  // A triangle's pairs go by frequency alone, and one element tells no direction.
  CHECK(merged(0.17, Scheme::triangle, 12));
  CHECK(merged(0.17, Scheme::two_stage, 1));
}
