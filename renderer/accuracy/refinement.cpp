#include "renderer/accuracy/refinement.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "renderer/casting/fan_layout.h"
#include "renderer/stages/rain_echo.h"

namespace fanbeam::renderer {
namespace {

// 256 times the samples of level 0: beyond it the reference itself is no better.
constexpr int kFinestLevel = 8;
constexpr int kFinestBounces = 6;
// Two-way, the beam falls to a tenth within this many of its half-power widths.
constexpr double kBeamReach = 0.75;

// Of the difference between old and new samples: refinement.h.
struct Factors {
  double of_old, of_first_mean, of_later_mean;
  double of_mean(int level) const { return level == 1 ? of_first_mean : of_later_mean; }
};
constexpr Factors kSlices{0.50, 0.42, 0.50}, kRays{0.78, 0.55, 0.70}, kBounces{0.58, 0.50, 0.58};
Factors factors_of(CasterKind caster) { return caster == CasterKind::profile ? kSlices : kRays; }

double rms(const std::vector<double>& squares) {
  const double sum = std::accumulate(squares.begin(), squares.end(), 0.0);
  return std::sqrt(sum / static_cast<double>(squares.size()));
}

ErrorEstimate estimate_of(const ColumnError::Squares& squares, double factor, int levels) {
  return {factor * rms(squares.bscope_grey2), factor * rms(squares.cscope_grey2), levels, true};
}

// Of errors that have nothing to do with each other.
ErrorEstimate together(const ErrorEstimate& one, const ErrorEstimate& other) {
  return {std::hypot(one.rms_grey, other.rms_grey),
          std::hypot(one.cscope_rms_grey, other.cscope_rms_grey),
          std::max(one.levels, other.levels), one.reached && other.reached};
}

FanSums empty_like(const FanSums& fan) {
  FanSums empty = fan;
  std::fill(empty.range_W_per_rad.begin(), empty.range_W_per_rad.end(), 0.0);
  std::fill(empty.elevation_W_m3_per_rad.begin(), empty.elevation_W_m3_per_rad.end(), 0.0);
  empty.rays = empty.slices = empty.hits = empty.blanked = 0;
  return empty;
}

FanSums plus(FanSums sums, const FanSums& more) {
  combine_groups(more, 1.0, groups_of(sums), 1.0, sums);
  add_counts(more, sums);
  return sums;
}

// Columns that are still too coarse, and what of the fan their beam reaches.
class TooCoarse {
 public:
  TooCoarse(const sensors::Sensor& sensor, int sub_columns, const FanSums& fan)
      : sensor_(sensor),
        sub_columns_(sub_columns),
        margin_(margin_sub_columns(sensor, sub_columns)),
        groups_(static_cast<std::size_t>(fan.sub_columns) / kGroupAzimuths) {}

  std::vector<std::size_t> columns(const ColumnError::Squares& error, double target_grey) const {
    std::vector<std::size_t> found;
    for (std::size_t c = 0; c < error.bscope_grey2.size(); ++c)
      if (std::max(error.bscope_grey2[c], error.cscope_grey2[c]) > target_grey * target_grey)
        found.push_back(c);
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
                               FanSums& sums, SightLines& sight) const {
  const bool refined = sampling_.target_grey > 0.0;
  caster_.cast(antenna, with_cscope, CastPass{0, nullptr, refined}, sums, sight);
  ColumnError difference(world_.sensor, sampling_.sub_columns, effects_.thermal_noise);
  if (effects_.rain_echo && world_.volume_echo) {
    FanSums rain = empty_like(sums);
    add_rain_echo(world_, antenna, sampling_.sub_columns, rain);
    difference.put_under(rain);
  }
  const double target_grey = sampling_.target_grey * (bounces_ != nullptr ? std::sqrt(0.5) : 1.0);
  ErrorEstimate error = refined ? refine(antenna, with_cscope, difference, target_grey, sums)
                                : estimate(antenna, with_cscope, difference, sums);
  if (bounces_ != nullptr)
    error = together(error, add_bounces(antenna, difference, target_grey, sums));
  return error;
}

ErrorEstimate Refinement::refine(const sensors::AntennaFrame& antenna, bool with_cscope,
                                 const ColumnError& difference, double target_grey,
                                 FanSums& sums) const {
  const sensors::Sensor& sensor = world_.sensor;
  const TooCoarse too_coarse(sensor, sampling_.sub_columns, sums);
  std::vector<std::uint32_t> groups = groups_of(sums);
  std::vector<std::size_t> columns(static_cast<std::size_t>(sensor.scan.columns));
  std::iota(columns.begin(), columns.end(), std::size_t{0});
  ColumnError::Squares error{std::vector<double>(columns.size(), 0.0),
                             std::vector<double>(columns.size(), 0.0)};
  thread_local FanSums fresh;
  SightLines none;
  for (int level = 1;; ++level) {
    fresh = sums;  // what is not cast again is the same in both pictures
    caster_.cast(antenna, with_cscope, CastPass{level, &groups, true}, fresh, none);
    const ColumnError::Squares apart = difference.between(sums, fresh);
    const double factor = factors_of(sampling_.caster).of_mean(level);
    for (const std::size_t c : columns) {
      error.bscope_grey2[c] = factor * factor * apart.bscope_grey2[c];
      error.cscope_grey2[c] = factor * factor * apart.cscope_grey2[c];
    }
    combine_groups(fresh, 0.5, groups, 0.5, sums);
    add_counts(fresh, sums);
    ErrorEstimate reached = estimate_of(error, 1.0, level + 1);
    reached.reached = reached.largest_grey() <= target_grey;
    if (reached.reached || level == kFinestLevel) return reached;
    columns = too_coarse.columns(error, target_grey);
    groups = too_coarse.groups(columns);
  }
}

ErrorEstimate Refinement::estimate(const sensors::AntennaFrame& antenna, bool with_cscope,
                                   const ColumnError& difference, const FanSums& sums) const {
  thread_local FanSums fresh;
  fresh = sums;
  SightLines none;
  caster_.cast(antenna, with_cscope, CastPass{1, nullptr}, fresh, none);
  return estimate_of(difference.between(sums, fresh), factors_of(sampling_.caster).of_old, 1);
}

ErrorEstimate Refinement::add_bounces(const sensors::AntennaFrame& antenna,
                                      const ColumnError& difference, double target_grey,
                                      FanSums& sums) const {
  if (!(target_grey > 0.0)) {
    // Added as a frame without an estimate does it, to the last bit.
    FanSums fresh = sums;
    bounces_->add(antenna, sums);
    bounces_->add(antenna, fresh, 1);
    return estimate_of(difference.between(sums, fresh), kBounces.of_old, 1);
  }
  FanSums echoes = empty_like(sums);
  bounces_->add(antenna, echoes);
  for (int level = 1;; ++level) {
    FanSums fresh = empty_like(sums);
    bounces_->add(antenna, fresh, level);
    const ColumnError::Squares apart = difference.between(plus(sums, echoes), plus(sums, fresh));
    combine_groups(fresh, 0.5, groups_of(sums), 0.5, echoes);
    add_counts(fresh, echoes);
    ErrorEstimate reached = estimate_of(apart, kBounces.of_mean(level), level + 1);
    reached.reached = reached.largest_grey() <= target_grey;
    if (!reached.reached && level < kFinestBounces) continue;
    sums = plus(std::move(sums), echoes);
    return reached;
  }
}

}  // namespace fanbeam::renderer
