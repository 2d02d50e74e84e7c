// Casts a fan until its sampling error is as small as asked for, and says how large it is.
//
// Samples come in levels (CastPass): each level puts as many new samples as there were before
// between them. The picture of the old samples and that of the new ones are two answers to the same
// question, equally good; their difference D says how good, and their mean is better than both:
//   error of the mean  =  0.45 D for slices, 0.62 D for rays
//   error of the old   =  0.50 D for slices, 0.78 D for rays
// as RMS over cells of unrounded displayed grey. For errors that are independent the factors would
// be 0.50 and 0.71. A slice's errors are edges that fall between two slices, evenly spread: halving
// the spacing of a step function gives 0.29, for the old ones 0.58. Rays have a part in common that
// D does not see, the interval of ranges that a ray stands for. The factors are fits to converged
// pictures; docs/accuracy-and-cost.md holds estimates against true errors.
//
// Refined is where it is needed: columns whose own error is above the target get the next level,
// with the columns beside them that their beam reaches, until the RMS over all columns is at most
// the target.
//
// Not in the estimate: what further stages add (rain echo, double bounce, point targets, all with
// samplings of their own). They brighten cells, which makes the caster's error there smaller.
// Deterministic: depends on the pose and the world alone.
// Cost: twice that of level 0 at least, and two pictures per level to compare.
#pragma once

#include "renderer/casting/caster.h"
#include "renderer/casting/sampling.h"
#include "renderer/world.h"

namespace fanbeam::renderer {

struct ErrorEstimate {
  double rms_grey = 0.0;
  int levels = 1;       // cast, at the column that took most
  bool reached = true;  // false: the finest level is still coarser than asked for
};

class Refinement {
 public:
  // Of pictures with the mean noise power or without. All must outlive it.
  Refinement(const World& world, const Sampling& sampling, const Caster& caster, bool noise)
      : world_(world), sampling_(sampling), caster_(caster), noise_(noise) {}

  // Until the estimate is at most `target_grey`.
  ErrorEstimate cast(const sensors::AntennaFrame& antenna, bool with_cscope, double target_grey,
                     FanSums& sums, SightLines& sight) const;

  // Leaves in `sums` what the sampling gives without refinement, and estimates its error.
  ErrorEstimate estimate(const sensors::AntennaFrame& antenna, bool with_cscope, FanSums& sums,
                         SightLines& sight) const;

 private:
  const World& world_;
  const Sampling& sampling_;
  const Caster& caster_;
  bool noise_;
};

}  // namespace fanbeam::renderer
