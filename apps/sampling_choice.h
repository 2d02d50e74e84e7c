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

#include <string>
#include <vector>

#include "apps/render_command.h"
#include "renderer/casting/sampling.h"
#include "renderer/frame_renderer.h"
#include "scenes/scene.h"

namespace fanbeam::apps {

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
RenderOptions with_accuracy_of(const scenes::SceneDescription& scene, RenderOptions options);

// `options` as with_accuracy_of gives them.
SamplingChoice choose_sampling(const RenderOptions& options, const scenes::Scene& scene,
                               const renderer::Products& products, const std::vector<int>& frames);

}  // namespace fanbeam::apps
