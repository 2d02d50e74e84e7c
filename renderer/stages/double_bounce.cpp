#include "renderer/stages/double_bounce.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/random.h"
#include "renderer/casting/deposit.h"

namespace fanbeam::renderer {
namespace {

// The search looks at every second elevation; what it finds is cast again with this many
// elevations on both sides, so that the ends of a corner are not cut off.
constexpr int kSearchStride = 2;
constexpr int kWindowMargin = 3;

// Place inside a sub-column for ray `index`: multiples of the golden ratio.
double place_of(std::uint32_t index) {
  return static_cast<double>(index * 2654435769U) * 0x1p-32;  // wraps round by itself
}

// Power that belongs to a sub-column of another strip.
struct Foreign {
  int sub_column;
  double from_cell, to_cell, power_W_per_rad;
  double from_row, to_row, power_W_m3_per_rad;
};

// What one thread needs for a strip, kept from strip to strip.
struct StripScratch {
  std::vector<double> edges;
  std::vector<char> wanted;  // by elevation interval
  std::vector<AntennaRay> rays;
  std::vector<int> intervals;  // of the rays
  std::vector<Bounce> bounces;
};

class Strip {
 public:
  Strip(const World& world, const Sampling& sampling, const ElevationFan& fan,
        const BounceTracer& tracer, const sensors::AntennaFrame& antenna, FanSums& sums, int strip)
      : world_(world),
        sampling_(sampling),
        fan_(fan),
        tracer_(tracer),
        antenna_(antenna),
        sums_(sums),
        first_(strip * sampling.sub_columns),
        end_(std::min(first_ + sampling.sub_columns, sums.sub_columns)),
        gap_limit_m_(sampling.gap_cells * std::max(1.0, 1.0 / sampling.rays_per_cell) *
                     world.sensor.range.cell_m) {}

  void run(StripScratch& scratch, std::vector<Foreign>& foreign) {
    fan_.place(antenna_, left_rad(first_), left_rad(end_), scratch.edges);
    intervals_ = static_cast<int>(scratch.edges.size()) - 1;
    if (intervals_ < 1) return;
    const int passes = sampling_.jittered_passes;
    if (passes > 0) {
      scratch.wanted.assign(static_cast<std::size_t>(intervals_), 1);
    } else if (!search(scratch)) {
      return;
    }
    for (int sub_column = first_; sub_column < end_; ++sub_column) {
      for (int pass = 0; pass < std::max(passes, 1); ++pass) {
        aim(scratch, sub_column, pass);
        cast(scratch);
        deposit_all(scratch, sub_column, foreign);
      }
    }
  }

  std::uint64_t cast_count() const { return cast_; }

 private:
  double left_rad(int sub_column) const {
    return sums_.first_azimuth_rad + sub_column * sums_.step_rad;
  }

  bool search(StripScratch& scratch) {
    scratch.wanted.assign(static_cast<std::size_t>(intervals_), 0);
    scratch.rays.clear();
    scratch.intervals.clear();
    const double width_rad = left_rad(end_) - left_rad(first_);
    for (int j = first_ % kSearchStride; j < intervals_; j += kSearchStride) {
      const auto place = place_of(static_cast<std::uint32_t>(j + 7 * first_));
      scratch.rays.push_back({left_rad(first_) + place * width_rad, middle_rad(scratch, j)});
      scratch.intervals.push_back(j);
    }
    cast(scratch);
    bool any = false;
    for (std::size_t i = 0; i < scratch.rays.size(); ++i) {
      if (!scratch.bounces[i].met) continue;
      any = true;
      const int low = std::max(scratch.intervals[i] - kWindowMargin, 0);
      const int high = std::min(scratch.intervals[i] + kWindowMargin, intervals_ - 1);
      std::fill(scratch.wanted.begin() + low, scratch.wanted.begin() + high + 1, 1);
    }
    return any;
  }

