#include "renderer/stages/double_bounce.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "core/random.h"
#include "renderer/casting/deposit.h"
#include "renderer/casting/radical_inverse.h"

namespace fanbeam::renderer {
namespace {

// The search looks at every second elevation; what it finds is cast again with this many
// elevations on both sides, so that the ends of a corner are not cut off.
constexpr int kSearchStride = 2;
constexpr int kWindowMargin = 3;
// Sub-columns that one ray stands for: half the casters' density, for a part of the power.
constexpr int kAcross = 2;

// Where the rays of one pass lie beside those of the others, and how much they count.
struct PassPlaces {
  std::uint32_t shift = 0;       // of azimuths, in parts of 2^32 of a block
  double elevation_share = 0.5;  // of each interval of elevations
  double weight = 1.0;

  // Between the borders of a block for ray `index`: multiples of the golden ratio.
  double azimuth(int index, int sub_column) const {
    const auto count = static_cast<std::uint32_t>(index + 7 * sub_column);
    return static_cast<double>(count * 2654435769U + shift) * 0x1p-32;  // wraps round by itself
  }
};

// What one echo gives to one sub-column.
struct Share {
  int sub_column = 0;
  double from_cell = 0.0, to_cell = 0.0, power_W_per_rad = 0.0;
  double row = 0.0, power_W_m3_per_rad = 0.0;

  void deposit_in(FanSums& sums) const {
    const auto at = static_cast<std::size_t>(sub_column);
    deposit(from_cell, to_cell, power_W_per_rad,
            &sums.range_W_per_rad[at * static_cast<std::size_t>(sums.cells)], sums.cells);
    if (sums.rows > 0)
      deposit(row, row, power_W_m3_per_rad,
              &sums.elevation_W_m3_per_rad[at * static_cast<std::size_t>(sums.rows)], sums.rows);
  }
};

// A ray and what it stands for.
struct Sent {
  AntennaRay ray;
  int interval = 0;    // of elevation
  int sub_column = 0;  // first of its block
};

// Buffers of one thread, kept from strip to strip.
struct StripScratch {
  std::vector<double> edges;
  std::vector<char> wanted;  // by elevation interval
  std::vector<Sent> sent;    // by interval, then by block: packets stay square in angle
  std::vector<Bounce> bounces;
};

class Strip {
 public:
  Strip(const World& world, const Sampling& sampling, const ElevationFan& fan,
        const BounceTracer& tracer, const sensors::AntennaFrame& antenna, const PassPlaces& places,
        FanSums& sums, int strip, StripScratch& scratch)
      : world_(world),
        sampling_(sampling),
        fan_(fan),
        tracer_(tracer),
        antenna_(antenna),
        places_(places),
        sums_(sums),
        scratch_(scratch),
        first_(strip * sampling.sub_columns),
        end_(std::min(first_ + sampling.sub_columns, sums.sub_columns)),
        gap_limit_m_(sampling.gap_cells * std::max(1.0, 1.0 / sampling.rays_per_cell) *
                     world.sensor.range.cell_m) {}

  // Shares of other strips' sub-columns go to `foreign`.
  void run(std::vector<Share>& foreign) {
    fan_.place(antenna_, left_rad(first_), left_rad(end_), scratch_.edges);
    intervals_ = static_cast<int>(scratch_.edges.size()) - 1;
    if (intervals_ < 1) return;
    const int passes = sampling_.jittered_passes;
    if (passes > 0) {
      scratch_.wanted.assign(static_cast<std::size_t>(intervals_), 1);
    } else if (!search()) {
      return;
    }
    across_ = passes > 0 ? 1 : kAcross;
    for (int pass = 0; pass < std::max(passes, 1); ++pass) {
      aim(pass);
      cast();
      for (std::size_t i = 0; i < scratch_.sent.size(); ++i)
        if (scratch_.bounces[i].met) deposit_bounce(i, foreign);
    }
  }

  std::uint64_t cast_count() const { return cast_; }

