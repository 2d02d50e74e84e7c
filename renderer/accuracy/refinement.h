// Casts a fan until its sampling error is as small as asked for, and says how large it is.
//
// Samples come in levels (CastPass), and how far the pictures of two levels are apart says how good
// they are. D is the RMS of their difference over cells of unrounded displayed grey.
//
// Slices: each level has twice as many and replaces the one before.
//   error of the old level = 1.0 D, of the new one 0.5 D
// For an error that falls by 2.3 with each level, in a way of its own, it would be 0.92 and 0.40.
// Where in its sub-column a thing stands, the beam does not know. What that costs is told by what
// sub-columns in pairs would cost, an error that falls with the square of their width, and joins the
// other. Fewer than eight slices per column have fewer sub-columns too: what such a sampling gives by
// itself is compared with the sampling of twice as many slices, sub-columns and all.
//
// Double bounces: as slices, each level has twice as many and replaces the one before.
//   error of the old level = 0.85 D, of the new one 0.55 D
//
// Rays: each level puts as many new samples as there were before between them. The picture of the
// old samples and that of the new ones are two answers to the same question, equally good; their
// mean is better than both:
//   error of the old         =  0.78 D
//   error of the first mean  =  0.55 D
//   error of later means     =  0.70 D
// For errors that are independent the factors would be 0.71 and 0.50. Rays have a part in common that
// D does not see, the interval of ranges that a ray stands for on ground and roofs.
//
// The factors are fits to converged pictures; docs/performance-notes.md holds estimates against true
// errors. What every early sample missed, a narrow thing behind others, is in no estimate of rays.
//
// Refined is where it is needed: columns whose own error is above the target get the next level,
// with the columns beside them that their beam reaches, until the RMS over all columns is at most
// the target, of the B-scope and of the C-scope where there is one. Double bounces have samples of
// their own; they are refined in whole fans, and share the target: sqrt(1/2) of it for each.
//
// A C-scope of mode flat_earth or shadow is drawn from each of two B-scopes that are compared. In mode
// shadow an obstacle that one of the two raises and the other does not counts in full in the estimate, but
// no column is refined for it: it may tip at any level. One that tips in columns that are good enough
// already is not seen.
//
// Not in the estimate: point targets, which are not sampled at random. The echo of rain is not
// either, but it fills the cells in which errors would show.
// Deterministic: depends on the pose and the world alone.
// Cost: that of level 0 twice with rays and three times with slices, at least, and two pictures per
// level to compare; in rain its echo once more, so that a frame has the same bytes with an estimate
// and without. In mode shadow two searches per comparison (sensors/shadow/shadow_obstacles.h), and its
// C-scopes once more without obstacles.
#pragma once

#include "renderer/accuracy/column_error.h"
#include "renderer/accuracy/error_estimate.h"
#include "renderer/casting/caster.h"
#include "renderer/casting/sampling.h"
#include "renderer/plan/effects.h"
#include "renderer/stages/double_bounce.h"
#include "renderer/world.h"

namespace fanbeam::renderer {

class Refinement {
 public:
  // `bounces` is null where that effect is off; `draws_cscope`: a C-scope is drawn from the B-scope,
  // in a mode that does. All must outlive it.
  Refinement(const World& world, const Sampling& sampling, const Caster& caster,
             const DoubleBounce* bounces, const Effects& effects, bool draws_cscope = false)
      : world_(world),
        sampling_(sampling),
        caster_(caster),
        bounces_(bounces),
        effects_(effects),
        draws_cscope_(draws_cscope) {}

  // Casts and adds the bounces: until the estimate is at most the sampling's target_grey, or, where
  // that is 0, what the sampling gives by itself with the estimate of its error. `bounced`, unless
  // null, receives what bounces add.
  ErrorEstimate cast(const sensors::AntennaFrame& antenna, bool with_cscope, FanSums& sums,
                     SightLines& sight, BounceFan* bounced = nullptr) const;

 private:
  // Each is given sums of level 0. `target_grey` 0: what level 0 gives.
  ErrorEstimate refine(const sensors::AntennaFrame& antenna, bool with_cscope,
                       const ColumnError& difference, double target_grey, FanSums& sums) const;
  ErrorEstimate estimate(const sensors::AntennaFrame& antenna, bool with_cscope,
                         const ColumnError& difference, const FanSums& sums) const;
  ColumnError::Squares of_sub_columns(const ColumnError& difference, const FanSums& sums) const;
  ErrorEstimate add_bounces(const sensors::AntennaFrame& antenna, const ColumnError& difference,
                            double target_grey, FanSums& sums, BounceFan* bounced) const;

  const World& world_;
  const Sampling& sampling_;
  const Caster& caster_;
  const DoubleBounce* bounces_;
  Effects effects_;
  bool draws_cscope_;
};

}  // namespace fanbeam::renderer
