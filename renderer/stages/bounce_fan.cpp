#include "renderer/stages/bounce_fan.h"

#include <algorithm>
#include <cmath>

namespace fanbeam::renderer {
namespace {

void mark(const double* from_and_to, int sub_column, int bins, FilledBlocks& blocks) {
  const double last = bins - 1.0;
  if (!(from_and_to[1] >= 0.0) || !(from_and_to[0] <= last + 1.0)) return;
  blocks.mark(sub_column, static_cast<int>(std::clamp(from_and_to[0], 0.0, last)),
              static_cast<int>(std::clamp(from_and_to[1], 0.0, last)));
}

}  // namespace

void BounceFan::lay_out(const FanSums& fan) {
  sums_.sub_columns = fan.sub_columns;
  sums_.first_azimuth_rad = fan.first_azimuth_rad;
  sums_.step_rad = fan.step_rad;
  sums_.cells = fan.cells;
  sums_.rows = fan.rows;
  ranges_.empty(fan.sub_columns, fan.cells, sums_.range_W_per_rad);
  rows_.empty(fan.sub_columns, fan.rows, sums_.elevation_W_m3_per_rad);
}

void BounceFan::add(const BounceShare& share) {
  share.deposit_in(sums_);
  mark(share.cells, share.sub_column, sums_.cells, ranges_);
  if (sums_.rows > 0) mark(share.rows, share.sub_column, sums_.rows, rows_);
}

}  // namespace fanbeam::renderer
