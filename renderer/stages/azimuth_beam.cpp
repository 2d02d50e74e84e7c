#include "renderer/stages/azimuth_beam.h"

#include <algorithm>

#include "core/dispatch.h"
#include "core/parallel.h"
#include "renderer/casting/ray_caster.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::renderer {
namespace {

FANBEAM_HOT void add_weighted(const double* from, double weight, int count, double* to) {
  for (int i = 0; i < count; ++i) to[i] += weight * from[i];
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
  const int columns = sensor.scan.columns;
  const auto bin_count = static_cast<std::size_t>(bins);
  std::vector<double> by_column(static_cast<std::size_t>(columns) * bin_count, 0.0);
  core::parallel_for(static_cast<std::size_t>(columns), [&](std::size_t column) {
    const std::size_t first = column * static_cast<std::size_t>(sub_columns_per_column);
    for (int s = 0; s < reach; ++s)
      add_weighted(&sums[(first + static_cast<std::size_t>(s)) * bin_count],
                   weights[static_cast<std::size_t>(s)], bins, &by_column[column * bin_count]);
  });
  std::vector<double> image(by_column.size());
  const auto width = static_cast<std::size_t>(columns);
  core::parallel_for(bin_count, [&](std::size_t bin) {
    for (std::size_t column = 0; column < width; ++column)
      image[bin * width + column] = by_column[column * bin_count + bin];
  });
  return image;
}

}  // namespace fanbeam::renderer
