// The azimuth beam: what the antenna makes of power arriving from all azimuths when it points at
// each column's centre.
//
//     P(column) = integral p(az) g_az(az - az_column)^2 daz
// with p the power per radian of FanSums, constant inside a sub-column, and the squared pattern
// integrated exactly over it. Accuracy: that of the sub-columns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/casting/caster.h"
#include "sensors/sensor.h"

namespace fanbeam::renderer {

// Which blocks of bins of a fan hold something.
class FilledBlocks {
 public:
  static constexpr int kBins = 16;

  // Nothing does: `sums` become [sub-column][bin] of zeros. They must be those of the call before.
  void empty(int sub_columns, int bins, std::vector<double>& sums);
  // Bins [first, last] of a sub-column.
  void mark(int sub_column, int first, int last) {
    for (int block = first / kBins; block <= last / kBins; ++block)
      marks_[at(sub_column, block)] = 1;
  }
  bool filled(int sub_column, int block) const { return marks_[at(sub_column, block)] != 0; }

 private:
  std::size_t at(int sub_column, int block) const {
    return static_cast<std::size_t>(sub_column * blocks_ + block);
  }
  int sub_columns_ = 0, bins_ = 0, blocks_ = 0;
  std::vector<std::uint8_t> marks_;
};

// `sums` [sub-column][bin] -> [bin][column], row-major. `margin` sub-columns lie left of the first
// column's edge. `filled`, unless null, marks the blocks of `sums` that hold something.
std::vector<double> apply_azimuth_beam(const std::vector<double>& sums, int bins,
                                       const FanSums& fan, const sensors::Sensor& sensor,
                                       int sub_columns_per_column,
                                       const FilledBlocks* filled = nullptr);

}  // namespace fanbeam::renderer
