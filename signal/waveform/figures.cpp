#include "signal/waveform/figures.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"

namespace fanbeam::signal {
namespace {

constexpr double c_mps = core::kSpeedOfLight_mps;

void set_cell(StageFigures& stage, double bandwidth_Hz) {
  const double cell_m = c_mps / (2.0 * bandwidth_Hz);
  stage.range_cell_m = cell_m;
  stage.rectangular_width_m = kRectangularWidthCells * cell_m;
  stage.taylor_width_m = kTaylorWidthCells * cell_m;
}

double frame_s(const std::vector<Segment>& segments) {
  return segments.back().start_s + segments.back().duration_s - segments.front().start_s;
}

// Highest beat without folding: complex samples hold as many negative ones.
double highest_beat_Hz(double rate_Hz) { return 0.5 * rate_Hz; }

void ramps(const Waveform& waveform, const std::vector<Segment>& segments, double rate_Hz,
           StageFigures& stage) {
  const double slope = std::abs(stage.slope_Hz_per_s);
  set_cell(stage, slope * stage.segment_s);
  stage.coupling_m_per_mps = segments.front().middle_frequency_Hz() / stage.slope_Hz_per_s;
  const double beats_Hz = waveform.complex_baseband ? rate_Hz : highest_beat_Hz(rate_Hz);
  stage.unambiguous_range_m = beats_Hz * c_mps / (2.0 * slope);
  const double wavelength_m = waveform.wavelength_m();
  const int in_turn = slots(segments);
  const bool repeats =
      static_cast<int>(segments.size()) > in_turn &&
      segments[0].slope_Hz_per_s == segments[static_cast<std::size_t>(in_turn)].slope_Hz_per_s;
  if (repeats) {
    const auto rounds = static_cast<double>(segments.size()) / in_turn;
    const double interval_s =
        segments[static_cast<std::size_t>(in_turn)].start_s - segments[0].start_s;
    stage.speed_cell_mps = wavelength_m / (2.0 * rounds * interval_s);
    stage.unambiguous_speed_mps = wavelength_m / (4.0 * interval_s);
  } else if (segments.size() == 2 &&
             segments[0].slope_Hz_per_s * segments[1].slope_Hz_per_s < 0.0) {
    // A triangle: the difference of its two beats.
    stage.speed_cell_mps = wavelength_m / (2.0 * stage.segment_s);
    stage.unambiguous_speed_mps = 0.5 * wavelength_m * highest_beat_Hz(rate_Hz);
  }
}

void flat(const Waveform& waveform, const std::vector<Segment>& segments, double rate_Hz,
          StageFigures& stage) {
  const double wavelength_m = waveform.wavelength_m();
  stage.speed_cell_mps = wavelength_m / (2.0 * frame_s(segments));
  stage.unambiguous_speed_mps = 0.5 * wavelength_m * highest_beat_Hz(rate_Hz);
  switch (waveform.kind) {
    case WaveformKind::pulsed: {
      const double interval_s =
          segments.size() > 1 ? segments[1].start_s - segments[0].start_s : stage.segment_s;
      stage.range_cell_m = 0.5 * c_mps * waveform.pulse_width_s;
      stage.unambiguous_range_m = 0.5 * c_mps * interval_s;
      stage.unambiguous_speed_mps = wavelength_m / (4.0 * interval_s);
      break;
    }
    case WaveformKind::sinusoidal:
      // The phase swing of the beat, (D / fm) sin(pi fm tau), grows up to fm tau = 1/2.
      if (waveform.sinusoidal.deviation_Hz > 0.0) set_cell(stage, waveform.sinusoidal.deviation_Hz);
      stage.unambiguous_range_m = c_mps / (4.0 * waveform.sinusoidal.frequency_Hz);
      break;
    case WaveformKind::coded_triangle: {
      double lowest_Hz = segments[0].start_frequency_Hz, highest_Hz = lowest_Hz;
      for (const Segment& segment : segments) {
        lowest_Hz = std::min(lowest_Hz, segment.start_frequency_Hz);
        highest_Hz = std::max(highest_Hz, segment.start_frequency_Hz);
      }
      stage.unambiguous_range_m = c_mps / (2.0 * (highest_Hz - lowest_Hz));
      break;
    }
    case WaveformKind::stepped: {
      set_cell(stage, waveform.bandwidth_Hz);
      stage.unambiguous_range_m =
          c_mps / (2.0 * std::abs(segments[1].start_frequency_Hz - segments[0].start_frequency_Hz));
      // One value from each step of a staircase.
      stage.unambiguous_speed_mps =
          wavelength_m / (4.0 * (segments[2].start_s - segments[0].start_s));
      break;
    }
    default:
      break;
  }
}

}  // namespace

std::vector<StageFigures> figures(const Waveform& waveform) {
  check(waveform);
  std::vector<StageFigures> stages;
  for (int i = 0; i < waveform.stages(); ++i) {
    const std::vector<Segment> segments = stage_segments(waveform, i);
    const double rate_Hz = waveform.sample_rate_Hz[static_cast<std::size_t>(i)];
    StageFigures stage;
    stage.segment_s = segments[0].duration_s;
    stage.segments = static_cast<int>(segments.size());
    stage.samples = samples_per_segment(waveform, i);
    stage.slope_Hz_per_s = segments[0].slope_Hz_per_s;
    stage.frequency_bin_Hz = 1.0 / stage.segment_s;
    stage.beat_Hz_per_m = 2.0 * std::abs(stage.slope_Hz_per_s) / c_mps;
    if (stage.slope_Hz_per_s != 0.0)
      ramps(waveform, segments, rate_Hz, stage);
    else
      flat(waveform, segments, rate_Hz, stage);
    stages.push_back(stage);
  }
  return stages;
}

double beat_Hz(const Segment& segment, double range_m, double radial_speed_mps) {
  const double delay_s = 2.0 * range_m / c_mps;
  const double rate = 2.0 * radial_speed_mps / c_mps;
  return segment.slope_Hz_per_s * delay_s * (1.0 - rate) + segment.middle_frequency_Hz() * rate;
}

}  // namespace fanbeam::signal
