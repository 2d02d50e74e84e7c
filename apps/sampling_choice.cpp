#include "apps/sampling_choice.h"

#include <algorithm>
#include <array>
#include <chrono>

#include "renderer/plan/effects.h"

namespace fanbeam::apps {
namespace {

constexpr std::array kSlices = {1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0, 48.0, 64.0};
constexpr std::array kRays = {0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 32.0, 64.0};
constexpr std::size_t kFramesTimed = 3;
constexpr int kRepetitions = 3;

renderer::Sampling sampling_of(renderer::CasterKind caster, double samples) {
  return caster == renderer::CasterKind::profile ? renderer::profile_sampling_for(samples)
                                                 : renderer::sampling_for(samples);
}

double default_samples(renderer::CasterKind caster) {
  return caster == renderer::CasterKind::profile ? renderer::kDefaultSlicesPerColumn
                                                 : renderer::kDefaultRaysPerCell;
}

double larger(const renderer::ErrorEstimate& error) {
  return std::max(error.rms_grey, error.cscope_rms_grey);
}

// Frames spread over the run, at the middles of equal parts.
std::vector<int> spread(const std::vector<int>& frames) {
  std::vector<int> chosen;
  const std::size_t count = std::min(kFramesTimed, frames.size());
  for (std::size_t i = 0; i < count; ++i)
    chosen.push_back(frames[(2 * i + 1) * frames.size() / (2 * count)]);
  return chosen;
}

class Trial {
 public:
  Trial(const RenderOptions& options, const scenes::Scene& scene,
        const renderer::Products& products, const std::vector<int>& frames)
      : options_(options), scene_(scene), products_(products), frames_(spread(frames)) {}

  // Median time of the slowest frame.
  double slowest_ms(const renderer::Sampling& sampling) const {
    const renderer::FrameRenderer frame_renderer = renderer_of(sampling);
    double slowest_ms = 0.0;
    for (const int frame : frames_) {
      const renderer::FramePose pose = scene_.frame_pose(frame);
      frame_renderer.render(pose);  // the first one fills caches
      std::array<double, kRepetitions> times_ms{};
      for (double& time_ms : times_ms) {
        const auto begin = std::chrono::steady_clock::now();
        frame_renderer.render(pose);
        time_ms =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
                .count();
      }
      std::sort(times_ms.begin(), times_ms.end());
      slowest_ms = std::max(slowest_ms, times_ms[kRepetitions / 2]);
    }
    return slowest_ms;
  }

  double largest_error_grey(renderer::Sampling sampling) const {
    sampling.estimate_error = true;
    const renderer::FrameRenderer frame_renderer = renderer_of(sampling);
    double largest_grey = 0.0;
    for (const int frame : frames_)
      largest_grey =
          std::max(largest_grey, larger(*frame_renderer.render(scene_.frame_pose(frame)).error));
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
  const auto climb = [&](const auto& ladder) {
    for (const double samples : ladder) {
      const renderer::Sampling sampling = sampling_of(caster, samples);
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
      if (choice.estimated_error_grey <= sampling_share_grey(options.accuracy_grey)) return;
    }
    choice.estimated_error_grey = trial.largest_error_grey(choice.sampling);
  };
  if (caster == renderer::CasterKind::profile)
    climb(kSlices);
  else
    climb(kRays);
  return choice;
}

}  // namespace

double sampling_share_grey(double accuracy_grey) { return accuracy_grey / 2.0; }

SamplingChoice choose_sampling(const RenderOptions& options, const scenes::Scene& scene,
                               const renderer::Products& products, const std::vector<int>& frames) {
  if (options.time_budget_ms > 0.0) return fit_to_time(options, scene, products, frames);
  SamplingChoice choice;
  const renderer::CasterKind caster = scene.caster.chosen;
  if (options.reference) {
    choice.sampling = renderer::reference_sampling(options.seed);
  } else if (options.accuracy_grey > 0.0 && !(options.rays_per_cell > 0.0)) {
    choice.sampling =
        renderer::refined_sampling(caster, sampling_share_grey(options.accuracy_grey));
  } else {
    const double asked =
        options.rays_per_cell > 0.0 ? options.rays_per_cell : scene.description.rays_per_cell;
    choice.sampling = sampling_of(caster, asked > 0.0 ? asked : default_samples(caster));
    choice.sampling.estimate_error = options.estimate_error;
  }
  return choice;
}

}  // namespace fanbeam::apps
