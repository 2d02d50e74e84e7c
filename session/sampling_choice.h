// How finely a run samples: as told, as fine as an accuracy needs, or as fine as a time allows.
//
//   --rays-per-cell, the scene's, or the default one sampling for all frames; with --rays-per-cell
//                                                an accuracy is for effects alone
//   --reference                                  converged
//   --accuracy GREY                              every frame refined until its estimated error is at
//                                                most half of GREY (renderer/accuracy/refinement.h);
//                                                the other half is for effects left out
//   --time-budget MS                             the finest sampling of a fixed ladder with which
//                                                frames spread over the run fit the time, each timed
//                                                from pose to pictures in memory; one sampling for
//                                                all frames, so --rays-per-cell with the number
//                                                chosen gives the same bytes
//   both                                         the coarsest of the ladder whose estimated error is
//                                                at most half of GREY, as long as it fits the time
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/casting/sampling.h"
#include "renderer/frame.h"
#include "scenes/scene.h"

namespace fanbeam::session {

struct SamplingRequest {
  double rays_per_cell = 0.0;  // or slices per column; 0: the scene's, else the default
  bool reference = false;
  double accuracy_grey = 0.0;   // 0: the scene's, else not asked for
  double time_budget_ms = 0.0;  // 0: the scene's, else no limit
  bool repeatable = false;      // no time budget of the scene's, which depends on the machine
  bool estimate_error = false;
};

struct SamplingChoice {
  renderer::Sampling sampling;
  // Of a time budget; zero without.
  double budget_ms = 0.0;
  double samples = 0.0;               // what --rays-per-cell takes
  double slowest_ms = 0.0;            // of the frames timed, each the median of three
  double estimated_error_grey = 0.0;  // the largest of the same frames
  bool fits = true;                   // false: the coarsest sampling is still too slow
};

// What the scene's [accuracy] asks for where no option does: an option about sampling replaces all
// that the scene says of it, but for the grey levels, which are for effects as well. An estimate of
// the error takes the place of a time budget.
SamplingRequest with_accuracy_of(const scenes::SceneDescription& scene, SamplingRequest request);

// The frames of a run that a time budget is measured on: a few spread over it.
std::vector<renderer::FramePose> poses_to_time(const scenes::Scene& scene,
                                               const std::vector<int>& frames);

// `request` as with_accuracy_of gives it; `poses`, one or more, are timed where it has a budget.
SamplingChoice choose_sampling(const SamplingRequest& request, const scenes::Scene& scene,
                               std::uint64_t seed, const renderer::Products& products,
                               const std::vector<renderer::FramePose>& poses);

}  // namespace fanbeam::session
