#include "signal/transform/top_view.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/constants.h"
#include "core/parallel.h"
#include "signal/checks_private.h"

namespace fanbeam::signal {
namespace {

void check_input(const PowerMap& map, const std::vector<double>& azimuths_rad, double range_step_m,
                 const TopViewGrid& grid) {
  if (azimuths_rad.size() != static_cast<std::size_t>(map.rows) || azimuths_rad.empty())
    refuse("azimuths_rad", static_cast<double>(azimuths_rad.size()), "one per row of the map");
  for (std::size_t i = 1; i < azimuths_rad.size(); ++i)
    if (!(azimuths_rad[i] > azimuths_rad[i - 1]))
      refuse("azimuths_rad", azimuths_rad[i], "increasing values");
  check_positive("range_step_m", range_step_m);
  check_positive("step_m", grid.step_m);
  if (grid.rows < 1 || grid.columns < 1)
    refuse("grid", std::min(grid.rows, grid.columns), "at least one row and column");
}

double between(double low, double high, double part) { return low + part * (high - low); }

double power_at(const PowerMap& map, const std::vector<double>& azimuths_rad, double azimuth_rad,
                double range_cell) {
  const bool closed = azimuths_rad.front() <= -0.5 * core::kPi * (1.0 - 1e-12);
  const double last_rad = closed ? 0.5 * core::kPi : azimuths_rad.back();
  if (azimuth_rad < azimuths_rad.front() || azimuth_rad > last_rad || range_cell > map.columns - 1)
    return 0.0;
  const auto above = std::upper_bound(azimuths_rad.begin(), azimuths_rad.end(), azimuth_rad);
  const bool wraps = above == azimuths_rad.end() && closed;
  const int next =
      std::min(static_cast<int>(std::distance(azimuths_rad.begin(), above)), map.rows - 1);
  const int low = wraps ? map.rows - 1 : std::max(0, next - 1);
  const int high = wraps ? 0 : next;
  const double low_rad = azimuths_rad[static_cast<std::size_t>(low)];
  const double high_rad = wraps ? last_rad : azimuths_rad[static_cast<std::size_t>(high)];
  const double part = high_rad > low_rad ? (azimuth_rad - low_rad) / (high_rad - low_rad) : 0.0;
  const int near = std::min(static_cast<int>(range_cell), std::max(0, map.columns - 2));
  const int far = std::min(near + 1, map.columns - 1);
  const double beyond = range_cell - near;
  return between(between(map.at(low, near), map.at(low, far), beyond),
                 between(map.at(high, near), map.at(high, far), beyond), part);
}

}  // namespace

PowerMap top_view(const PowerMap& range_azimuth, const std::vector<double>& azimuths_rad,
                  double range_step_m, const TopViewGrid& grid) {
  check_input(range_azimuth, azimuths_rad, range_step_m, grid);
  PowerMap view(grid.rows, grid.columns);
  core::parallel_for(static_cast<std::size_t>(grid.rows), [&](std::size_t index) {
    const int row = static_cast<int>(index);
    const double forward_m = grid.nearest_m + row * grid.step_m;
    for (int column = 0; column < grid.columns; ++column) {
      const double right_m = grid.leftmost_m + column * grid.step_m;
      view.at(row, column) = power_at(range_azimuth, azimuths_rad, std::atan2(right_m, forward_m),
                                      std::hypot(right_m, forward_m) / range_step_m);
    }
  });
  return view;
}

}  // namespace fanbeam::signal
