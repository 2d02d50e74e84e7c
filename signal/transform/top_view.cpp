#include "signal/transform/top_view.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/constants.h"
#include "core/parallel.h"
#include "signal/checks_private.h"

namespace fanbeam::signal {
namespace {

// By its sine, which does not feel how the pitch was rounded.
int end_fire_side(double azimuth_rad) {
  const double sine = std::sin(azimuth_rad);
  return std::abs(sine) < 1.0 - 1e-9 ? 0 : sine > 0.0 ? 1 : -1;
}

bool both_at_end_fire(const std::vector<double>& azimuths_rad, std::size_t second) {
  const int side = end_fire_side(azimuths_rad[second]);
  return side != 0 && side == end_fire_side(azimuths_rad[second - 1]);
}

void check_input(const PowerMap& map, const std::vector<double>& azimuths_rad, double range_step_m,
                 const TopViewGrid& grid) {
  if (azimuths_rad.size() != static_cast<std::size_t>(map.rows) || azimuths_rad.empty())
    refuse("azimuths_rad", static_cast<double>(azimuths_rad.size()), "one per row of the map");
  for (std::size_t i = 1; i < azimuths_rad.size(); ++i)
    if (!(azimuths_rad[i] > azimuths_rad[i - 1]) && !both_at_end_fire(azimuths_rad, i))
      refuse("azimuths_rad", azimuths_rad[i], "increasing values");
  check_positive("range_step_m", range_step_m);
  check_positive("step_m", grid.step_m);
  if (grid.rows < 1 || grid.columns < 1)
    refuse("grid", std::min(grid.rows, grid.columns), "at least one row and column");
}

double between(double low, double high, double part) { return low + part * (high - low); }

// The rows from -90 to 90 deg: of those beyond end-fire the innermost alone.
struct VisibleRows {
  int first = 0, last = 0;
  bool closed = false;  // what comes after the last is the first again, at 90 deg
};

VisibleRows visible_rows(const std::vector<double>& azimuths_rad) {
  const int rows = static_cast<int>(azimuths_rad.size());
  const auto side = [&](int row) {
    return end_fire_side(azimuths_rad[static_cast<std::size_t>(row)]);
  };
  VisibleRows visible{0, rows - 1, false};
  while (visible.first + 1 < rows && side(visible.first + 1) < 0) ++visible.first;
  while (visible.last > visible.first && side(visible.last - 1) > 0) --visible.last;
  visible.closed = side(visible.first) < 0 && side(visible.last) <= 0;
  return visible;
}

double power_at(const PowerMap& map, const std::vector<double>& azimuths_rad,
                const VisibleRows& visible, double azimuth_rad, double range_cell) {
  const auto azimuth_of = [&](int row) { return azimuths_rad[static_cast<std::size_t>(row)]; };
  constexpr double kEnd_rad = 0.5 * core::kPi;
  const double first_rad = visible.closed ? -kEnd_rad : azimuth_of(visible.first);
  const double last_rad = visible.closed ? kEnd_rad : azimuth_of(visible.last);
  if (azimuth_rad < first_rad || azimuth_rad > last_rad || range_cell > map.columns - 1) return 0.0;
  const auto begin = azimuths_rad.begin();
  const int above = static_cast<int>(std::distance(
      begin, std::upper_bound(begin + visible.first, begin + visible.last + 1, azimuth_rad)));
  const bool wraps = above > visible.last && visible.closed;
  const int next = std::min(above, visible.last);
  const int low = wraps ? visible.last : std::max(visible.first, next - 1);
  const int high = wraps ? visible.first : next;
  const double low_rad = azimuth_of(low), high_rad = wraps ? last_rad : azimuth_of(high);
  const double part =
      high_rad > low_rad ? std::max(0.0, (azimuth_rad - low_rad) / (high_rad - low_rad)) : 0.0;
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
  const VisibleRows visible = visible_rows(azimuths_rad);
  PowerMap view(grid.rows, grid.columns);
  core::parallel_for(static_cast<std::size_t>(grid.rows), [&](std::size_t index) {
    const int row = static_cast<int>(index);
    const double forward_m = grid.nearest_m + row * grid.step_m;
    for (int column = 0; column < grid.columns; ++column) {
      const double right_m = grid.leftmost_m + column * grid.step_m;
      view.at(row, column) =
          power_at(range_azimuth, azimuths_rad, visible, std::atan2(right_m, forward_m),
                   std::hypot(right_m, forward_m) / range_step_m);
    }
  });
  return view;
}

}  // namespace fanbeam::signal
