#include "session/signal/spectrogram.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "session/signal/spectrum.h"

namespace fanbeam::session {
namespace {

constexpr double kAbout_m = 1.5;  // of a target's range, to either side

constexpr double kClear_dB = 15.0;  // over the noise

// From the fastest cell on either side that stands out, and a quarter more; all where none does.
std::pair<int, int> shown_rows(const signal::PowerMap& map, double least_dBm) {
  int furthest = 0;
  const int rest = map.rows / 2;
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column)
      if (dBm(map.at(row, column)) >= least_dBm)
        furthest = std::max(furthest, std::abs(row - rest));
  if (furthest == 0) return {0, map.rows - 1};
  const int reach = furthest + furthest / 4 + 4;
  return {std::max(0, rest - reach), std::min(map.rows - 1, rest + reach)};
}

}  // namespace

void Spectrogram::add(double time_s, const FmcwFrame& frame,
                      const std::vector<double>& target_ranges_m) {
  const signal::PowerMap& map = frame.range_doppler;
  std::vector<double> column(static_cast<std::size_t>(map.rows), 0.0);
  std::vector<std::pair<int, int>> gates;
  if (target_.empty()) gates.emplace_back(0, map.columns - 1);
  for (const double range_m : target_ranges_m) {
    const double step_m = radar_.axes.range_step_m;
    gates.emplace_back(
        std::max(0, static_cast<int>(std::floor((range_m - kAbout_m) / step_m))),
        std::min(map.columns - 1, static_cast<int>(std::ceil((range_m + kAbout_m) / step_m))));
  }
  for (const auto& [first, last] : gates)
    for (int row = 0; row < map.rows; ++row)
      for (int cell = first; cell <= last; ++cell)
        column[static_cast<std::size_t>(row)] =
            std::max(column[static_cast<std::size_t>(row)], map.at(row, cell));
  times_s_.push_back(time_s);
  columns_W_.push_back(std::move(column));
}

signal::PowerMap Spectrogram::powers() const {
  signal::PowerMap map(static_cast<int>(columns_W_.front().size()), columns());
  for (int column = 0; column < map.columns; ++column)
    for (int row = 0; row < map.rows; ++row)
      map.at(row, column) =
          columns_W_[static_cast<std::size_t>(column)][static_cast<std::size_t>(row)];
  return map;
}

HeatMap Spectrogram::picture(const std::string& scene, double dynamic_range_dB) const {
  const signal::PowerMap map = powers();
  HeatMap picture;
  picture.title = scene + ": speeds over time" +
                  (target_.empty() ? std::string() : ", within 1.5 m of the range of " + target_);
  const double step_s = times_s_.size() < 2 ? 1.0
                                            : (times_s_.back() - times_s_.front()) /
                                                  static_cast<double>(times_s_.size() - 1);
  picture.x = {"time, s", times_s_.front(), step_s, map.columns, {}};
  picture.low = std::round(dBm(radar_.noise_cell_W * radar_.array.channels()));
  const auto [first, last] = shown_rows(map, picture.low + kClear_dB);
  picture.y = {"radial speed, m/s (receding is up)",
               radar_.axes.speed_mps(first),
               radar_.axes.speed_mps(1.0) - radar_.axes.speed_mps(0.0),
               last - first + 1,
               {}};
  for (int row = first; row <= last; ++row)
    for (int column = 0; column < map.columns; ++column)
      picture.values.push_back(dBm(map.at(row, column)));
  picture.value_label = "received power, dBm";
  picture.high = picture.low + dynamic_range_dB;
  return picture;
}

}  // namespace fanbeam::session
