#include "renderer/stages/azimuth_beam.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "core/dispatch.h"
#include "core/parallel.h"
#include "renderer/casting/ray_caster.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::renderer {
namespace {

// Four bins side by side: the compiler does not find by itself that a block's sums fit registers.
using FourBins = double __attribute__((vector_size(32)));
constexpr int kFours = 4;
constexpr std::size_t kBlockBins = 4 * kFours;

// Sums weight times bins over `reach` sub-columns, `stride` apart; a block of bins from `from` on.
FANBEAM_HOT void weigh_block(const double* from, std::size_t stride, const double* weights,
                             std::size_t reach, double* sums) {
  FourBins sum[kFours] = {};
  for (std::size_t s = 0; s < reach; ++s, from += stride) {
    for (int i = 0; i < kFours; ++i) {
      FourBins bins;
      std::memcpy(&bins, from + 4 * i, sizeof bins);
      sum[i] += weights[s] * bins;
    }
  }
  std::memcpy(sums, sum, sizeof sum);
}

}  // namespace

std::vector<double> apply_azimuth_beam(const std::vector<double>& sums, int bins,
                                       const FanSums& fan, const sensors::Sensor& sensor,
                                       int sub_columns_per_column) {
  const int margin = margin_sub_columns(sensor, sub_columns_per_column);
  const int reach = 2 * margin + sub_columns_per_column;
  // The same for every column: sub-column s of a column's reach begins this far from the column's
  // centre.
  std::vector<double> weights;
  for (int s = 0; s < reach; ++s) {
    const double from_rad = (s - margin - sub_columns_per_column / 2.0) * fan.step_rad;
    weights.push_back(
        sensors::two_way_integral(sensor.antenna.azimuth, from_rad, from_rad + fan.step_rad));
  }
  const auto columns = static_cast<std::size_t>(sensor.scan.columns);
  const auto bin_count = static_cast<std::size_t>(bins);
  std::vector<double> image(columns * bin_count);
  // Block after block of bins for all columns: what columns share stays in the cache.
  core::parallel_for((bin_count + kBlockBins - 1) / kBlockBins, [&](std::size_t block) {
    // The last block moves back over the one before rather than be a shorter one.
    const std::size_t begin =
        std::min(block * kBlockBins, bin_count - std::min(kBlockBins, bin_count));
    for (std::size_t column = 0; column < columns; ++column) {
      const double* const from =
          sums.data() + column * static_cast<std::size_t>(sub_columns_per_column) * bin_count;
      double sum[kBlockBins] = {};
      if (bin_count >= kBlockBins) {
        weigh_block(from + begin, bin_count, weights.data(), weights.size(), sum);
      } else {
        for (std::size_t s = 0; s < weights.size(); ++s)
          for (std::size_t bin = 0; bin < bin_count; ++bin)
            sum[bin] += weights[s] * from[s * bin_count + bin];
      }
      const std::size_t first = block * kBlockBins;
      for (std::size_t bin = first; bin < std::min(first + kBlockBins, bin_count); ++bin)
        image[bin * columns + column] = sum[bin - begin];
    }
  });
  return image;
}

}  // namespace fanbeam::renderer
