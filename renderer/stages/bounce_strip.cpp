#include "renderer/stages/bounce_strip.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/dispatch.h"
#include "core/random.h"
#include "renderer/casting/deposit.h"
#include "renderer/casting/sub_column.h"
#include "renderer/stages/bounce_fan.h"

namespace fanbeam::renderer {

void BounceShare::deposit_in(FanSums& sums) const {
  const auto at = static_cast<std::size_t>(sub_column);
  deposit(cells[0], cells[1], power_W_per_rad,
          &sums.range_W_per_rad[at * static_cast<std::size_t>(sums.cells)], sums.cells);
  if (sums.rows > 0)
    deposit(rows[0], rows[1], power_W_m3_per_rad,
            &sums.elevation_W_m3_per_rad[at * static_cast<std::size_t>(sums.rows)], sums.rows);
}
namespace {

// Intervals of elevation that get more rays together, and those beside that have a say.
constexpr int kTogether = 4, kBeside = 2;
constexpr double kMostRays = 8.0;  // of an interval in one block

// What a ray stands for: a part of the power of the elevations from low to high.
struct Stands {
  double low_rad = 0.0, high_rad = 0.0;
  double solid_rad2 = 0.0;
};

// Buffers of one thread, kept from strip to strip.
struct StripScratch {
  std::vector<double> edges;
  std::vector<AntennaRay> rays;  // first one for each interval and block, [interval][block]
  std::vector<Stands> stands;    // each ray's
  std::vector<BounceEcho> echoes;
  std::vector<double> shown;  // of what a cell shows, by ray, per solid angle: what its echoes add
};
StripScratch& strip_scratch() {
  thread_local StripScratch scratch;
  return scratch;
}

// A few picture columns' worth of azimuths.
class Strip {
 public:
  Strip(const BounceFrame& frame, int strip, FanSums& sums)
      : frame_(frame),
        sampling_(frame.sampling),
        sums_(sums),
        scratch_(strip_scratch()),
        strip_(strip),
        first_(strip * frame.sub_columns),
        end_(std::min(first_ + frame.sub_columns, sums.sub_columns)),
        left_rad_(sums.first_azimuth_rad + first_ * sums.step_rad),
        block_rad_((end_ - first_) * sums.step_rad / sampling_.azimuths) {}

  // Shares of other strips' sub-columns go to `foreign`.
  void run(std::vector<BounceShare>& foreign) {
    frame_.fan.place(frame_.antenna, left_rad_, left_rad_ + sampling_.azimuths * block_rad_,
                     scratch_.edges);
    intervals_ = static_cast<int>(scratch_.edges.size()) - 1;
    if (intervals_ < 1) return;
    if (sampling_.jittered_passes > 0) {
      for (int pass = 0; pass < sampling_.jittered_passes; ++pass) {
        aim_jittered(pass);
        cast();
        deposit_all(foreign);
      }
      return;
    }
    aim_fan();
    cast();
    hold_against_shown();
    refine();
    cast();
    deposit_all(foreign);
  }

  std::uint64_t cast_count() const { return cast_; }

 private:
  void clear() {
    scratch_.rays.clear();
    scratch_.stands.clear();
    scratch_.echoes.clear();
    traced_ = 0;
  }
  void add_ray(int block, double across, double elevation_rad, const Stands& stands) {
    scratch_.rays.push_back({left_rad_ + (block + across) * block_rad_, elevation_rad});
    scratch_.stands.push_back(stands);
  }
  // All rays that were not cast yet.
  void cast() {
    cast_ += frame_.tracer.trace(frame_.antenna, scratch_.rays, traced_, sampling_.mirrored,
                                 scratch_.echoes);
    traced_ = scratch_.rays.size();
  }
  int place_of(int block) const { return strip_ * sampling_.azimuths + block; }
  std::size_t first_ray(int interval, int block) const {
    return static_cast<std::size_t>(interval * sampling_.azimuths + block);
  }

