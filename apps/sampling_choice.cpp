#include "apps/sampling_choice.h"

#include <algorithm>

#include "apps/cost/turns.h"
#include "apps/frame_choice.h"
#include "renderer/plan/effects.h"
#include "renderer/plan/plan.h"

namespace fanbeam::apps {
namespace {

constexpr std::size_t kFramesTimed = 3;
constexpr int kRepetitions = 3;

// What a time budget is spent on, coarsest first.
std::vector<double> ladder_of(renderer::CasterKind caster) {
  if (caster == renderer::CasterKind::profile) return {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64};
  return {0.5, 0.7, 1, 1.5, 2, 3, 4, 6, 8, 12, 16, 32, 64};
}

class Trial {
 public:
  Trial(const RenderOptions& options, const scenes::Scene& scene,
        const renderer::Products& products, const std::vector<int>& frames)
      : options_(options),
        scene_(scene),
        products_(products),
        frames_(spread_over(frames, kFramesTimed)) {}

  // Median time of the slowest frame.
  double slowest_ms(const renderer::Sampling& sampling) const {
    const renderer::FrameRenderer frame_renderer = renderer_of(sampling);
    double slowest_ms = 0.0;
    for (const int frame : frames_) {
      const renderer::FramePose pose = scene_.frame_pose(frame);
      const MedianTime time =
          time_in_turns({[&] { frame_renderer.render(pose); }}, kRepetitions).front();
      slowest_ms = std::max(slowest_ms, time.ms);
    }
    return slowest_ms;
  }

  double largest_error_grey(renderer::Sampling sampling) const {
    sampling.estimate_error = true;
    const renderer::FrameRenderer frame_renderer = renderer_of(sampling);
    double largest_grey = 0.0;
    for (const int frame : frames_)
      largest_grey = std::max(
          largest_grey, frame_renderer.render(scene_.frame_pose(frame)).error->largest_grey());
    return largest_grey;
  }

 private:
  renderer::FrameRenderer renderer_of(const renderer::Sampling& sampling) const {
    return {scene_.world, sampling, products_, renderer::effects_of(scene_.plan, options_.seed)};
  }

  const RenderOptions& options_;
  const scenes::Scene& scene_;
  renderer::Products products_;
  std::vector<int> frames_;
};

SamplingChoice fit_to_time(const RenderOptions& options, const scenes::Scene& scene,
                           const renderer::Products& products, const std::vector<int>& frames) {
  const renderer::CasterKind caster = scene.caster.chosen;
  const Trial trial(options, scene, products, frames);
  SamplingChoice choice;
  choice.budget_ms = options.time_budget_ms;
  for (const double samples : ladder_of(caster)) {
    const renderer::Sampling sampling = renderer::sampling_for(caster, samples);
    const double slowest_ms = trial.slowest_ms(sampling);
    const bool fits = slowest_ms <= options.time_budget_ms;
    if (!fits && choice.samples > 0.0) break;
    choice.sampling = sampling;
    choice.samples = samples;
    choice.slowest_ms = slowest_ms;
    choice.fits = fits;
    if (!fits) break;
    if (!(options.accuracy_grey > 0.0)) continue;
    choice.estimated_error_grey = trial.largest_error_grey(sampling);
    if (choice.estimated_error_grey <= renderer::sampling_share_grey(options.accuracy_grey))
      return choice;
  }
  choice.estimated_error_grey = trial.largest_error_grey(choice.sampling);
  return choice;
}

}  // namespace

RenderOptions with_accuracy_of(const scenes::SceneDescription& scene, RenderOptions options) {
  const bool chosen = options.reference || options.rays_per_cell > 0.0 ||
                      options.accuracy_grey > 0.0 || options.time_budget_ms > 0.0;
  if (!(options.accuracy_grey > 0.0)) options.accuracy_grey = scene.accuracy_grey;
  if (chosen) return options;
  options.rays_per_cell = scene.rays_per_cell;
  if (!options.estimate_error && !options.repeatable) options.time_budget_ms = scene.time_budget_ms;
  return options;
}

SamplingChoice choose_sampling(const RenderOptions& options, const scenes::Scene& scene,
                               const renderer::Products& products, const std::vector<int>& frames) {
  if (options.time_budget_ms > 0.0) return fit_to_time(options, scene, products, frames);
  SamplingChoice choice;
  const renderer::CasterKind caster = scene.caster.chosen;
  if (options.reference) {
    choice.sampling = renderer::reference_sampling(options.seed);
  } else if (options.accuracy_grey > 0.0 && !(options.rays_per_cell > 0.0)) {
    choice.sampling =
        renderer::refined_sampling(caster, renderer::sampling_share_grey(options.accuracy_grey));
  } else {
    choice.sampling = renderer::sampling_for(caster, options.rays_per_cell > 0.0
                                                         ? options.rays_per_cell
                                                         : renderer::default_samples(caster));
    choice.sampling.estimate_error = options.estimate_error;
  }
  return choice;
}

}  // namespace fanbeam::apps
