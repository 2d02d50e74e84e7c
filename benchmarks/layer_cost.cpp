#include "benchmarks/layer_cost.h"

#include <fmt/core.h>

#include <algorithm>

#include "benchmarks/bench_scene.h"
#include "core/turns.h"
#include "session/session.h"

namespace fanbeam::benchmarks {
namespace {

LayerCost layer_cost(const BenchScene& bench, const Effort& effort) {
  const View view = view_at(bench, kDistances_m[0]);
  const auto never = open(bench.name), gives = open(bench.name);
  const auto work = [&](const session::Session& session, const renderer::Products& wanted) {
    return [&session, &bench, frame = view.frame, wanted] {
      session.render_flown(frame, bench.scene->plan, wanted);
    };
  };
  const std::vector<core::MedianTime> times = core::time_in_turns(
      {work(*never, {}), work(*gives, {.layers = true, .cscope_layers = true}), work(*gives, {})},
      std::max(effort.turns, 2));
  return {bench.name, times[0].ms, times[1].ms, times[2].ms};
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
