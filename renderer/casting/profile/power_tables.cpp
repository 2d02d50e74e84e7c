#include "renderer/casting/profile/power_tables.h"

#include <algorithm>
#include <cmath>

#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::renderer {

PowerTables::PowerTables(const World& world) {
  for (const NrcsTable& table : world.nrcs.tables())
    nrcs_.insert(nrcs_.end(), table.values(), table.values() + NrcsTable::kEntries);
  const sensors::Antenna& antenna = world.sensor.antenna;
  const sensors::Display& display = world.sensor.display;
  const sensors::TwoWayTable gain(antenna.elevation);
  const double reach_rad = sensors::reach_rad(antenna.elevation);
  const double lowest_rad = std::max(antenna.boresight_elevation_rad - reach_rad, -core::kPi / 2);
  const double highest_rad = std::min(antenna.boresight_elevation_rad + reach_rad, core::kPi / 2);
  lowest_sine_ = std::sin(lowest_rad);
  highest_sine_ = std::sin(highest_rad);
  top_rad_ = display.cscope_top_rad;
  rows_per_rad_ = display.cscope_rows / display.cscope_span_rad;
  steps_per_sine_ = kSineSteps / (highest_sine_ - lowest_sine_);
  // One more than the last: who interpolates there looks at the next.
  for (int i = 0; i <= kSineSteps + 1; ++i) {
    const double sine =
        std::clamp(lowest_sine_ + std::min(i, kSineSteps) / steps_per_sine_, -1.0, 1.0);
    const double elevation_rad = std::asin(sine);
    // Nothing beyond the pattern: what lies there is held to the first and last entry. A pattern
    // that reaches straight down or up has no such end.
    const bool edge =
        (i == 0 && lowest_rad > -core::kPi / 2) || (i >= kSineSteps && highest_rad < core::kPi / 2);
    even_gain_.push_back(1.0);
    gain_.push_back(edge ? 0.0 : gain(elevation_rad - antenna.boresight_elevation_rad));
    row_.push_back((display.cscope_top_rad - elevation_rad) * rows_per_rad_);
  }
}

double PowerTables::look_up(const std::vector<double>& table, double sine) const {
  const double at = std::clamp((sine - lowest_sine_) * steps_per_sine_, 0.0, double{kSineSteps});
  const auto step = static_cast<std::size_t>(at);
  return table[step] + (at - static_cast<double>(step)) * (table[step + 1] - table[step]);
}

}  // namespace fanbeam::renderer