  void aim_fan() {
    clear();
    for (int j = 0; j < intervals_; ++j)
      for (int block = 0; block < sampling_.azimuths; ++block) {
        const int place = place_of(block);
        add_ray(block, dither(static_cast<std::uint32_t>(j), place, frame_.place.azimuth_shift),
                low_rad(j) + elevation_place(place, frame_.place.elevation) * span_rad(j),
                {low_rad(j), high_rad(j), span_rad(j) * block_rad_});
      }
  }

  // More rays where what the first ones bring back differs by a part of shown_W. Decided for
  // several intervals and all blocks at once, from them and what lies beside: were it decided ray by
  // ray, those that meet a narrow thing would count for less and those that miss it would not, and
  // it would lose power. Without losses in the air: no weather moves a ray.
  void refine() {
    for (int begin = 0; begin < intervals_; begin += kTogether) {
      const int end = std::min(begin + kTogether, intervals_);
      const double change = change_within(begin - kBeside, end + kBeside);
      const double rays = std::min(std::ceil(change / sampling_.smallest_change), kMostRays);
      if (!(rays > 1.0)) continue;
      for (int j = begin; j < end; ++j)
        for (int block = 0; block < sampling_.azimuths; ++block)
          add_rays(j, block, static_cast<int>(rays) - 1);
    }
  }

  // In even steps of the interval, which they share with the first ray.
  void add_rays(int interval, int block, int more) {
    const double solid_rad2 = span_rad(interval) * block_rad_ / (more + 1);
    scratch_.stands[first_ray(interval, block)].solid_rad2 = solid_rad2;
    const int place = place_of(block);
    const double step_rad = span_rad(interval) / more;
    const double first_place = elevation_place(place, frame_.place.elevation);
    for (int i = 0; i < more; ++i) {
      const double from_rad = low_rad(interval) + i * step_rad;
      // A sequence of its own for every interval.
      const auto index = static_cast<std::uint32_t>(0x9E3779B9U * (interval + 1) + i);
      add_ray(block, dither(index, place, frame_.place.azimuth_shift),
              from_rad + first_place * step_rad, {from_rad, from_rad + step_rad, solid_rad2});
    }
  }

  // The largest difference between two intervals, in parts of shown_W.
  double change_within(int begin, int end) const {
    double least = 1e300, most = 0.0;
    for (int j = std::max(begin, 0); j < std::min(end, intervals_); ++j)
      for (int block = 0; block < sampling_.azimuths; ++block) {
        const double change = scratch_.shown[first_ray(j, block)] * span_rad(j) * block_rad_;
        least = std::min(least, change);
        most = std::max(most, change);
      }
    return most - least;
  }

  void hold_against_shown() {
    scratch_.shown.assign(scratch_.rays.size(), 0.0);
    for (const BounceEcho& echo : scratch_.echoes)
      scratch_.shown[echo.ray] += echo.density_W_per_rad2 / frame_.shown_W[cell_at(echo.range_m)];
  }

  // A ray of a reference counts where it was sent: spread it would light what lies beside.
  void aim_jittered(int pass) {
    clear();
    // The casters' jitter with another frame number: independent of theirs.
    const core::RandomKey key{sampling_.seed, core::kStreamReferenceJitter, 1};
    const auto passes = static_cast<std::uint64_t>(sampling_.jittered_passes);
    for (int j = 0; j < intervals_; ++j)
      for (int block = 0; block < sampling_.azimuths; ++block) {
        const auto words = core::random_words(
            key,
            static_cast<std::uint64_t>(place_of(block)) * passes + static_cast<std::uint64_t>(pass),
            static_cast<std::uint32_t>(j));
        const double elevation_rad = low_rad(j) + core::uniform_from(words[1]) * span_rad(j);
        add_ray(
            block, core::uniform_from(words[0]), elevation_rad,
            {elevation_rad, elevation_rad, span_rad(j) * block_rad_ / sampling_.jittered_passes});
      }
  }

