#include "renderer/accuracy/refinement.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "renderer/casting/fan_layout.h"
#include "renderer/casting/profile/profile_caster.h"
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
  double of_old, of_first_new, of_later_new;
  double share;  // of the new samples in the new picture
  double of_new(int level) const { return level == 1 ? of_first_new : of_later_new; }
};
constexpr Factors kSlices{1.0, 0.5, 0.5, 1.0}, kRays{0.78, 0.55, 0.70, 0.5};
constexpr Factors kBounces{0.85, 0.55, 0.55, 1.0};
Factors factors_of(CasterKind caster) { return caster == CasterKind::profile ? kSlices : kRays; }

double rms(const std::vector<double>& squares) {
  const double sum = std::accumulate(squares.begin(), squares.end(), 0.0);
  return std::sqrt(sum / static_cast<double>(squares.size()));
}

ErrorEstimate estimate_of(const ColumnError::Squares& squares, double factor, int levels) {
  return {factor * rms(squares.bscope_grey2), factor * rms(squares.cscope_grey2), levels, true};
}

// What more samples are worth: an obstacle is raised or not, whatever they are.
bool is_fine(const ColumnError::Squares& squares, double factor, double target_grey) {
  return factor * std::max(rms(squares.bscope_grey2), rms(squares.unraised_grey2)) <= target_grey;
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

ColumnError::Squares none_of(std::size_t columns) {
  const std::vector<double> none(columns, 0.0);
  return {none, none, none};
}

// In a sampling of its own: twice the sub-columns too, as far as they go, and then twice the rays in
// those that are left to rays, or they would be the same ones again.
Sampling twice_as_many(const Sampling& slices) {
  Sampling finer = profile_sampling_for(2.0 * slices.sub_columns * slices.slices_per_sub_column);
  const double rays = 2.0 * slices.rays_per_cell * slices.sub_columns / finer.sub_columns;
  finer.rays_per_cell = std::max(finer.rays_per_cell, rays);
  finer.bounce_share = slices.bounce_share;
  return finer;
}

// With the mean of every two sub-columns of a column in both.
FanSums in_pairs(FanSums fan, int margin) {
  const auto smooth = [&](std::vector<double>& sums, int bins) {
    const auto count = static_cast<std::size_t>(bins);
    for (auto sub = static_cast<std::size_t>(margin % 2);
         sub + 1 < static_cast<std::size_t>(fan.sub_columns); sub += 2)
      for (std::size_t i = sub * count; i < (sub + 1) * count; ++i)
        sums[i] = sums[i + count] = (sums[i] + sums[i + count]) / 2;
  };
  smooth(fan.range_W_per_rad, fan.cells);
  smooth(fan.elevation_W_m3_per_rad, fan.rows);
  return fan;
}

void add_scaled(const ColumnError::Squares& more, double factor2, ColumnError::Squares& squares) {
  for (std::size_t c = 0; c < squares.bscope_grey2.size(); ++c) {
    squares.bscope_grey2[c] += factor2 * more.bscope_grey2[c];
    squares.cscope_grey2[c] += factor2 * more.cscope_grey2[c];
    squares.unraised_grey2[c] += factor2 * more.unraised_grey2[c];
  }
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

  // By the error that more samples make smaller, and what of it the target leaves room for beside
  // the one that they do not.
  std::vector<std::size_t> columns(const ColumnError::Squares& error,
                                   const ColumnError::Squares& fixed, double target_grey) const {
    const double target2 = target_grey * target_grey;
    const auto too_large = [&](double error2, double fixed2) {
      return error2 + fixed2 > target2 && error2 > fixed2;
    };
    std::vector<std::size_t> found;
    for (std::size_t c = 0; c < error.bscope_grey2.size(); ++c)
      if (too_large(error.bscope_grey2[c], fixed.bscope_grey2[c]) ||
          too_large(error.unraised_grey2[c], fixed.unraised_grey2[c]))
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
                               FanSums& sums, SightLines& sight, BounceFan* bounced) const {
  caster_.cast(antenna, with_cscope, CastPass{}, sums, sight);
  ColumnError difference(
      world_.sensor, effects_.runs(core::EffectId::thermal_noise),
      draws_cscope_ ? world_.surfaces().height_above_ground_m(antenna.position_m) : 0.0);
  if (effects_.runs(core::EffectId::rain_echo) && world_.volume_echo) {
    FanSums rain = empty_like(sums);
    add_rain_echo(world_, antenna, sampling_.sub_columns, rain);
    difference.put_under(rain);
  }
  const double target_grey = sampling_.target_grey * (bounces_ != nullptr ? std::sqrt(0.5) : 1.0);
  ErrorEstimate error = target_grey > 0.0
                            ? refine(antenna, with_cscope, difference, target_grey, sums)
                            : estimate(antenna, with_cscope, difference, sums);
  if (bounces_ != nullptr)
    error = together(error, add_bounces(antenna, difference, target_grey, sums, bounced));
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
  ColumnError::Squares error = none_of(columns.size());
  const ColumnError::Squares fixed = of_sub_columns(difference, sums);
  thread_local FanSums fresh;
  SightLines none;
  for (int level = 1;; ++level) {
    fresh = sums;  // what is not cast again is the same in both pictures
    caster_.cast(antenna, with_cscope, CastPass{level, &groups}, fresh, none);
    const ColumnError::Squares apart = difference.between(sums, fresh);
    const Factors factors = factors_of(sampling_.caster);
    const double factor = factors.of_new(level);
    for (const std::size_t c : columns) {
      error.bscope_grey2[c] = factor * factor * apart.bscope_grey2[c];
      error.cscope_grey2[c] = factor * factor * apart.cscope_grey2[c];
      error.unraised_grey2[c] = factor * factor * apart.unraised_grey2[c];
    }
    combine_groups(fresh, factors.share, groups, 1.0 - factors.share, sums);
    add_counts(fresh, sums);
    ColumnError::Squares both = error;
    add_scaled(fixed, 1.0, both);
    ErrorEstimate reached = estimate_of(both, 1.0, level + 1);
    reached.reached = reached.largest_grey() <= target_grey;
    columns = too_coarse.columns(error, fixed, target_grey);
    if (is_fine(both, 1.0, target_grey) || level == kFinestLevel || columns.empty()) return reached;
    groups = too_coarse.groups(columns);
  }
}

ErrorEstimate Refinement::estimate(const sensors::AntennaFrame& antenna, bool with_cscope,
                                   const ColumnError& difference, const FanSums& sums) const {
  thread_local FanSums fresh;
  SightLines none;
  if (sampling_.caster == CasterKind::profile) {
    ProfileCaster(world_, twice_as_many(sampling_))
        .cast(antenna, with_cscope, CastPass{}, fresh, none);
  } else {
    fresh = sums;
    caster_.cast(antenna, with_cscope, CastPass{1, nullptr}, fresh, none);
  }
  const double factor = factors_of(sampling_.caster).of_old;
  ColumnError::Squares error = none_of(static_cast<std::size_t>(world_.sensor.scan.columns));
  add_scaled(difference.between(sums, fresh), factor * factor, error);
  if (fresh.sub_columns == sums.sub_columns)
    add_scaled(of_sub_columns(difference, sums), 1.0, error);
  return estimate_of(error, 1.0, 1);
}

// Where in its sub-column a thing stands, the beam does not know: an error that falls with the square
// of their width. Pairs of sub-columns taken as one have four times of it, three times more.
ColumnError::Squares Refinement::of_sub_columns(const ColumnError& difference,
                                                const FanSums& sums) const {
  ColumnError::Squares error = none_of(static_cast<std::size_t>(world_.sensor.scan.columns));
  if (sampling_.caster != CasterKind::profile || sampling_.sub_columns % 2 != 0) return error;
  const int margin = margin_sub_columns(world_.sensor, sampling_.sub_columns);
  add_scaled(difference.between(sums, in_pairs(sums, margin)), 1.0 / 9.0, error);
  return error;
}

ErrorEstimate Refinement::add_bounces(const sensors::AntennaFrame& antenna,
                                      const ColumnError& difference, double target_grey,
                                      FanSums& sums, BounceFan* bounced) const {
  if (!(target_grey > 0.0)) {
    // Added as a frame without an estimate does it, to the last bit.
    FanSums fresh = sums;
    bounces_->add(antenna, 0, sums, bounced);
    bounces_->add(antenna, 1, fresh);
    return estimate_of(difference.between(sums, fresh), kBounces.of_old, 1);
  }
  FanSums echoes = empty_like(sums);
  bounces_->add(antenna, echoes);
  for (int level = 1;; ++level) {
    FanSums fresh = empty_like(sums);
    bounces_->add(antenna, level, fresh, bounced);
    const ColumnError::Squares apart = difference.between(plus(sums, echoes), plus(sums, fresh));
    add_counts(echoes, fresh);
    echoes = std::move(fresh);
    ErrorEstimate reached = estimate_of(apart, kBounces.of_new(level), level + 1);
    reached.reached = reached.largest_grey() <= target_grey;
    const bool fine = is_fine(apart, kBounces.of_new(level), target_grey);
    if (!fine && level < kFinestBounces) continue;
    sums = plus(std::move(sums), echoes);
    return reached;
  }
}

}  // namespace fanbeam::renderer
