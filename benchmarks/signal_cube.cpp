// Range-Doppler transforms of a radar cube, against the bare Fourier transforms of as much data
// whose values are neighbours along both axes.
#include <benchmark/benchmark.h>

#include "core/parallel.h"
#include "signal/cube.h"
#include "signal/fourier/fft.h"
#include "signal/transform/cube_maps.h"
#include "signal/transform/range_doppler.h"

namespace fanbeam::benchmarks {
namespace {

using signal::Fft;
using signal::FftDirection;
using signal::FloatCube;

constexpr signal::CubeShape kShape{512, 256, 16};

FloatCube filled_cube() {
  FloatCube cube(kShape);
  for (std::size_t i = 0; i < cube.values.size(); ++i)
    cube.values[i] = {static_cast<float>(i % 97), static_cast<float>(i % 31)};
  return cube;
}

void range_doppler(benchmark::State& state) {
  const core::ThreadLimit one_thread(1);
  const FloatCube beat = filled_cube();
  FloatCube result;
  for ([[maybe_unused]] const auto& iteration : state) {
    signal::range_doppler(beat, {}, result);
    benchmark::DoNotOptimize(result.values.data());
  }
}

void bare_transforms(benchmark::State& state) {
  const FloatCube beat = filled_cube();
  FloatCube result(kShape);
  const Fft<float> range({kShape.samples, 1, kShape.chirps * kShape.channels, kShape.samples},
                         FftDirection::forward);
  const Fft<float> doppler({kShape.chirps, 1, kShape.samples * kShape.channels, kShape.chirps},
                           FftDirection::forward);
  FloatCube again(kShape);
  for ([[maybe_unused]] const auto& iteration : state) {
    range.run(beat.values.data(), result.values.data());
    doppler.run(result.values.data(), again.values.data());
    benchmark::DoNotOptimize(again.values.data());
  }
}

void power_map(benchmark::State& state) {
  const core::ThreadLimit one_thread(1);
  const FloatCube cube = filled_cube();
  for ([[maybe_unused]] const auto& iteration : state)
    benchmark::DoNotOptimize(signal::range_doppler_map(cube, signal::Projection::sum));
}

BENCHMARK(range_doppler)->Name("signal/range_doppler_512x256x16")->Unit(benchmark::kMillisecond);
BENCHMARK(bare_transforms)->Name("signal/bare_transforms")->Unit(benchmark::kMillisecond);
BENCHMARK(power_map)->Name("signal/range_doppler_map")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace fanbeam::benchmarks
