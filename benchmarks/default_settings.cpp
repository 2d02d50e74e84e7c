#include "benchmarks/default_settings.h"

#include <fmt/core.h>

namespace fanbeam::benchmarks {

std::optional<DefaultFigures> measure_defaults(const std::string& scene, const Effort& effort,
                                               int threads) {
  const auto bench = load(scene);
  if (!bench) return std::nullopt;
  DefaultFigures figures{scene, {}, {}};
  for (const double distance_m : kDistances_m) {
    const View view = view_at(*bench, distance_m);
    if (figures.views.empty())
      figures.sequence = measure_sequence(view, {renderer::CasterWish::automatic},
                                          effort.sequence_frames, threads);
    fmt::print(stderr, "{} at {:.0f} m: default sampling\n", scene, view.distance_m);
    const renderer::CasterKind caster = bench->scene->caster.chosen;
    const auto sampling = renderer::default_sampling(caster);
    const GreyReference reference(view.sensor(), clock_of(view, effort.reference(1)).power());
    figures.views.push_back({view.distance_m, clock_of(view, sampling).error(reference)});
  }
  return figures;
}

}  // namespace fanbeam::benchmarks
