#include "signal/synthesis/frame.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/errors.h"

namespace fanbeam::signal {
namespace {

// Starts far from 0, as those before a triangle, are rounded: a difference of two is off by more, times the number of
// chirps, than what is left between all.
bool is_uniform(const Frame& frame) {
  if (frame.waveform.kind == WaveformKind::sinusoidal ||
      frame.waveform.kind == WaveformKind::pulsed)
    return false;
  const Segment& first = frame.segments.front();
  const double interval_s = (frame.segments.back().start_s - first.start_s) /
                            std::max(1.0, static_cast<double>(frame.segments.size()) - 1.0);
  for (std::size_t i = 0; i < frame.segments.size(); ++i) {
    const Segment& segment = frame.segments[i];
    if (segment.start_frequency_Hz != first.start_frequency_Hz ||
        segment.slope_Hz_per_s != first.slope_Hz_per_s ||
        std::abs(segment.start_s - first.start_s - static_cast<double>(i) * interval_s) >
            1e-9 * first.duration_s)
      return false;
  }
  return true;
}

}  // namespace

void check_size(const Waveform& waveform, const Array& array) {
  double samples = 0.0;
  for (int stage = 0; stage < waveform.stages(); ++stage) {
    const std::vector<Segment> segments = stage_segments(waveform, stage);
    const std::size_t chirps = segments.size() / static_cast<std::size_t>(slots(segments));
    samples += static_cast<double>(samples_per_segment(waveform, stage)) *
               static_cast<double>(chirps) * array.channels();
  }
  if (samples > kMostFrameSamples)
    core::throw_input_error(core::ErrorClass::limit, "samples x chirps x channels", samples,
                            "at most 1e8 in a frame: fewer samples, transmitters or receivers");
}

Frame make_frame(const Waveform& waveform, int stage, const Array& array) {
  check(waveform);
  check(array);
  check_size(waveform, array);
  Frame frame;
  frame.waveform = waveform;
  frame.array = array;
  frame.shape.samples = samples_per_segment(waveform, stage);
  frame.segments = stage_segments(waveform, stage);
  frame.slots = slots(frame.segments);
  if (frame.slots != array.slots())
    core::throw_input_error(core::ErrorClass::unsupported, "slots of the stage", frame.slots,
                            std::to_string(array.slots()) + ", what the array needs");
  frame.shape.chirps = static_cast<int>(frame.segments.size()) / frame.slots;
  frame.shape.channels = array.channels();
  frame.sample_rate_Hz = waveform.sample_rate_Hz[static_cast<std::size_t>(stage)];
  frame.uniform = is_uniform(frame);
  if (frame.shape.chirps > 1)
    frame.interval_s = frame.segment(0, 1).start_s - frame.segment(0, 0).start_s;
  return frame;
}

}  // namespace fanbeam::signal
