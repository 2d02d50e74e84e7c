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

// Where the rays of one pass lie beside those of others, and how much they count.
struct PassPlaces {
  std::uint32_t shift = 0;       // of azimuths, in parts of 2^32 of a block
  double elevation_share = 0.5;  // of each interval of elevations
  double weight = 1.0;           // one over the passes that are averaged
  bool everywhere = false;       // else only around places that a search has found

  // Between the borders of a block for ray `index`: multiples of the golden ratio.
  double azimuth(int index, int sub_column) const {
    const auto count = static_cast<std::uint32_t>(index + 7 * sub_column);
    return static_cast<double>(count * 2654435769U + shift) * 0x1p-32;  // wraps round by itself
  }
};

// What one echo gives to one sub-column.
struct Share {
  int sub_column = 0;
  double cell = 0.0, power_W_per_rad = 0.0;
  double row = 0.0, power_W_m3_per_rad = 0.0;

  void deposit_in(FanSums& sums) const {
    const auto at = static_cast<std::size_t>(sub_column);
    deposit(cell, cell, power_W_per_rad,
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
        end_(std::min(first_ + sampling.sub_columns, sums.sub_columns)) {}

  // Shares of other strips' sub-columns go to `foreign`.
  void run(std::vector<Share>& foreign) {
    fan_.place(antenna_, left_rad(first_), left_rad(end_), scratch_.edges);
    intervals_ = static_cast<int>(scratch_.edges.size()) - 1;
    if (intervals_ < 1) return;
    const int passes = sampling_.jittered_passes;
    if (places_.everywhere) {
      scratch_.wanted.assign(static_cast<std::size_t>(intervals_), 1);
    } else if (!search()) {
      return;
    }
    across_ = passes > 0 ? 1 : kAcross;
    for (int pass = 0; pass < std::max(passes, 1); ++pass) {
      aim(pass);
      cast();
      for (std::size_t i = 0; i < scratch_.sent.size(); ++i) {
        deposit_echo(scratch_.bounces[i].pair, scratch_.sent[i], foreign);
        deposit_echo(scratch_.bounces[i].image, scratch_.sent[i], foreign);
      }
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

  void deposit_echo(const BounceEcho& echo, const Sent& sent, std::vector<Share>& foreign) {
    if (!(echo.density_W_per_rad2 > 0.0)) return;
    const sensors::RangeGate& gate = world_.sensor.range;
    const sensors::Display& display = world_.sensor.display;
    Share share;
    share.sub_column =
        static_cast<int>(std::floor((echo.azimuth_rad - sums_.first_azimuth_rad) / sums_.step_rad));
    share.cell = (echo.range_m - gate.minimum_m) / gate.cell_m;
    share.power_W_per_rad = echo.density_W_per_rad2 * span_rad(sent.interval) *
                            (block_end(sent.sub_column) - sent.sub_column) * places_.weight;
    share.row = (display.cscope_top_rad - echo.elevation_rad) * display.cscope_rows /
                display.cscope_span_rad;
    if (echo.range_m >= gate.minimum_m && echo.range_m < gate.maximum_m())
      share.power_W_m3_per_rad = share.power_W_per_rad * echo.range_m * echo.range_m * echo.range_m;
    if (share.sub_column >= first_ && share.sub_column < end_) {
      share.deposit_in(sums_);
    } else if (share.sub_column >= 0 && share.sub_column < sums_.sub_columns) {
      foreign.push_back(share);
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
  int intervals_ = 0;
  int across_ = 1;  // sub-columns of a block
  std::uint64_t cast_ = 0;
};

void add_pass(const World& world, const Sampling& sampling, const ElevationFan& fan,
              const BounceTracer& tracer, const sensors::AntennaFrame& antenna,
              const PassPlaces& places, FanSums& sums) {
  const int strips = (sums.sub_columns + sampling.sub_columns - 1) / sampling.sub_columns;
  std::vector<std::vector<Share>> foreign(static_cast<std::size_t>(strips));
  std::vector<std::uint64_t> cast(foreign.size(), 0);
  core::parallel_for(foreign.size(), [&](std::size_t i) {
    thread_local StripScratch scratch;
    Strip strip(world, sampling, fan, tracer, antenna, places, sums, static_cast<int>(i), scratch);
    strip.run(foreign[i]);
    cast[i] = strip.cast_count();
  });
  for (const std::vector<Share>& shares : foreign)
    for (const Share& share : shares) share.deposit_in(sums);
  for (const std::uint64_t count : cast) sums.rays += count;
}

}  // namespace

DoubleBounce::DoubleBounce(const World& world, const Sampling& sampling)
    : world_(world), sampling_(sampling), fan_(world, sampling), tracer_(world) {}

void DoubleBounce::add(const sensors::AntennaFrame& antenna, FanSums& sums, int level) const {
  if (!tracer_.any()) return;
  const int passes = level < 2 ? 1 : 1 << (level - 1);
  PassPlaces places;
  places.weight = 1.0 / (passes * std::max(sampling_.jittered_passes, 1));
  // What a search misses is missing in every pass: the mean of many would not make up for it.
  places.everywhere = sampling_.jittered_passes > 0 || passes > 1;
  for (int pass = 0; pass < passes; ++pass) {
    const PassPlace place = pass_place(level < 2 ? level : passes + pass);
    places.shift = place.azimuth_shift;
    places.elevation_share = place.elevation;
    add_pass(world_, sampling_, fan_, tracer_, antenna, places, sums);
  }
}

}  // namespace fanbeam::renderer
