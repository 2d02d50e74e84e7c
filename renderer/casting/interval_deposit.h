// Deposits the rays of one sub-column: each spreads its power evenly over the range interval and
// the interval of elevations that it stands for (ray_caster.h).
//
// Works on blocks of 64 rays: intervals and their bins are computed side by side, then added one
// after the other in order of elevation.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "renderer/casting/caster.h"
#include "renderer/casting/guarded_bins.h"
#include "renderer/casting/ray_chain.h"
#include "sensors/sensor.h"

namespace fanbeam::renderer {

struct DepositBins {
  GuardedBins range, elevation;
};

class IntervalDeposit {
 public:
  // `limit_m`: neighbours farther apart are not one piece of surface. `low_rad` and `high_rad`
  // bound the fan.
  IntervalDeposit(const sensors::Sensor& sensor, bool with_cscope, double limit_m, double low_rad,
                  double high_rad, DepositBins& bins)
      : gate_(sensor.range),
        display_(sensor.display),
        with_cscope_(with_cscope),
        limit_m_(limit_m),
        low_rad_(low_rad),
        high_rad_(high_rad),
        bins_(bins) {
    bins_.range.reset(gate_.cells);
    if (with_cscope_) bins_.elevation.reset(display_.cscope_rows);
  }

  // All rays of a sub-column from `ray` up. Returns how many echoes came from before the first
  // range cell.
  int add(const RayChain& rays, std::int32_t ray) {
    Block block;
    int blanked = 0;
    block.surface[0] = kNobody;
    block.elevation_rad[0] = low_rad_;
    block.range_m[0] = 0.0;
    while (ray != RayChain::kEnd) {
      const bool lowest = block.surface[0] == kNobody;
      int count = 0;
      while (ray != RayChain::kEnd && count < kBlockRays) {
        load(rays, ray, ++count, block);
        ray = rays.next[static_cast<std::size_t>(ray)];
      }
      if (ray != RayChain::kEnd) {
        load(rays, ray, count + 1, block);
      } else {
        block.surface[count + 1] = kNobody;
        block.elevation_rad[count + 1] = high_rad_;
        block.range_m[count + 1] = 0.0;
      }
      find_borders(count, block);
      if (lowest) block.border_rad[0] = low_rad_;
      if (ray == RayChain::kEnd) block.border_rad[count] = high_rad_;
      if (with_cscope_) find_rows(count, block);
      blanked += deposit_block(count, block);
      block.surface[0] = block.surface[count];
      block.elevation_rad[0] = block.elevation_rad[count];
      block.range_m[0] = block.range_m[count];
    }
    return blanked;
  }

 private:
  static constexpr int kBlockRays = 64;
  static constexpr std::uint32_t kNobody = 0xFFFFFFFEU;  // beyond the ends of the chain

  // Rays 1 to 64 with one neighbour at each end; border i lies between rays i and i + 1.
  struct Block {
    static constexpr int kSize = kBlockRays + 8;
    alignas(64) double elevation_rad[kSize], range_m[kSize], slope[kSize], density[kSize];
    alignas(64) std::uint32_t surface[kSize];
    alignas(64) double border_rad[kSize], middle_m[kSize];
    alignas(64) double border_row[kSize];  // in rows of the C-scope from the top
    alignas(64) int border_whole_row[kSize];
    alignas(64) double joined[kSize];  // 1 where they meet half way between their ranges, else 0
  };
  // What is added where: `share` of it to bin `first`, the rest to the next one.
  struct Spread {
    alignas(64) double from[kBlockRays], to[kBlockRays], amount[kBlockRays], share[kBlockRays];
    alignas(64) int first[kBlockRays], last[kBlockRays];

    void split(int i, int first_bin, int last_bin) {
      // All of it when the first bin reaches beyond the end, of an interval without width too.
      const double in_first = first_bin + 1.0 - from[i], width = to[i] - from[i];
      share[i] = amount[i] * (in_first / (in_first > width ? in_first : width));
      first[i] = first_bin;
      last[i] = last_bin;
    }
    void add_to(GuardedBins& bins, int i) const {
      if (last[i] <= first[i] + 1) {
        bins.add_two(first[i], share[i], amount[i] - share[i]);
      } else if (amount[i] > 0.0) {
        bins.add_wide(from[i], to[i], amount[i]);
      }
    }
  };

  static void load(const RayChain& rays, std::int32_t ray, int place, Block& block) {
    const auto i = static_cast<std::size_t>(ray);
    block.elevation_rad[place] = rays.elevation_rad[i];
    block.range_m[place] = static_cast<double>(rays.range_m[i]);
    block.slope[place] = static_cast<double>(rays.range_slope[i]);
    block.density[place] = static_cast<double>(rays.density_W_per_rad2[i]);
    block.surface[place] = rays.surface[i];
  }

  void find_borders(int count, Block& block) const {
    for (int i = 0; i <= count; ++i) {
      block.border_rad[i] = (block.elevation_rad[i] + block.elevation_rad[i + 1]) / 2;
      block.middle_m[i] = (block.range_m[i] + block.range_m[i + 1]) / 2;
      const bool near = std::abs(block.range_m[i + 1] - block.range_m[i]) <= limit_m_;
      // A neighbour has another azimuth, in which an oblique wall stands at another range: half way
      // to it, no ray would reach the wall's ends. A steep facet keeps to its own plane.
      const bool one_surface =
          block.surface[i] == block.surface[i + 1] && !is_steep(block.surface[i]);
      block.joined[i] = one_surface && near ? 1.0 : 0.0;
    }
  }