 private:
  // Marks the intervals around which mirrored rays meet anything; false when there are none.
  bool search() {
    scratch_.wanted.assign(static_cast<std::size_t>(intervals_), 0);
    scratch_.sent.clear();
    across_ = end_ - first_;
    for (int j = first_ % kSearchStride; j < intervals_; j += kSearchStride)
      send(j, first_, places_.azimuth(j, first_), sampled_rad(j));
    cast();
    bool any = false;
    for (std::size_t i = 0; i < scratch_.sent.size(); ++i) {
      if (!scratch_.bounces[i].met) continue;
      any = true;
      const int low = std::max(scratch_.sent[i].interval - kWindowMargin, 0);
      const int high = std::min(scratch_.sent[i].interval + kWindowMargin, intervals_ - 1);
      std::fill(scratch_.wanted.begin() + low, scratch_.wanted.begin() + high + 1, 1);
    }
    return any;
  }

  void aim(int pass) {
    const int passes = sampling_.jittered_passes;
    // The casters' jitter with another frame number: independent of theirs.
    const core::RandomKey key{sampling_.seed, core::kStreamReferenceJitter, 1};
    scratch_.sent.clear();
    for (int j = 0; j < intervals_; ++j) {
      if (scratch_.wanted[static_cast<std::size_t>(j)] == 0) continue;
      for (int left = first_; left < end_; left += across_) {
        if (passes == 0) {
          send(j, left, places_.azimuth(j, left), sampled_rad(j));
          continue;
        }
        const auto words = core::random_words(
            key,
            static_cast<std::uint64_t>(left) * static_cast<std::uint64_t>(passes) +
                static_cast<std::uint64_t>(pass),
            static_cast<std::uint32_t>(j));
        send(j, left, core::uniform_from(words[0]),
             low_rad(j) + core::uniform_from(words[1]) * span_rad(j));
      }
    }
  }

  void send(int interval, int sub_column, double place, double elevation_rad) {
    const double width_rad = (block_end(sub_column) - sub_column) * sums_.step_rad;
    scratch_.sent.push_back(
        {{left_rad(sub_column) + place * width_rad, elevation_rad}, interval, sub_column});
  }

  void cast() {
    const std::size_t count = scratch_.sent.size();
    scratch_.bounces.resize(count);
    AntennaRay rays[BounceTracer::kAtOnce];
    for (std::size_t i = 0; i < count; i += BounceTracer::kAtOnce) {
      const std::size_t some = std::min<std::size_t>(BounceTracer::kAtOnce, count - i);
      for (std::size_t k = 0; k < some; ++k) rays[k] = scratch_.sent[i + k].ray;
      cast_ += tracer_.trace(antenna_, rays, static_cast<int>(some), &scratch_.bounces[i]);
    }
  }

  void deposit_bounce(std::size_t i, std::vector<Share>& foreign) {
    const Bounce* below = neighbour(i, -1);
    const Bounce* above = neighbour(i, 1);
    for (BounceEcho Bounce::*const echo : {&Bounce::pair, &Bounce::image})
      deposit_echo(scratch_.bounces[i].*echo, below != nullptr ? &(below->*echo) : nullptr,
                   above != nullptr ? &(above->*echo) : nullptr, scratch_.sent[i], foreign);
  }

  // The bounce of the next elevation in the same block, when it took the same surfaces.
  const Bounce* neighbour(std::size_t i, int step) const {
    if (!sampling_.deposit_intervals) return nullptr;
    const int blocks = (end_ - first_ + across_ - 1) / across_;
    const auto other = static_cast<std::ptrdiff_t>(i) + step * blocks;
    if (other < 0 || other >= static_cast<std::ptrdiff_t>(scratch_.sent.size())) return nullptr;
    const auto at = static_cast<std::size_t>(other);
    const Bounce& bounce = scratch_.bounces[at];
    const bool next = scratch_.sent[at].interval == scratch_.sent[i].interval + step;
    return next && bounce.met && bounce.surfaces == scratch_.bounces[i].surfaces ? &bounce
                                                                                 : nullptr;
  }

  // Half way to the neighbour.
  double end_of_interval_m(const BounceEcho& echo, const BounceEcho* other) const {
    if (other == nullptr || !(other->density_W_per_rad2 > 0.0) ||
        std::abs(other->range_m - echo.range_m) > gap_limit_m_)
      return echo.range_m;
    return (echo.range_m + other->range_m) / 2;
  }

