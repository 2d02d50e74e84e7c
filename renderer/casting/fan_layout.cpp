#include "renderer/casting/fan_layout.h"

#include <cmath>
#include <numeric>

namespace fanbeam::renderer {

int margin_sub_columns(const sensors::Sensor& sensor, int sub_columns_per_column) {
  const double step_rad = sensor.scan.column_width_rad() / sub_columns_per_column;
  return static_cast<int>(std::ceil(sensor.antenna.azimuth.cut_rad / step_rad));
}

void lay_out_fan(const World& world, const Sampling& sampling, bool with_cscope, FanSums& sums) {
  const sensors::Scan& scan = world.sensor.scan;
  const int margin = margin_sub_columns(world.sensor, sampling.sub_columns);
  sums.step_rad = scan.column_width_rad() / sampling.sub_columns;
  sums.first_azimuth_rad = -scan.field_of_view_rad / 2 - margin * sums.step_rad;
  const int needed = scan.columns * sampling.sub_columns + 2 * margin;
  sums.sub_columns = (needed + kGroupAzimuths - 1) / kGroupAzimuths * kGroupAzimuths;
  sums.cells = world.sensor.range.cells;
  sums.rows = with_cscope ? world.sensor.display.cscope_rows : 0;
  const auto subs = static_cast<std::size_t>(sums.sub_columns);
  sums.range_W_per_rad.resize(subs * static_cast<std::size_t>(sums.cells));
  sums.elevation_W_m3_per_rad.resize(subs * static_cast<std::size_t>(sums.rows));
  sums.rays = sums.slices = sums.hits = sums.blanked = 0;
}

std::vector<std::uint32_t> groups_of(const FanSums& sums) {
  std::vector<std::uint32_t> groups(static_cast<std::size_t>(sums.sub_columns / kGroupAzimuths));
  std::iota(groups.begin(), groups.end(), 0U);
  return groups;
}

void combine_groups(const FanSums& other, double share, const std::vector<std::uint32_t>& groups,
                    double own, FanSums& sums) {
  const auto combine = [&](const std::vector<double>& from, int bins, std::vector<double>& to) {
    const std::size_t count = kGroupAzimuths * static_cast<std::size_t>(bins);
    for (const std::uint32_t group : groups)
      for (std::size_t i = group * count; i < (group + 1) * count; ++i)
        to[i] = own * to[i] + share * from[i];
  };
  combine(other.range_W_per_rad, sums.cells, sums.range_W_per_rad);
  combine(other.elevation_W_m3_per_rad, sums.rows, sums.elevation_W_m3_per_rad);
}

void add_counts(const FanSums& from, FanSums& to) {
  to.rays += from.rays;
  to.slices += from.slices;
  to.hits += from.hits;
  to.blanked += from.blanked;
}

}  // namespace fanbeam::renderer
