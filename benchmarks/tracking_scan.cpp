// A whole scan of the highway with six vehicles, from beat signals and noise through transforms,
// detector and pairing to the tracks: target 50 ms on two cores.
#include <benchmark/benchmark.h>

#include "core/parallel.h"
#include "tracking/simulation/sampled_frame.h"
#include "tracking/simulation/scenario_run.h"

namespace fanbeam::benchmarks {
namespace {

core::HighwayTarget car(double x_m, double y_m, double vx_mps, double section_m2 = 10.0) {
  core::HighwayTarget target;
  target.cross_section_m2 = section_m2;
  target.position_m = {x_m, y_m};
  target.velocity_mps = {vx_mps, 0.0};
  return target;
}

void scan(benchmark::State& state) {
  const core::ThreadLimit two(2);
  core::HighwayRadar radar;
  radar.transmit_gain = 1584.893192461114;  // 32 dB
  radar.receive_gain = 501.1872336272722;   // 27 dB
  radar.noise_figure = 2.818382931264454;   // 4.5 dB
  core::HighwayScenario scenario;
  scenario.radar_speed_mps = 100.0 / 3.6;
  scenario.targets = {car(35.0, 0.0, 26.0),       car(62.0, 3.7, 22.5, 100.0),
                      car(58.0, -3.7, 33.0, 1.5), car(95.0, 0.0, 29.5),
                      car(190.0, -11.1, -30.0),   car(128.0, -3.7, 36.0, 8.0)};
  const tracking::SampledRadar sampled(radar);
  tracking::Tracker tracker(tracking::road_tracker(radar, scenario.radar_speed_mps));
  int frame = 0;
  for ([[maybe_unused]] auto _ : state) {
    tracker.update(frame * radar.frame_s, sampled.measure(scenario, 1, 0, frame));
    ++frame;
  }
  state.counters["tracks"] = static_cast<double>(tracker.tracks().size());
}
BENCHMARK(scan)->Name("tracking/scan_6_targets")->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace fanbeam::benchmarks
