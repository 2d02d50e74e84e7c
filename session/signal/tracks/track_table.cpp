#include "session/signal/tracks/track_table.h"

#include <fmt/format.h>

#include <array>

#include "tracking/tracker/track_geometry.h"

namespace fanbeam::session {
namespace {

// Of a track along one axis: all of it lies ahead.
std::array<double, 4> on_the_road(const tracking::Track& track) {
  const tracking::Gaussian state = combined(track.state);
  if (track.state.axes == 1) return {state.mean[0], 0.0, state.mean[1], 0.0};
  return {state.mean[0], state.mean[1], state.mean[2], state.mean[3]};
}

}  // namespace

std::string track_cells(double time_s, const tracking::Track& track,
                        const RadarVelocity_mps& radar_velocity_mps) {
  const auto state = on_the_road(track);
  const tracking::PolarPlace place = polar(track.state);
  return fmt::format("{},{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{},{:.6g}", time_s,
                     track.id, track.confirmed ? 1 : 0, state[0], state[1], state[2], state[3],
                     place.range_m, place.range_rate_mps, place.azimuth_rad,
                     is_moving(track, radar_velocity_mps) ? 1 : 0, track.identity_probability);
}

// The upper triangle, row after row; of a track along one axis x is the range, and y and vy are empty.
std::string covariance_cells(const tracking::Gaussian& state) {
  std::string cells;
  for (int row = 0; row < 4; ++row)
    for (int column = row; column < 4; ++column) {
      const bool one_axis = state.size == 2;
      const bool there = !one_axis || (row % 2 == 0 && column % 2 == 0);
      cells += there ? fmt::format(",{:.9g}", one_axis ? state.variance(row / 2, column / 2)
                                                       : state.variance(row, column))
                     : std::string(",");
    }
  return cells;
}

std::string measurement_row(double time_s, const tracking::RadarMeasurement& one) {
  return fmt::format("{},{:.9g},{:.9g},{:.9g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g}\n", time_s,
                     one.range_m, one.range_rate_mps, one.azimuth_rad, one.range_sigma_m,
                     one.range_rate_sigma_mps, one.azimuth_sigma_rad, one.range_systematic_m,
                     one.range_rate_systematic_mps, one.azimuth_systematic_rad);
}

}  // namespace fanbeam::session
