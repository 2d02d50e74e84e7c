#include "renderer/accuracy/refinement.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "renderer/accuracy/column_error.h"
#include "renderer/casting/fan_layout.h"

namespace fanbeam::renderer {
namespace {

// 256 times the samples of level 0: beyond it the reference itself is no better.
constexpr int kFinestLevel = 8;
// Two-way, the beam falls to a tenth within this many of its half-power widths.
constexpr double kBeamReach = 0.75;

double mean_factor(CasterKind caster) { return caster == CasterKind::profile ? 0.45 : 0.62; }
double old_factor(CasterKind caster) { return caster == CasterKind::profile ? 0.50 : 0.78; }

double rms(const std::vector<double>& squares) {
  const double sum = std::accumulate(squares.begin(), squares.end(), 0.0);
  return std::sqrt(sum / static_cast<double>(squares.size()));
}

// Columns that are still too coarse, and what of the fan their beam reaches.
class TooCoarse {
 public:
  TooCoarse(const sensors::Sensor& sensor, int sub_columns, const FanSums& fan)
      : sensor_(sensor),
        sub_columns_(sub_columns),
        margin_(margin_sub_columns(sensor, sub_columns)),
        groups_(static_cast<std::size_t>(fan.sub_columns) / kGroupAzimuths) {}

  std::vector<std::size_t> columns(const std::vector<double>& error2, double target_grey) const {
    std::vector<std::size_t> found;
    for (std::size_t c = 0; c < error2.size(); ++c)
      if (error2[c] > target_grey * target_grey) found.push_back(c);
    return found;
  }

  std::vector<std::uint32_t> groups(const std::vector<std::size_t>& columns) const {
    const double reach_rad = kBeamReach * sensor_.antenna.azimuth.half_power_width_rad;
    const int reach =
        static_cast<int>(std::ceil(reach_rad / sensor_.scan.column_width_rad() * sub_columns_));
    std::vector<bool> wanted(groups_, false);
    for (const std::size_t column : columns) {
      const int first = margin_ + static_cast<int>(column) * sub_columns_;
      const int from = std::max(first - reach, 0) / kGroupAzimuths;
      const int to = (first + sub_columns_ - 1 + reach) / kGroupAzimuths;
      for (int g = from; g <= std::min(to, static_cast<int>(groups_) - 1); ++g)
        wanted[static_cast<std::size_t>(g)] = true;
    }
    std::vector<std::uint32_t> found;
    for (std::size_t g = 0; g < groups_; ++g)
      if (wanted[g]) found.push_back(static_cast<std::uint32_t>(g));
    return found;
  }

 private:
  const sensors::Sensor& sensor_;
  int sub_columns_;
  int margin_;
  std::size_t groups_;
};

}  // namespace

ErrorEstimate Refinement::cast(const sensors::AntennaFrame& antenna, bool with_cscope,
                               double target_grey, FanSums& sums, SightLines& sight) const {
  const sensors::Sensor& sensor = world_.sensor;
  const ColumnError difference(sensor, sampling_.sub_columns, noise_);
  const double factor = mean_factor(sampling_.caster);
  caster_.cast(antenna, with_cscope, CastPass{}, sums, sight);
  thread_local FanSums fresh;
  const TooCoarse too_coarse(sensor, sampling_.sub_columns, sums);
  std::vector<std::uint32_t> groups = groups_of(sums);
  std::vector<std::size_t> columns(static_cast<std::size_t>(sensor.scan.columns));
  std::iota(columns.begin(), columns.end(), std::size_t{0});
  std::vector<double> error2(columns.size(), 0.0);
  SightLines none;
  for (int level = 1;; ++level) {
    fresh = sums;  // what is not cast again is the same in both pictures
    fresh.rays = fresh.slices = fresh.hits = fresh.blanked = 0;
    caster_.cast(antenna, with_cscope, CastPass{level, &groups}, fresh, none);
    const std::vector<double> apart2 = difference.mean_square_grey2(sums, fresh);
    for (const std::size_t c : columns) error2[c] = factor * factor * apart2[c];
    combine_groups(fresh, 0.5, groups, 0.5, sums);
    add_counts(fresh, sums);
    const double error_grey = rms(error2);
    if (error_grey <= target_grey) return {error_grey, level + 1, true};
    if (level == kFinestLevel) return {error_grey, level + 1, false};
    columns = too_coarse.columns(error2, target_grey);
    groups = too_coarse.groups(columns);
  }
}

ErrorEstimate Refinement::estimate(const sensors::AntennaFrame& antenna, bool with_cscope,
                                   FanSums& sums, SightLines& sight) const {
  caster_.cast(antenna, with_cscope, CastPass{}, sums, sight);
  thread_local FanSums fresh;
  fresh = sums;
  SightLines none;
  const std::vector<std::uint32_t> groups = groups_of(sums);
  caster_.cast(antenna, with_cscope, CastPass{1, &groups}, fresh, none);
  const ColumnError difference(world_.sensor, sampling_.sub_columns, noise_);
  return {old_factor(sampling_.caster) * rms(difference.mean_square_grey2(sums, fresh)), 1, true};
}

}  // namespace fanbeam::renderer
