#include "session/sampling_choice.h"

#include <algorithm>
#include <utility>

#include "core/turns.h"
#include "renderer/accuracy/sampling_ladder.h"
#include "renderer/frame_renderer.h"
#include "renderer/plan/effects.h"
#include "renderer/plan/plan.h"
#include "session/frame_choice.h"

namespace fanbeam::session {
namespace {

constexpr std::size_t kFramesTimed = 3;
constexpr int kRepetitions = 3;

class Trial {
 public:
  Trial(const scenes::Scene& scene, std::uint64_t seed, const renderer::Products& products,
        std::vector<renderer::FramePose> poses)
      : scene_(scene), seed_(seed), products_(products), poses_(std::move(poses)) {}

  // Median time of the slowest frame.
  double slowest_ms(const renderer::Sampling& sampling) const {
    const renderer::FrameRenderer frame_renderer = renderer_of(sampling);
    double slowest_ms = 0.0;
    for (const renderer::FramePose& pose : poses_) {
      const core::MedianTime time =
          core::time_in_turns({[&] { frame_renderer.render(pose); }}, kRepetitions).front();
      slowest_ms = std::max(slowest_ms, time.ms);
    }
    return slowest_ms;
  }

  double largest_error_grey(renderer::Sampling sampling) const {
    sampling.estimate_error = true;
    const renderer::FrameRenderer frame_renderer = renderer_of(sampling);
    double largest_grey = 0.0;
    for (const renderer::FramePose& pose : poses_)
      largest_grey = std::max(largest_grey, frame_renderer.render(pose).error->largest_grey());
    return largest_grey;
  }

 private:
  renderer::FrameRenderer renderer_of(const renderer::Sampling& sampling) const {
    return {scene_.world, sampling, products_, renderer::effects_of(scene_.plan, seed_)};
  }

  const scenes::Scene& scene_;
  std::uint64_t seed_;
  renderer::Products products_;
  std::vector<renderer::FramePose> poses_;
};

// The finest that fits, or the first whose estimated error is at most `share_grey` where that is
// above 0.
SamplingChoice fitted(const Trial& trial, renderer::CasterKind caster, double budget_ms,
                      double share_grey) {
  SamplingChoice choice;
  choice.budget_ms = budget_ms;
  for (const double samples : renderer::sampling_ladder(caster)) {
    const renderer::Sampling sampling = renderer::sampling_for(caster, samples);
    const double slowest_ms = trial.slowest_ms(sampling);
    const bool fits = slowest_ms <= budget_ms;
    if (!fits && choice.samples > 0.0) break;
    choice.sampling = sampling;
    choice.samples = samples;
    choice.slowest_ms = slowest_ms;
    choice.fits = fits;
    if (!fits) break;
    if (!(share_grey > 0.0)) continue;
    choice.estimated_error_grey = trial.largest_error_grey(sampling);
    if (choice.estimated_error_grey <= share_grey) return choice;
  }
  choice.estimated_error_grey = trial.largest_error_grey(choice.sampling);
  return choice;
}

}  // namespace

SamplingRequest with_accuracy_of(const scenes::SceneDescription& scene, SamplingRequest request) {
  const bool chosen = request.reference || request.rays_per_cell > 0.0 ||
                      request.accuracy_grey > 0.0 || request.time_budget_ms > 0.0;
  if (!(request.accuracy_grey > 0.0)) request.accuracy_grey = scene.accuracy_grey;
  if (chosen) return request;
  request.rays_per_cell = scene.rays_per_cell;
  if (!request.estimate_error && !request.repeatable) request.time_budget_ms = scene.time_budget_ms;
  return request;
}

std::vector<renderer::FramePose> poses_to_time(const scenes::Scene& scene,
                                               const std::vector<int>& frames) {
  std::vector<renderer::FramePose> poses;
  for (const int frame : spread_over(frames, kFramesTimed))
    poses.push_back(scene.frame_pose(frame));
  return poses;
}

SamplingChoice choose_sampling(const SamplingRequest& request, const scenes::Scene& scene,
                               std::uint64_t seed, const renderer::Products& products,
                               const std::vector<renderer::FramePose>& poses) {
  const renderer::CasterKind caster = scene.caster.chosen;
  if (request.time_budget_ms > 0.0)
    return fitted(
        {scene, seed, products, poses}, caster, request.time_budget_ms,
        request.accuracy_grey > 0.0 ? renderer::sampling_share_grey(request.accuracy_grey) : 0.0);
  SamplingChoice choice;
  if (request.reference) {
    choice.sampling = renderer::reference_sampling(seed);
  } else if (request.accuracy_grey > 0.0 && !(request.rays_per_cell > 0.0)) {
    choice.sampling =
        renderer::refined_sampling(caster, renderer::sampling_share_grey(request.accuracy_grey));
  } else {
    choice.sampling = renderer::sampling_for(caster, request.rays_per_cell > 0.0
                                                         ? request.rays_per_cell
                                                         : renderer::default_samples(caster));
    choice.sampling.estimate_error = request.estimate_error;
  }
  return choice;
}

}  // namespace fanbeam::session
