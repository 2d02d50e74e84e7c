// The tracker alone, one frame of 50 ms: six vehicles (target 0.2 ms) and a hundred (target 5 ms).
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/parallel.h"
#include "core/random.h"
#include "tracking/simulation/measurement_bound.h"
#include "tracking/simulation/scenario_run.h"

namespace fanbeam::benchmarks {
namespace {

constexpr int kFrames = 40;  // 2 s of traffic, after which a fresh tracker begins

core::HighwayRadar radar() {
  core::HighwayRadar result;
  result.transmit_gain = 1584.893192461114;  // 32 dB
  result.receive_gain = 501.1872336272722;   // 27 dB
  result.noise_figure = 2.818382931264454;   // 4.5 dB
  return result;
}

// Lanes 3.7 m apart, cars some 12 m behind each other, each at its own speed.
core::HighwayScenario traffic(int count) {
  core::HighwayScenario result;
  result.radar_speed_mps = 100.0 / 3.6;
  constexpr int kLanes = 7;
  for (int i = 0; i < count; ++i) {
    const auto words = core::random_words({2, 1006, 0}, static_cast<std::uint64_t>(i), 0);
    core::HighwayTarget car;
    car.cross_section_m2 = 10.0;
    car.position_m = {25.0 + 12.0 * (i / kLanes) + 3.0 * core::uniform_from(words[0]),
                      3.7 * (i % kLanes - kLanes / 2)};
    car.velocity_mps = {result.radar_speed_mps + 10.0 * (core::uniform_from(words[1]) - 0.5), 0.0};
    result.targets.push_back(car);
  }
  return result;
}

// As good as the bound, without merging: each target is a measurement.
std::vector<tracking::RadarMeasurement> measured(const core::HighwayScenario& scenario, int frame) {
  std::vector<tracking::RadarMeasurement> result;
  for (std::size_t i = 0; i < scenario.targets.size(); ++i) {
    const core::HighwayTruth truth =
        truth_at(scenario.targets[i], scenario.radar_speed_mps, radar(), frame * radar().frame_s);
    if (!truth.in_view) continue;
    const auto bound = tracking::measurement_bound(radar(), 10.0, truth.range_m, truth.azimuth_rad);
    const core::RandomKey key{2, 1007, static_cast<std::uint32_t>(frame)};
    const auto one = core::normal_pair(key, i, 0), two = core::normal_pair(key, i, 1);
    result.push_back({truth.range_m + bound.range_sigma_m * one[0],
                      truth.range_rate_mps + bound.range_rate_sigma_mps * one[1],
                      truth.azimuth_rad + bound.azimuth_sigma_rad * two[0], bound.range_sigma_m,
                      bound.range_rate_sigma_mps, bound.azimuth_sigma_rad});
  }
  return result;
}

void tracker(benchmark::State& state, int count, tracking::Association association) {
  const core::ThreadLimit one(1);
  const core::HighwayScenario scenario = traffic(count);
  std::vector<std::vector<tracking::RadarMeasurement>> frames;
  for (int i = 0; i < kFrames; ++i) frames.push_back(measured(scenario, i));
  auto settings = tracking::road_tracker(radar(), scenario.radar_speed_mps);
  settings.association = association;
  for ([[maybe_unused]] auto _ : state) {
    tracking::Tracker fresh(settings);
    for (int i = 0; i < kFrames; ++i)
      fresh.update(i * radar().frame_s, frames[static_cast<std::size_t>(i)]);
    state.counters["tracks"] = static_cast<double>(fresh.tracks().size());
  }
  state.counters["frame"] = benchmark::Counter(
      kFrames, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(tracker, six, 6, tracking::Association::nearest)
    ->Name("tracking/tracker_6_targets_40_frames")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tracker, six_joint, 6, tracking::Association::joint)
    ->Name("tracking/tracker_6_targets_40_frames_joint")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tracker, hundred, 100, tracking::Association::nearest)
    ->Name("tracking/tracker_100_targets_40_frames")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tracker, hundred_joint, 100, tracking::Association::joint)
    ->Name("tracking/tracker_100_targets_40_frames_joint")
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace fanbeam::benchmarks