  void aim(StripScratch& scratch, int sub_column, int pass) const {
    scratch.rays.clear();
    scratch.intervals.clear();
    const bool jittered = sampling_.jittered_passes > 0;
    // The casters' jitter with another frame number: independent of theirs.
    const core::RandomKey key{sampling_.seed, core::kStreamReferenceJitter, 1};
    const auto cell = static_cast<std::uint64_t>(sub_column) *
                          static_cast<std::uint64_t>(std::max(sampling_.jittered_passes, 1)) +
                      static_cast<std::uint64_t>(pass);
    for (int j = 0; j < intervals_; ++j) {
      if (scratch.wanted[static_cast<std::size_t>(j)] == 0) continue;
      double place = place_of(static_cast<std::uint32_t>(j + 7 * sub_column));
      double elevation_rad = middle_rad(scratch, j);
      if (jittered) {
        const auto words = core::random_words(key, cell, static_cast<std::uint32_t>(j));
        place = core::uniform_from(words[0]);
        elevation_rad = low_rad(scratch, j) + core::uniform_from(words[1]) * span_rad(scratch, j);
      }
      scratch.rays.push_back({left_rad(sub_column) + place * sums_.step_rad, elevation_rad});
      scratch.intervals.push_back(j);
    }
  }

  void cast(StripScratch& scratch) {
    const std::size_t count = scratch.rays.size();
    scratch.bounces.resize(count);
    for (std::size_t i = 0; i < count; i += BounceTracer::kAtOnce)
      cast_ +=
          tracer_.trace(antenna_, &scratch.rays[i],
                        static_cast<int>(std::min<std::size_t>(BounceTracer::kAtOnce, count - i)),
                        &scratch.bounces[i]);
  }

  void deposit_all(const StripScratch& scratch, int sub_column, std::vector<Foreign>& foreign) {
    const std::size_t count = scratch.rays.size();
    const double passes = std::max(sampling_.jittered_passes, 1);
    for (std::size_t i = 0; i < count; ++i) {
      const Bounce& bounce = scratch.bounces[i];
      if (!bounce.met) continue;
      const Bounce* below = neighbour(scratch, i, -1);
      const Bounce* above = neighbour(scratch, i, 1);
      const double span = span_rad(scratch, scratch.intervals[i]) / passes;
      for (BounceEcho Bounce::*const echo : {&Bounce::pair, &Bounce::image})
        add(bounce.*echo, below != nullptr ? &(below->*echo) : nullptr,
            above != nullptr ? &(above->*echo) : nullptr, span, sub_column, foreign);
    }
  }

  // The bounce of the next elevation when it took the same surfaces.
  const Bounce* neighbour(const StripScratch& scratch, std::size_t i, int step) const {
    if (!sampling_.deposit_intervals) return nullptr;
    if ((i == 0 && step < 0) || (i + 1 == scratch.rays.size() && step > 0)) return nullptr;
    const std::size_t other = step < 0 ? i - 1 : i + 1;
    const Bounce& bounce = scratch.bounces[other];
    const bool next = scratch.intervals[other] == scratch.intervals[i] + step;
    return next && bounce.met && bounce.surfaces == scratch.bounces[i].surfaces ? &bounce : nullptr;
  }

  // Half way to the neighbour.
  double end_of_interval_m(const BounceEcho& echo, const BounceEcho* other) const {
    if (other == nullptr || !(other->density_W_per_rad2 > 0.0) ||
        std::abs(other->range_m - echo.range_m) > gap_limit_m_)
      return echo.range_m;
    return (echo.range_m + other->range_m) / 2;
  }

