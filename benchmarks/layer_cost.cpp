#include "benchmarks/layer_cost.h"

#include <fmt/core.h>

#include <algorithm>

#include "benchmarks/bench_scene.h"
#include "core/median.h"
#include "measure/clock.h"
#include "renderer/frame_renderer.h"

namespace fanbeam::benchmarks {
namespace {

LayerCost layer_cost(const BenchScene& bench, const Effort& effort) {
  const View view = view_at(bench, kDistances_m[0]);
  const renderer::Sampling sampling = renderer::default_sampling(bench.scene->caster.chosen);
  const renderer::Effects effects = renderer::effects_of(bench.scene->plan, 0);
  const renderer::FrameRenderer plain(view.world(), sampling, {}, effects);
  const renderer::FrameRenderer layered(view.world(), sampling,
                                        {.layers = true, .cscope_layers = true}, effects);
  std::vector<double> plain_ms, layers_ms;
  for (int turn = -1; turn < std::max(effort.turns, 2); ++turn)
    for (const auto& [renderer, times_ms] :
         {std::pair(&plain, &plain_ms), std::pair(&layered, &layers_ms)}) {
      const auto begin = measure::Clock::now();
      renderer->render(view.pose);
      if (turn >= 0) times_ms->push_back(measure::milliseconds_since(begin));
    }
  return {bench.name, core::median(plain_ms), core::median(layers_ms)};
}

}  // namespace

std::vector<LayerCost> measure_layers(const Effort& effort) {
  std::vector<LayerCost> costs;
  for (const std::string& name : shipped_scenes()) {
    const auto bench = load(name);
    if (!bench) continue;
    fmt::print(stderr, "{}: what layers cost\n", name);
    costs.push_back(layer_cost(*bench, effort));
  }
  return costs;
}

}  // namespace fanbeam::benchmarks
