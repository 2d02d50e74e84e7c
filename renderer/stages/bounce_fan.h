// What bounces alone add to a fan: next to nothing of it over most scenes, so blocks of bins that hold
// something are marked, and the others cost nothing.
#pragma once

#include "renderer/casting/caster.h"
#include "renderer/stages/azimuth_beam.h"
#include "renderer/stages/bounce_strip.h"

namespace fanbeam::renderer {

class BounceFan {
 public:
  // As wide as `fan`, and empty.
  void lay_out(const FanSums& fan);
  // Sub-columns of different numbers may be added to at once.
  void add(const BounceShare& share);

  const FanSums& sums() const { return sums_; }
  const FilledBlocks& ranges() const { return ranges_; }
  const FilledBlocks& rows() const { return rows_; }

 private:
  FanSums sums_;
  FilledBlocks ranges_, rows_;
};

}  // namespace fanbeam::renderer
