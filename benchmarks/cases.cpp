#include "benchmarks/cases.h"

#include <benchmark/benchmark.h>

#include "benchmarks/view_clock.h"
#include "renderer/casting/path_loss_table.h"
#include "renderer/casting/ray_caster.h"
#include "renderer/stages/azimuth_beam.h"
#include "renderer/surfaces/nrcs_table.h"

namespace fanbeam::benchmarks {
namespace {

using benchmark::Counter;
using benchmark::State;

constexpr double kDistance_m = 2500.0;
constexpr int kLookups = 4096;

renderer::Sampling default_sampling() {
  return renderer::sampling_for(renderer::kDefaultRaysPerCell);
}

void frame(State& state, const BenchScene& scene, const renderer::Sampling& sampling) {
  const View view = view_at(scene, kDistance_m);
  const FrameClock clock = clock_of(view, sampling);
  renderer::Frame frame;
  double rays = 0.0;
  double slices = 0.0;
  for ([[maybe_unused]] const auto& iteration : state) {
    clock.frame_ms(&frame);
    rays += static_cast<double>(frame.rays);
    slices += static_cast<double>(frame.slices);
  }
  if (rays > 0.0) state.counters["rays/s"] = Counter(rays, Counter::kIsRate);
  if (slices > 0.0) state.counters["slices/s"] = Counter(slices, Counter::kIsRate);
}

void azimuth_beam(State& state, const BenchScene& scene) {
  const View view = view_at(scene, kDistance_m);
  const renderer::RayCaster caster(view.world(), default_sampling());
  renderer::FanSums sums;
  caster.cast(view.antenna, false, sums);
  for ([[maybe_unused]] const auto& iteration : state)
    benchmark::DoNotOptimize(renderer::apply_azimuth_beam(
        sums.range_W_per_rad, sums.cells, sums, view.sensor(), default_sampling().sub_columns));
}

void display(State& state, const BenchScene& scene) {
  const View view = view_at(scene, kDistance_m);
  const renderer::Frame frame =
      renderer::render_frame(view.world(), default_sampling(), {}, {}, view.pose);
  const FramePower power{frame.bscope_W, frame.cscope_W_m3};
  for ([[maybe_unused]] const auto& iteration : state)
    benchmark::DoNotOptimize(grey_of(view.sensor(), power, true));
}

void path_loss(State& state, const BenchScene& scene) {
  const View view = view_at(scene, kDistance_m);
  const double top_m = view.antenna.position_m.z;
  const renderer::PathLossTable table(view.world().attenuation, top_m, 0.0, top_m);
  double sum = 0.0;
  for ([[maybe_unused]] const auto& iteration : state)
    for (int i = 0; i < kLookups; ++i) sum += table.two_way_factor(top_m * i / kLookups, 200.0 + i);
  benchmark::DoNotOptimize(sum);
  state.SetItemsProcessed(state.iterations() * kLookups);
}

void nrcs_table(State& state, const BenchScene& scene) {
  const renderer::NrcsTable& table = scene.scene->world.nrcs.tables().front();
  double sum = 0.0;
  for ([[maybe_unused]] const auto& iteration : state)
    for (int i = 0; i < kLookups; ++i) sum += table.sigma0_over_sine((i + 0.5) / kLookups);
  benchmark::DoNotOptimize(sum);
  state.SetItemsProcessed(state.iterations() * kLookups);
}

void scene_build(State& state, const std::string& name) {
  for ([[maybe_unused]] const auto& iteration : state) benchmark::DoNotOptimize(build(name));
}

}  // namespace

void register_cases(const std::vector<BenchScene>& scenes) {
  using benchmark::RegisterBenchmark;
  const auto slices = renderer::profile_sampling_for(renderer::kDefaultSlicesPerColumn);
  for (const BenchScene& scene : scenes) {
    RegisterBenchmark(("frame/" + scene.name).c_str(), frame, std::cref(scene), default_sampling())
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
    RegisterBenchmark(("frame_slices/" + scene.name).c_str(), frame, std::cref(scene), slices)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  }
  const BenchScene& scene = scenes.front();
  RegisterBenchmark("azimuth_beam", azimuth_beam, std::cref(scene))
      ->Unit(benchmark::kMicrosecond)
      ->UseRealTime();
  RegisterBenchmark("display", display, std::cref(scene))
      ->Unit(benchmark::kMicrosecond)
      ->UseRealTime();
  RegisterBenchmark("path_loss", path_loss, std::cref(scene))->Unit(benchmark::kMicrosecond);
  RegisterBenchmark("nrcs_table", nrcs_table, std::cref(scene))->Unit(benchmark::kMicrosecond);
  RegisterBenchmark(("scene_build/" + scene.name).c_str(), scene_build, scene.name)
      ->Unit(benchmark::kMillisecond)
      ->Iterations(1)
      ->UseRealTime();
}

}  // namespace fanbeam::benchmarks
