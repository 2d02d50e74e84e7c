#include "renderer/stages/azimuth_beam.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "core/dispatch.h"
#include "core/parallel.h"
#include "renderer/casting/fan_layout.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::renderer {
namespace {

// Four bins side by side: the compiler does not find by itself that a block's sums fit registers.
using FourBins = double __attribute__((vector_size(32)));
constexpr int kFours = 4;
constexpr std::size_t kBlockBins = 4 * kFours;
static_assert(kBlockBins == FilledBlocks::kBins);

// The two-way pattern over the sub-columns that a column reaches, from left to right.
struct BeamWeights {
  std::vector<double> of_sub_column;
  std::size_t sub_columns_per_column;
};

BeamWeights weights_of(const FanSums& fan, const sensors::Sensor& sensor,
                       int sub_columns_per_column) {
  const int margin = margin_sub_columns(sensor, sub_columns_per_column);
  BeamWeights beam;
  beam.sub_columns_per_column = static_cast<std::size_t>(sub_columns_per_column);
  // The same for every column: sub-column s of a column's reach begins this far from the column's
  // centre.
  for (int s = 0; s < 2 * margin + sub_columns_per_column; ++s) {
    const double from_rad = (s - margin - sub_columns_per_column / 2.0) * fan.step_rad;
    beam.of_sub_column.push_back(
        sensors::two_way_integral(sensor.antenna.azimuth, from_rad, from_rad + fan.step_rad));
  }
  return beam;
}

// A block of bins of two neighbouring columns: weights times bins, `stride` apart, from the left
// one's first sub-column on. What both reach is read once.
FANBEAM_HOT(void, weigh_two,
            (const double* from, std::size_t stride, const double* weights, std::size_t reach,
             std::size_t apart, double* left, double* right),
            (from, stride, weights, reach, apart, left, right)) {
  FourBins left_sum[kFours] = {}, right_sum[kFours] = {};
  std::size_t s = 0;
  for (; s < apart; ++s, from += stride) {
    for (int i = 0; i < kFours; ++i) {
      FourBins bins;
      std::memcpy(&bins, from + 4 * i, sizeof bins);
      left_sum[i] += weights[s] * bins;
    }
  }
  for (; s < reach; ++s, from += stride) {
    for (int i = 0; i < kFours; ++i) {
      FourBins bins;
      std::memcpy(&bins, from + 4 * i, sizeof bins);
      left_sum[i] += weights[s] * bins;
      right_sum[i] += weights[s - apart] * bins;
    }
  }
  for (; s < reach + apart; ++s, from += stride) {
    for (int i = 0; i < kFours; ++i) {
      FourBins bins;
      std::memcpy(&bins, from + 4 * i, sizeof bins);
      right_sum[i] += weights[s - apart] * bins;
    }
  }
  std::memcpy(left, left_sum, sizeof left_sum);
  std::memcpy(right, right_sum, sizeof right_sum);
}

// Fewer bins, or a single column.
void weigh_one(const double* from, std::size_t stride, std::size_t bins, const BeamWeights& beam,
               double* sums) {
  std::fill_n(sums, bins, 0.0);
  for (const double weight : beam.of_sub_column) {
    for (std::size_t bin = 0; bin < bins; ++bin) sums[bin] += weight * from[bin];
    from += stride;
  }
}

// Whether any of sub-columns [first, last) holds something in a block.
bool any_filled(const FilledBlocks& filled, std::size_t first, std::size_t last,
                std::size_t block) {
  for (std::size_t s = first; s < last; ++s)
    if (filled.filled(static_cast<int>(s), static_cast<int>(block))) return true;
  return false;
}

}  // namespace

void FilledBlocks::empty(int sub_columns, int bins, std::vector<double>& sums) {
  const auto stride = static_cast<std::size_t>(bins);
  if (sub_columns != sub_columns_ || bins != bins_) {
    // Whoever is thrown out of here finds another shape next time.
    sub_columns_ = 0;
    sums.assign(static_cast<std::size_t>(sub_columns) * stride, 0.0);
    blocks_ = (bins + kBins - 1) / kBins;
    marks_.assign(at(sub_columns, 0), 0);
    bins_ = bins;
    sub_columns_ = sub_columns;
  } else {
    for (int s = 0; s < sub_columns; ++s)
      for (int block = 0; block < blocks_; ++block)
        if (filled(s, block))
          std::fill_n(sums.data() + static_cast<std::size_t>(s) * stride + block * kBins,
                      std::min(kBins, bins - block * kBins), 0.0);
  }
  marks_.assign(at(sub_columns, 0), 0);
}

std::vector<double> apply_azimuth_beam(const std::vector<double>& sums, int bins,
                                       const FanSums& fan, const sensors::Sensor& sensor,
                                       int sub_columns_per_column, const FilledBlocks* filled) {
  const BeamWeights beam = weights_of(fan, sensor, sub_columns_per_column);
  const std::size_t apart = beam.sub_columns_per_column, reach = beam.of_sub_column.size();
  const auto columns = static_cast<std::size_t>(sensor.scan.columns);
  const auto bin_count = static_cast<std::size_t>(bins);
  const auto sub_columns = static_cast<std::size_t>(fan.sub_columns);
  const std::size_t block_bins = std::min(kBlockBins, bin_count);
  std::vector<double> image(columns * bin_count);
  // Block after block of bins for all columns: what columns share stays in the cache.
  core::parallel_for((bin_count + kBlockBins - 1) / kBlockBins, [&](std::size_t block) {
    // The last block moves back over the one before rather than be a shorter one.
    const std::size_t begin = std::min(block * kBlockBins, bin_count - block_bins);
    const auto put = [&](const double* sum, std::size_t column) {
      for (std::size_t bin = block * kBlockBins - begin; bin < block_bins; ++bin)
        image[(begin + bin) * columns + column] = sum[bin];
    };
    for (std::size_t column = 0; column < columns; column += 2) {
      const std::size_t reached = std::min((column + 1) * apart + reach, sub_columns);
      if (filled != nullptr && !any_filled(*filled, column * apart, reached, block)) continue;
      const double* const from = sums.data() + column * apart * bin_count + begin;
      double left[kBlockBins], right[kBlockBins];
      if (block_bins == kBlockBins && column + 1 < columns) {
        weigh_two(from, bin_count, beam.of_sub_column.data(), reach, apart, left, right);
        put(left, column);
        put(right, column + 1);
      } else {
        for (std::size_t c = column; c < std::min(column + 2, columns); ++c) {
          weigh_one(from + (c - column) * apart * bin_count, bin_count, block_bins, beam, left);
          put(left, c);
        }
      }
    }
  });
  return image;
}

}  // namespace fanbeam::renderer