  void deposit_echo(const BounceEcho& echo, const BounceEcho* below, const BounceEcho* above,
                    const Sent& sent, std::vector<Share>& foreign) {
    if (!(echo.density_W_per_rad2 > 0.0)) return;
    const sensors::RangeGate& gate = world_.sensor.range;
    const sensors::Display& display = world_.sensor.display;
    const double a_m = end_of_interval_m(echo, below);
    const double b_m = end_of_interval_m(echo, above);
    Share share;
    share.from_cell = (std::min(a_m, b_m) - gate.minimum_m) / gate.cell_m;
    share.to_cell = (std::max(a_m, b_m) - gate.minimum_m) / gate.cell_m;
    share.power_W_per_rad = places_.weight * echo.density_W_per_rad2 * span_rad(sent.interval) /
                            std::max(sampling_.jittered_passes, 1);
    share.row = (display.cscope_top_rad - echo.elevation_rad) * display.cscope_rows /
                display.cscope_span_rad;
    if (echo.range_m >= gate.minimum_m && echo.range_m < gate.maximum_m())
      share.power_W_m3_per_rad = share.power_W_per_rad * echo.range_m * echo.range_m * echo.range_m;
    // The block that the ray stands for, moved as far as the echo appears beside the ray.
    const int moved =
        static_cast<int>(std::lround((echo.azimuth_rad - sent.ray.azimuth_rad) / sums_.step_rad));
    for (int k = sent.sub_column + moved; k < block_end(sent.sub_column) + moved; ++k) {
      share.sub_column = k;
      if (k >= first_ && k < end_) {
        share.deposit_in(sums_);
      } else if (k >= 0 && k < sums_.sub_columns) {
        foreign.push_back(share);
      }
    }
  }

  int block_end(int sub_column) const { return std::min(sub_column + across_, end_); }
  double left_rad(int sub_column) const {
    return sums_.first_azimuth_rad + sub_column * sums_.step_rad;
  }
  double low_rad(int j) const { return scratch_.edges[static_cast<std::size_t>(j)]; }
  double span_rad(int j) const {
    return scratch_.edges[static_cast<std::size_t>(j) + 1] - low_rad(j);
  }
  double sampled_rad(int j) const { return low_rad(j) + places_.elevation_share * span_rad(j); }

  const World& world_;
  const Sampling& sampling_;
  const ElevationFan& fan_;
  const BounceTracer& tracer_;
  const sensors::AntennaFrame& antenna_;
  const PassPlaces& places_;
  FanSums& sums_;
  StripScratch& scratch_;
  int first_, end_;  // sub-columns
  double gap_limit_m_;
  int intervals_ = 0;
  int across_ = 1;  // sub-columns of a block
  std::uint64_t cast_ = 0;
};

}  // namespace

DoubleBounce::DoubleBounce(const World& world, const Sampling& sampling)
    : world_(world), sampling_(sampling), fan_(world, sampling), tracer_(world) {}

void DoubleBounce::add(const sensors::AntennaFrame& antenna, FanSums& sums, int level) const {
  if (!tracer_.any()) return;
  const int passes = level < 2 ? 1 : 1 << (level - 1);
  for (int pass = 0; pass < passes; ++pass)
    add_pass(antenna, level < 2 ? level : passes + pass, 1.0 / passes, sums);
}

void DoubleBounce::add_pass(const sensors::AntennaFrame& antenna, int pass, double weight,
                            FanSums& sums) const {
  const PassPlace place = pass_place(pass);
  const PassPlaces places{place.azimuth_shift, place.elevation, weight};
  const int strips = (sums.sub_columns + sampling_.sub_columns - 1) / sampling_.sub_columns;
  std::vector<std::vector<Share>> foreign(static_cast<std::size_t>(strips));
  std::vector<std::uint64_t> cast(foreign.size(), 0);
  core::parallel_for(foreign.size(), [&](std::size_t i) {
    thread_local StripScratch scratch;
    Strip strip(world_, sampling_, fan_, tracer_, antenna, places, sums, static_cast<int>(i),
                scratch);
    strip.run(foreign[i]);
    cast[i] = strip.cast_count();
  });
  for (const std::vector<Share>& shares : foreign)
    for (const Share& share : shares) share.deposit_in(sums);
  for (const std::uint64_t count : cast) sums.rays += count;
}

}  // namespace fanbeam::renderer