  void find_rows(int count, Block& block) const {
    const double rows_per_rad = display_.cscope_rows / display_.cscope_span_rad;
    const double top_rad = display_.cscope_top_rad;
    for (int i = 0; i <= count; ++i) {
      block.border_row[i] = (top_rad - block.border_rad[i]) * rows_per_rad;
      block.border_whole_row[i] = static_cast<int>(std::floor(block.border_row[i]));
    }
  }

  // Where ray i's piece of surface ends towards an edge of its interval of elevations.
  double end_m(const Block& block, int i, int border) const {
    const double range_m = block.range_m[i];
    const double denominator =
        1.0 + block.slope[i] * (block.border_rad[border] - block.elevation_rad[i]);
    const double ahead_m = denominator > 0.1 ? range_m / denominator - range_m : limit_m_;
    const double own_m = range_m + std::clamp(ahead_m, -limit_m_ / 2, limit_m_ / 2);
    return block.joined[border] != 0.0 ? block.middle_m[border] : own_m;
  }

  int deposit_block(int count, const Block& block) const {
    Spread range, elevation;
    const double per_cell = 1.0 / gate_.cell_m;
    const double minimum_m = gate_.minimum_m, maximum_m = gate_.maximum_m();
    int blanked = 0;
    for (int i = 0; i < count; ++i) {
      const double a_m = end_m(block, i + 1, i);
      const double b_m = end_m(block, i + 1, i + 1);
      range.from[i] = (std::min(a_m, b_m) - minimum_m) * per_cell;
      range.to[i] = (std::max(a_m, b_m) - minimum_m) * per_cell;
      range.amount[i] = block.density[i + 1] * (block.border_rad[i + 1] - block.border_rad[i]);
      range.split(i, static_cast<int>(std::floor(range.from[i])),
                  static_cast<int>(std::floor(range.to[i])));
      blanked += block.density[i + 1] > 0.0 && block.range_m[i + 1] < minimum_m ? 1 : 0;
    }
    if (!with_cscope_) {
      for (int i = 0; i < count; ++i) range.add_to(bins_.range, i);
      return blanked;
    }
    for (int i = 0; i < count; ++i) {
      const double range_m = block.range_m[i + 1];
      const double in_gate = (range_m >= minimum_m ? 1.0 : 0.0) * (range_m < maximum_m ? 1.0 : 0.0);
      elevation.from[i] = block.border_row[i + 1];
      elevation.to[i] = block.border_row[i];
      elevation.amount[i] = in_gate * range.amount[i] * range_m * range_m * range_m;
      elevation.split(i, block.border_whole_row[i + 1], block.border_whole_row[i]);
    }
    for (int i = 0; i < count; ++i)
      if (crosses_gate(range, i)) clip_to_gate(block, range, i, elevation);
    // Together: neighbours add to the same bins and wait for each other.
    for (int i = 0; i < count; ++i) {
      range.add_to(bins_.range, i);
      elevation.add_to(bins_.elevation, i);
    }
    return blanked;
  }

  bool crosses_gate(const Spread& range, int i) const {
    return (range.from[i] < 0.0 && range.to[i] > 0.0) ||
           (range.from[i] < gate_.cells && range.to[i] > gate_.cells);
  }

  // Only what lies inside the gate shows: a whole interval there or not would make one row of level
  // ground up to ten times too bright or leave it dark.
  void clip_to_gate(const Block& block, const Spread& range, int i, Spread& elevation) const {
    const double from = std::max(range.from[i], 0.0);
    const double to = std::min(range.to[i], static_cast<double>(gate_.cells));
    const bool rising = end_m(block, i + 1, i) < end_m(block, i + 1, i + 1);
    const double near_row = block.border_row[rising ? i : i + 1];
    const double far_row = block.border_row[rising ? i + 1 : i];
    // On a plane 1 / R changes evenly with elevation. A gate may begin at the antenna.
    const auto inverse = [&](double cell) {
      return 1.0 / std::max(gate_.minimum_m + cell * gate_.cell_m, 1e-3);
    };
    const double rows_m = (far_row - near_row) / (inverse(range.to[i]) - inverse(range.from[i]));
    const double one = near_row + rows_m * (inverse(from) - inverse(range.from[i]));
    const double other = near_row + rows_m * (inverse(to) - inverse(range.from[i]));
    const double range_m = gate_.minimum_m + (from + to) / 2 * gate_.cell_m;
    elevation.from[i] = std::min(one, other);
    elevation.to[i] = std::max(one, other);
    elevation.amount[i] =
        range.amount[i] * (to - from) / (range.to[i] - range.from[i]) * range_m * range_m * range_m;
    elevation.split(i, static_cast<int>(std::floor(elevation.from[i])),
                    static_cast<int>(std::floor(elevation.to[i])));
  }

  const sensors::RangeGate& gate_;
  const sensors::Display& display_;
  bool with_cscope_;
  double limit_m_;
  double low_rad_, high_rad_;
  DepositBins& bins_;
};

}  // namespace fanbeam::renderer
