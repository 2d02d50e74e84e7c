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

constexpr std::size_t kBlockBins = FilledBlocks::kBins;
constexpr std::size_t kBeamColumns = 4;  // columns

// The two-way pattern over the sub-columns that a column reaches, from left to right, between zeros
// for those that only its neighbours on either side reach.
struct BeamWeights {
  std::vector<double> of_sub_column;
  std::size_t apart;  // sub-columns from a column to the next
  std::size_t reach;

  std::size_t zeros() const { return (kBeamColumns - 1) * apart; }
};

BeamWeights weights_of(const FanSums& fan, const sensors::Sensor& sensor,
                       int sub_columns_per_column) {
  const int margin = margin_sub_columns(sensor, sub_columns_per_column);
  BeamWeights beam;
  beam.apart = static_cast<std::size_t>(sub_columns_per_column);
  beam.reach = static_cast<std::size_t>(2 * margin + sub_columns_per_column);
  beam.of_sub_column.assign(beam.reach + 2 * beam.zeros(), 0.0);
  // The same for every column: sub-column s of a column's reach begins this far from the column's
  // centre.
  for (std::size_t s = 0; s < beam.reach; ++s) {
    const double from_rad =
        (static_cast<int>(s) - margin - sub_columns_per_column / 2.0) * fan.step_rad;
    beam.of_sub_column[beam.zeros() + s] =
        sensors::two_way_integral(sensor.antenna.azimuth, from_rad, from_rad + fan.step_rad);
  }
  return beam;
}

// A block of bins of neighbouring columns: weights times bins, `stride` apart, from the left one's
// first sub-column on. What they reach is read once, and eight sums of kLanes bins stay in registers,
// which the compiler does not find by itself.
template <std::size_t kLanes>
[[gnu::always_inline]] inline void weigh_by(const double* from, std::size_t stride,
                                            const double* weights, std::size_t apart,
                                            std::size_t reached, double* sums) {
  using Lanes [[gnu::vector_size(kLanes * sizeof(double))]] = double;
  constexpr std::size_t kParts = 2;
  for (std::size_t bin = 0; bin < kBlockBins; bin += kParts * kLanes) {
    Lanes sum[kBeamColumns][kParts] = {};
    const double* at = from + bin;
    for (std::size_t s = 0; s < reached; ++s, at += stride) {
      for (std::size_t part = 0; part < kParts; ++part) {
        Lanes bins;
        std::memcpy(&bins, at + kLanes * part, sizeof bins);
        for (std::size_t column = 0; column < kBeamColumns; ++column)
          sum[column][part] += weights[s + (kBeamColumns - 1 - column) * apart] * bins;
      }
    }
    for (std::size_t column = 0; column < kBeamColumns; ++column)
      std::memcpy(sums + column * kBlockBins + bin, sum[column], sizeof sum[column]);
  }
}

// Vectors as wide as the level's registers: wider ones would live in memory, ten to thirty times as slow.
FANBEAM_HOT(void, weigh_together,
            (const double* from, std::size_t stride, const double* weights, std::size_t apart,
             std::size_t reached, double* sums),
            (from, stride, weights, apart, reached, sums)) {
#if defined(FANBEAM_ONE_LEVEL)
  return weigh_by<2>(from, stride, weights, apart, reached, sums);
#else
  switch (core::instruction_level()) {  // again: a body is one text for all levels
    case core::InstructionLevel::v4:
      return weigh_by<8>(from, stride, weights, apart, reached, sums);
    case core::InstructionLevel::v3:
      return weigh_by<4>(from, stride, weights, apart, reached, sums);
    default:
      return weigh_by<2>(from, stride, weights, apart, reached, sums);
  }
#endif
}

// Fewer bins or columns.
void weigh_one(const double* from, std::size_t stride, std::size_t bins, const BeamWeights& beam,
               double* sums) {
  std::fill_n(sums, bins, 0.0);
  for (std::size_t s = 0; s < beam.reach; ++s, from += stride) {
    const double weight = beam.of_sub_column[beam.zeros() + s];
    for (std::size_t bin = 0; bin < bins; ++bin) sums[bin] += weight * from[bin];
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
  const auto columns = static_cast<std::size_t>(sensor.scan.columns);
  const auto bin_count = static_cast<std::size_t>(bins);
  const std::size_t block_bins = std::min(kBlockBins, bin_count);
  const std::size_t together = std::min(kBeamColumns, columns);
  const std::size_t reached = beam.reach + (together - 1) * beam.apart;
  std::vector<double> image(columns * bin_count);
  // Block after block of bins for all columns: what columns share stays in the cache. The last block
  // moves back over the one before rather than be a shorter one, and so do the last columns.
  core::parallel_for((bin_count + kBlockBins - 1) / kBlockBins, [&](std::size_t block) {
    const std::size_t begin = std::min(block * kBlockBins, bin_count - block_bins);
    for (std::size_t c = 0; c < columns; c += kBeamColumns) {
      const std::size_t column = std::min(c, columns - together), first = column * beam.apart;
      if (filled != nullptr && !any_filled(*filled, first, first + reached, block)) continue;
      const double* const from = sums.data() + first * bin_count + begin;
      double weighed[kBeamColumns * kBlockBins];
      if (block_bins == kBlockBins && together == kBeamColumns) {
        weigh_together(from, bin_count, beam.of_sub_column.data(), beam.apart, reached, weighed);
      } else {
        for (std::size_t i = 0; i < together; ++i)
          weigh_one(from + i * beam.apart * bin_count, bin_count, block_bins, beam,
                    weighed + i * kBlockBins);
      }
      for (std::size_t i = 0; i < together; ++i)
        for (std::size_t bin = block * kBlockBins - begin; bin < block_bins; ++bin)
          image[(begin + bin) * columns + column + i] = weighed[i * kBlockBins + bin];
    }
  });
  return image;
}

}  // namespace fanbeam::renderer