  void deposit_all(std::vector<BounceShare>& foreign) {
    for (const BounceEcho& echo : scratch_.echoes) deposit_echo(echo, foreign);
  }

  void deposit_echo(const BounceEcho& echo, std::vector<BounceShare>& foreign) {
    const sensors::RangeGate& gate = frame_.sensor.range;
    const sensors::Display& display = frame_.sensor.display;
    BounceShare share;
    share.sub_column =
        static_cast<int>(std::floor((echo.azimuth_rad - sums_.first_azimuth_rad) / sums_.step_rad));
    const Stands& stands = scratch_.stands[echo.ray];
    share.power_W_per_rad =
        echo.density_W_per_rad2 * echo.left * stands.solid_rad2 / sums_.step_rad;
    for (int end = 0; end < 2; ++end) {
      const double ahead_rad =
          (end == 0 ? stands.low_rad : stands.high_rad) - scratch_.rays[echo.ray].elevation_rad;
      share.cells[end] = (end_m(echo, ahead_rad) - gate.minimum_m) / gate.cell_m;
      share.rows[end] =
          (display.cscope_top_rad - echo.elevation_rad - echo.elevation_rate * ahead_rad) *
          display.cscope_rows / display.cscope_span_rad;
    }
    if (share.cells[0] > share.cells[1]) std::swap(share.cells[0], share.cells[1]);
    if (share.rows[0] > share.rows[1]) std::swap(share.rows[0], share.rows[1]);
    if (echo.range_m >= gate.minimum_m && echo.range_m < gate.maximum_m())
      share.power_W_m3_per_rad = share.power_W_per_rad * echo.range_m * echo.range_m * echo.range_m;
    if (share.sub_column >= first_ && share.sub_column < end_) {
      share.deposit_in(sums_);
      if (frame_.alone != nullptr) frame_.alone->add(share);
    } else if (share.sub_column >= 0 && share.sub_column < sums_.sub_columns) {
      foreign.push_back(share);
    }
  }

  // The echo's range at another elevation. On a plane the inverse of a range changes evenly; what
  // is seen at grazing incidence ends somewhere.
  double end_m(const BounceEcho& echo, double ahead_rad) const {
    const double denominator = 1.0 - echo.range_m_per_rad * ahead_rad / echo.range_m;
    const double ahead_m =
        denominator > 0.1 ? echo.range_m / denominator - echo.range_m : sampling_.longest_reach_m;
    return echo.range_m +
           std::clamp(ahead_m, -sampling_.longest_reach_m, sampling_.longest_reach_m);
  }

  std::size_t cell_at(double range_m) const {
    const sensors::RangeGate& gate = frame_.sensor.range;
    return static_cast<std::size_t>(
        std::clamp((range_m - gate.minimum_m) / gate.cell_m, 0.0, gate.cells - 1.0));
  }
  double low_rad(int j) const { return scratch_.edges[static_cast<std::size_t>(j)]; }
  double high_rad(int j) const { return scratch_.edges[static_cast<std::size_t>(j) + 1]; }
  double span_rad(int j) const { return high_rad(j) - low_rad(j); }

  const BounceFrame& frame_;
  const BounceSampling& sampling_;
  FanSums& sums_;
  StripScratch& scratch_;
  int strip_;
  int first_, end_;  // sub-columns
  double left_rad_, block_rad_;
  int intervals_ = 0;
  std::size_t traced_ = 0;  // of the rays
  std::uint64_t cast_ = 0;
};

}  // namespace

FANBEAM_HOT(std::uint64_t, cast_bounce_strip,
            (const BounceFrame& frame, int strip, FanSums& sums, std::vector<BounceShare>& foreign),
            (frame, strip, sums, foreign)) {
  Strip rays(frame, strip, sums);
  rays.run(foreign);
  return rays.cast_count();
}

}  // namespace fanbeam::renderer
