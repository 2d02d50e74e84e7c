#include "benchmarks/default_settings.h"

#include <fmt/core.h>

namespace fanbeam::benchmarks {

FrameError default_error(const View& view, const GreyReference& reference) {
  const renderer::CasterKind caster = view.scene->scene->caster.chosen;
  return clock_of(view, renderer::default_sampling(caster)).error(reference);
}

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
    const GreyReference reference(view.sensor(), clock_of(view, effort.reference(1)).power());
    figures.views.push_back({view.distance_m, default_error(view, reference)});
  }
  return figures;
}

}  // namespace fanbeam::benchmarks