  void add(const BounceEcho& echo, const BounceEcho* below, const BounceEcho* above,
           double span_rad, int from_sub_column, std::vector<Foreign>& foreign) {
    if (!(echo.density_W_per_rad2 > 0.0)) return;
    const sensors::Sensor& sensor = world_.sensor;
    const double a_m = end_of_interval_m(echo, below);
    const double b_m = end_of_interval_m(echo, above);
    const double power = echo.density_W_per_rad2 * span_rad;
    const auto cells = [&](double range_m) {
      return (range_m - sensor.range.minimum_m) / sensor.range.cell_m;
    };
    const double row = (sensor.display.cscope_top_rad - echo.elevation_rad) *
                       sensor.display.cscope_rows / sensor.display.cscope_span_rad;
    const bool shown =
        echo.range_m >= sensor.range.minimum_m && echo.range_m < sensor.range.maximum_m();
    const Foreign share{sub_column_of(echo.azimuth_rad, from_sub_column),
                        cells(std::min(a_m, b_m)),
                        cells(std::max(a_m, b_m)),
                        power,
                        row,
                        row,
                        shown ? power * echo.range_m * echo.range_m * echo.range_m : 0.0};
    if (share.sub_column >= first_ && share.sub_column < end_) {
      deposit_share(share, sums_);
    } else if (share.sub_column >= 0 && share.sub_column < sums_.sub_columns) {
      foreign.push_back(share);
    }
  }

  // Rounding must not move an echo of one azimuth over the border of its sub-column.
  int sub_column_of(double azimuth_rad, int own) const {
    const double position = (azimuth_rad - sums_.first_azimuth_rad) / sums_.step_rad;
    if (position > own - 1e-6 && position < own + 1.0 + 1e-6) return own;
    return static_cast<int>(std::floor(std::clamp(position, -1.0, sums_.sub_columns + 0.5)));
  }

 public:
  static void deposit_share(const Foreign& share, FanSums& sums) {
    const auto sub_column = static_cast<std::size_t>(share.sub_column);
    deposit(share.from_cell, share.to_cell, share.power_W_per_rad,
            &sums.range_W_per_rad[sub_column * static_cast<std::size_t>(sums.cells)], sums.cells);
    if (sums.rows > 0)
      deposit(share.from_row, share.to_row, share.power_W_m3_per_rad,
              &sums.elevation_W_m3_per_rad[sub_column * static_cast<std::size_t>(sums.rows)],
              sums.rows);
  }

 private:
  static double low_rad(const StripScratch& scratch, int j) {
    return scratch.edges[static_cast<std::size_t>(j)];
  }
  static double span_rad(const StripScratch& scratch, int j) {
    return scratch.edges[static_cast<std::size_t>(j) + 1] - low_rad(scratch, j);
  }
  static double middle_rad(const StripScratch& scratch, int j) {
    return low_rad(scratch, j) + span_rad(scratch, j) / 2;
  }

  const World& world_;
  const Sampling& sampling_;
  const ElevationFan& fan_;
  const BounceTracer& tracer_;
  const sensors::AntennaFrame& antenna_;
  FanSums& sums_;
  int first_, end_;  // sub-columns
  double gap_limit_m_;
  int intervals_ = 0;
  std::uint64_t cast_ = 0;
};

}  // namespace

DoubleBounce::DoubleBounce(const World& world, const Sampling& sampling)
    : world_(world), sampling_(sampling), fan_(world, sampling), tracer_(world) {}

void DoubleBounce::add(const sensors::AntennaFrame& antenna, FanSums& sums) const {
  if (!tracer_.any()) return;
  const int strips = (sums.sub_columns + sampling_.sub_columns - 1) / sampling_.sub_columns;
  std::vector<std::vector<Foreign>> foreign(static_cast<std::size_t>(strips));
  std::vector<std::uint64_t> cast(foreign.size(), 0);
  core::parallel_for(foreign.size(), [&](std::size_t i) {
    thread_local StripScratch scratch;
    Strip strip(world_, sampling_, fan_, tracer_, antenna, sums, static_cast<int>(i));
    strip.run(scratch, foreign[i]);
    cast[i] = strip.cast_count();
  });
  for (const std::vector<Foreign>& shares : foreign)
    for (const Foreign& share : shares) Strip::deposit_share(share, sums);
  for (const std::uint64_t count : cast) sums.rays += count;
}

}  // namespace fanbeam::renderer
