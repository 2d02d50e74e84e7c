// Beat signals of 400 x 256 x 12 samples, three transmitters in time division: 1000 paths to 1e-4
// (target 60 ms on one thread) and 1e-6, and a million paths (target 1 s on all threads).
#include <benchmark/benchmark.h>

#include "core/parallel.h"
#include "core/random.h"
#include "signal/synthesis/beat_synthesis.h"
#include "signal/synthesis/keystone_synthesis.h"
#include "signal/waveform/factories.h"

namespace fanbeam::benchmarks {
namespace {

struct Case {
  signal::Waveform waveform;
  signal::Array array;
  std::vector<signal::ScatterPath> paths;
};

Case case_of(int count) {
  signal::ChirpSequenceParameters parameters;
  parameters.slots = 3;
  Case made;
  made.waveform = signal::chirp_sequence(parameters);
  made.array = signal::line_array(3, 4, 0.5 * made.waveform.wavelength_m());
  for (int i = 0; i < count; ++i) {
    const auto cell = static_cast<std::uint64_t>(i);
    const auto words = core::random_words({1, 904, 0}, cell, 0);
    const auto amplitude = core::normal_pair({1, 904, 0}, cell, 1);
    signal::ScatterPath path;
    path.range_m = 20.0 + 180.0 * core::uniform_from(words[0]);
    path.radial_speed_mps = 60.0 * core::uniform_from(words[1]) - 30.0;
    path.azimuth_rad = 2.0 * core::uniform_from(words[2]) - 1.0;
    path.elevation_rad = 0.2 * core::uniform_from(words[3]) - 0.1;
    path.amplitude_sqrtW = {amplitude[0], amplitude[1]};
    made.paths.push_back(path);
  }
  return made;
}

void beat_1000(benchmark::State& state, double relative_error) {
  const core::ThreadLimit one(1);
  const Case given = case_of(1000);
  for ([[maybe_unused]] auto _ : state)
    benchmark::DoNotOptimize(
        signal::synthesise_beat(given.waveform, 0, given.array, given.paths, {relative_error}));
}
BENCHMARK_CAPTURE(beat_1000, to_1e_4, 1e-4)
    ->Name("signal/beat_1000_paths_1e-4_one_thread")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(beat_1000, to_1e_6, 1e-6)
    ->Name("signal/beat_1000_paths_1e-6_one_thread")
    ->Unit(benchmark::kMillisecond);

void beat_million(benchmark::State& state) {
  const Case given = case_of(1000000);
  for ([[maybe_unused]] auto _ : state)
    benchmark::DoNotOptimize(signal::keystone_beat(given.waveform, 0, given.array, given.paths));
}
BENCHMARK(beat_million)
    ->Name("signal/beat_1e6_paths")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace fanbeam::benchmarks
