#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "signal/synthesis/path_run_private.h"

namespace fanbeam::signal {
namespace {

// Turns and their slope over samples, both exact, at one moment.
struct Moment {
  double turns = 0.0, per_sample = 0.0, delay_rate = 0.0;
};

Moment moment(const Frame& frame, const Segment& segment, const PathGeometry& geometry,
              double in_segment_s) {
  const PathLength path = geometry.at(segment.start_s + in_segment_s);
  const double delay_s = path.length_m / core::kSpeedOfLight_mps;
  Moment at;
  at.delay_rate = path.rate_mps / core::kSpeedOfLight_mps;
  at.turns = beat_turns(frame.waveform, segment, in_segment_s, delay_s);
  const double slope = segment.slope_Hz_per_s;
  at.per_sample = (segment.start_frequency_Hz * at.delay_rate + slope * delay_s +
                   slope * at.delay_rate * (in_segment_s - delay_s)) /
                  frame.sample_rate_Hz;
  return at;
}

double per_sample2(const Frame& frame, const Segment& segment, double delay_rate) {
  return segment.slope_Hz_per_s * delay_rate * (1.0 - 0.5 * delay_rate) /
         (frame.sample_rate_Hz * frame.sample_rate_Hz);
}

}  // namespace

PathGeometry geometry_of(const Frame& frame, int channel, const ScatterPath& path) {
  return PathGeometry(
      path,
      frame.array.transmitters_m[static_cast<std::size_t>(frame.array.transmitter_of(channel))],
      frame.array.receivers_m[static_cast<std::size_t>(frame.array.receiver_of(channel))]);
}

PathRun path_run(const Frame& frame, int channel, const ScatterPath& path) {
  const PathGeometry geometry = geometry_of(frame, channel, path);
  const double middle_s = (frame.shape.samples / 2) / frame.sample_rate_Hz;
  const int last = frame.shape.chirps - 1;
  const int half = last / 2;
  const Moment start = moment(frame, frame.segment(channel, 0), geometry, middle_s);
  PathRun run;
  run.middle.constant = start.turns;
  run.per_sample = start.per_sample;
  run.per_sample2 = per_sample2(frame, frame.segment(channel, 0), start.delay_rate);
  if (last < 1) return run;

  const Moment end = moment(frame, frame.segment(channel, last), geometry, middle_s);
  run.per_sample_chirp = (end.per_sample - start.per_sample) / last;
  if (last < 2) {
    run.middle.linear = end.turns - start.turns;
    return run;
  }
  const Moment mid = moment(frame, frame.segment(channel, half), geometry, middle_s);
  run.per_sample2 = per_sample2(frame, frame.segment(channel, half), mid.delay_rate);
  const double first_slope = (mid.turns - start.turns) / half;
  const double second_slope = (end.turns - mid.turns) / (last - half);
  run.middle.quadratic = (second_slope - first_slope) / last;
  run.middle.linear = first_slope - run.middle.quadratic * half;

  // A cubic term would show within 2 % of its most at a quarter of the frame.
  const int quarter = std::max(1, last / 4);
  const Moment check = moment(frame, frame.segment(channel, quarter), geometry, middle_s);
  const double cubic = check.turns - run.middle.at(quarter);
  const double bend =
      (mid.per_sample - run.per_sample - run.per_sample_chirp * half) * 0.5 * frame.shape.samples;
  run.error_rad = 2.0 * core::kPi * (std::abs(cubic) + std::abs(bend));
  return run;
}

QuadraticTurns chirp_turns(const Frame& frame, const Segment& segment,
                           const PathGeometry& geometry) {
  const Moment start = moment(frame, segment, geometry, 0.0);
  return {start.turns, start.per_sample, per_sample2(frame, segment, start.delay_rate)};
}

}  // namespace fanbeam::signal
