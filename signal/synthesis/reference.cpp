#include "signal/synthesis/reference.h"

#include <cmath>

#include "core/constants.h"
#include "core/parallel.h"
#include "signal/synthesis/beat_phase.h"
#include "signal/synthesis/frame.h"
#include "signal/synthesis/path_run_private.h"
#include "signal/unit_phasor_private.h"

namespace fanbeam::signal {
namespace {

// Of this pulse or of one before: a radar has sent them at every interval, before the first of the frame too.
bool has_echo(const Waveform& waveform, const Segment& segment, double in_segment_s,
              double delay_s) {
  if (waveform.kind != WaveformKind::pulsed) return true;
  const double intervals = (in_segment_s - delay_s) / segment.duration_s;
  return (intervals - std::floor(intervals)) * segment.duration_s < waveform.pulse_width_s;
}

void add_row(const Frame& frame, int channel, int chirp, const std::vector<ScatterPath>& paths,
             DoubleCube& cube) {
  const Segment& segment = frame.segment(channel, chirp);
  for (const ScatterPath& path : paths) {
    const PathGeometry geometry = geometry_of(frame, channel, path);
    for (int n = 0; n < frame.shape.samples; ++n) {
      const double in_segment_s = n / frame.sample_rate_Hz;
      const double delay_s =
          geometry.at(segment.start_s + in_segment_s).length_m / core::kSpeedOfLight_mps;
      if (!has_echo(frame.waveform, segment, in_segment_s, delay_s)) continue;
      const double turns = beat_turns(frame.waveform, segment, in_segment_s, delay_s);
      cube.at(channel, chirp, n) += path.amplitude_sqrtW * unit_phasor(turns);
    }
  }
}

}  // namespace

DoubleCube reference_beat(const Waveform& waveform, int stage, const Array& array,
                          const std::vector<ScatterPath>& paths) {
  const Frame frame = make_frame(waveform, stage, array);
  check(waveform, paths);
  DoubleCube cube(frame.shape);
  const auto chirps = static_cast<std::size_t>(frame.shape.chirps);
  core::parallel_for(chirps * static_cast<std::size_t>(frame.shape.channels), [&](std::size_t row) {
    const int channel = static_cast<int>(row / chirps);
    const int chirp = static_cast<int>(row % chirps);
    add_row(frame, channel, chirp, paths, cube);
  });
  if (!waveform.complex_baseband) keep_real(cube);
  return cube;
}

}  // namespace fanbeam::signal
