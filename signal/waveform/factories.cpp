#include "signal/waveform/factories.h"

#include <cmath>

#include "signal/checks_private.h"
#include "signal/waveform/m_sequence.h"

namespace fanbeam::signal {
namespace {

// `what` the limit is: its number would be in SI, which not everybody who is told has asked in.
void check_below(const char* field, double value, double limit, const char* what) {
  check_positive(field, value);
  if (value >= limit) refuse(field, value, std::string("below the ") + what);
}

void check_ramps(const TriangleParameters& parameters) {
  check_positive("frequency_Hz", parameters.frequency_Hz);
  check_below("bandwidth_Hz", parameters.bandwidth_Hz, parameters.frequency_Hz, "frequency");
  check_positive("ramp_s", parameters.ramp_s);
  check_positive("sample_rate_Hz", parameters.sample_rate_Hz);
}

Segment ramp(const TriangleParameters& parameters, double start_s, double ramp_s, bool up,
             int stage) {
  const double sign = up ? 1.0 : -1.0;
  return {start_s,
          ramp_s,
          parameters.frequency_Hz - sign * 0.5 * parameters.bandwidth_Hz,
          sign * parameters.bandwidth_Hz / ramp_s,
          0,
          stage};
}

// Both ramps, meeting at `turn_s`.
void add_triangle(const TriangleParameters& parameters, double turn_s, double ramp_s, int stage,
                  std::vector<Segment>& segments) {
  const bool up_first = !parameters.down_first;
  segments.push_back(ramp(parameters, turn_s - ramp_s, ramp_s, up_first, stage));
  segments.push_back(ramp(parameters, turn_s, ramp_s, !up_first, stage));
}

void add_chirps(const ChirpSequenceParameters& parameters, double start_s,
                std::vector<Segment>& segments) {
  check_positive("frequency_Hz", parameters.frequency_Hz);
  check_below("bandwidth_Hz", parameters.bandwidth_Hz, parameters.frequency_Hz, "frequency");
  check_positive("ramp_s", parameters.ramp_s);
  check_positive("interval_s", parameters.interval_s);
  if (parameters.interval_s < parameters.ramp_s)
    refuse("interval_s", parameters.interval_s, "at least the ramp");
  check_positive("sample_rate_Hz", parameters.sample_rate_Hz);
  check_count("chirps", parameters.chirps, 1, 65536);
  check_count("slots", parameters.slots, 1, 256);
  check_count("chirps x slots", parameters.chirps * parameters.slots, 1, 1000000);
  for (int i = 0; i < parameters.chirps * parameters.slots; ++i)
    segments.push_back({start_s + i * parameters.interval_s, parameters.ramp_s,
                        parameters.frequency_Hz - 0.5 * parameters.bandwidth_Hz,
                        parameters.bandwidth_Hz / parameters.ramp_s, i % parameters.slots, 0});
}

Waveform checked(Waveform waveform) {
  check(waveform);
  return waveform;
}

// What every kind has.
Waveform base(WaveformKind kind, double frequency_Hz, double bandwidth_Hz, bool complex_baseband) {
  Waveform waveform;
  waveform.kind = kind;
  waveform.centre_frequency_Hz = frequency_Hz;
  waveform.bandwidth_Hz = bandwidth_Hz;
  waveform.complex_baseband = complex_baseband;
  return waveform;
}

}  // namespace

Waveform continuous(const ContinuousParameters& parameters) {
  Waveform waveform =
      base(WaveformKind::continuous, parameters.frequency_Hz, 0.0, parameters.complex_baseband);
  waveform.segments = {{0.0, parameters.duration_s, parameters.frequency_Hz, 0.0, 0, 0}};
  waveform.sample_rate_Hz = {parameters.sample_rate_Hz};
  return checked(waveform);
}

Waveform pulsed(const PulsedParameters& parameters) {
  check_positive("interval_s", parameters.interval_s);
  check_below("pulse_width_s", parameters.pulse_width_s, parameters.interval_s, "interval");
  check_count("pulses", parameters.pulses, 1, 65536);
  Waveform waveform =
      base(WaveformKind::pulsed, parameters.frequency_Hz, 1.0 / parameters.pulse_width_s, true);
  for (int i = 0; i < parameters.pulses; ++i)
    waveform.segments.push_back(
        {i * parameters.interval_s, parameters.interval_s, parameters.frequency_Hz, 0.0, 0, 0});
  waveform.sample_rate_Hz = {parameters.sample_rate_Hz};
  waveform.pulse_width_s = parameters.pulse_width_s;
  return checked(waveform);
}

Waveform chirp_sequence(const ChirpSequenceParameters& parameters) {
  Waveform waveform = base(WaveformKind::chirp_sequence, parameters.frequency_Hz,
                           parameters.bandwidth_Hz, parameters.complex_baseband);
  add_chirps(parameters, 0.0, waveform.segments);
  waveform.sample_rate_Hz = {parameters.sample_rate_Hz};
  return checked(waveform);
}

Waveform triangle(const TriangleParameters& parameters) {
  check_ramps(parameters);
  Waveform waveform = base(WaveformKind::triangle, parameters.frequency_Hz, parameters.bandwidth_Hz,
                           parameters.complex_baseband);
  add_triangle(parameters, 0.0, parameters.ramp_s, 0, waveform.segments);
  waveform.sample_rate_Hz = {parameters.sample_rate_Hz};
  return checked(waveform);
}

Waveform sinusoidal(const SinusoidalParameters& parameters) {
  check_positive("frequency_Hz", parameters.frequency_Hz);
  check_below("deviation_Hz", parameters.deviation_Hz, parameters.frequency_Hz, "frequency");
  check_positive("modulation_Hz", parameters.modulation_Hz);
  check_count("periods", parameters.periods, 1, 65536);
  Waveform waveform = base(WaveformKind::sinusoidal, parameters.frequency_Hz,
                           parameters.deviation_Hz, parameters.complex_baseband);
  waveform.segments = {
      {0.0, parameters.periods / parameters.modulation_Hz, parameters.frequency_Hz, 0.0, 0, 0}};
  waveform.sample_rate_Hz = {parameters.sample_rate_Hz};
  waveform.sinusoidal = {parameters.deviation_Hz, parameters.modulation_Hz};
  return checked(waveform);
}

Waveform two_slopes(const TwoSlopesParameters& parameters) {
  check_ramps(parameters.first);
  check_positive("second_ramp_s", parameters.second_ramp_s);
  if (parameters.second_ramp_s == parameters.first.ramp_s)
    refuse("second_ramp_s", parameters.second_ramp_s, "another time than the first ramp");
  Waveform waveform = base(WaveformKind::two_slopes, parameters.first.frequency_Hz,
                           parameters.first.bandwidth_Hz, parameters.first.complex_baseband);
  add_triangle(parameters.first, 0.0, parameters.first.ramp_s, 0, waveform.segments);
  add_triangle(parameters.first, parameters.first.ramp_s + parameters.second_ramp_s,
               parameters.second_ramp_s, 1, waveform.segments);
  waveform.sample_rate_Hz = {parameters.first.sample_rate_Hz, parameters.first.sample_rate_Hz};
  return checked(waveform);
}

Waveform two_stage(const TwoStageParameters& parameters) {
  check_ramps(parameters.fine);
  if (parameters.coarse.frequency_Hz != parameters.fine.frequency_Hz)
    refuse("fine.frequency_Hz", parameters.fine.frequency_Hz, "that of the coarse stage");
  if (parameters.coarse.complex_baseband != parameters.fine.complex_baseband)
    refuse("fine.complex_baseband", parameters.fine.complex_baseband, "as in the coarse stage");
  const double coarse_s =
      parameters.coarse.interval_s * parameters.coarse.chirps * parameters.coarse.slots;
  Waveform waveform = base(WaveformKind::two_stage, parameters.fine.frequency_Hz,
                           parameters.fine.bandwidth_Hz, parameters.fine.complex_baseband);
  add_chirps(parameters.coarse, -parameters.fine.ramp_s - coarse_s, waveform.segments);
  add_triangle(parameters.fine, 0.0, parameters.fine.ramp_s, 1, waveform.segments);
  waveform.sample_rate_Hz = {parameters.coarse.sample_rate_Hz, parameters.fine.sample_rate_Hz};
  return checked(waveform);
}

Waveform coded_triangle(const CodedTriangleParameters& parameters) {
  const TriangleParameters& ramps = parameters.ramps;
  check_ramps(ramps);
  if (ramps.down_first)
    core::throw_input_error(core::ErrorClass::unsupported, "down_first", "true", "up, flat, down");
  check_positive("flat_s", parameters.flat_s);
  check_below("hop_Hz", parameters.hop_Hz, ramps.bandwidth_Hz, "bandwidth");
  const std::vector<int> code = m_sequence(parameters.code_degree);
  const double chip_s = parameters.flat_s / static_cast<double>(code.size());
  Waveform waveform = base(WaveformKind::coded_triangle, ramps.frequency_Hz, ramps.bandwidth_Hz,
                           ramps.complex_baseband);
  const double half_s = 0.5 * parameters.flat_s;
  waveform.segments.push_back(ramp(ramps, -half_s - ramps.ramp_s, ramps.ramp_s, true, 0));
  const double top_Hz = ramps.frequency_Hz + 0.5 * ramps.bandwidth_Hz;
  for (std::size_t i = 0; i < code.size(); ++i)
    waveform.segments.push_back({-half_s + static_cast<double>(i) * chip_s, chip_s,
                                 code[i] > 0 ? top_Hz : top_Hz - parameters.hop_Hz, 0.0, 0, 1});
  waveform.segments.push_back(ramp(ramps, half_s, ramps.ramp_s, false, 2));
  waveform.sample_rate_Hz = {ramps.sample_rate_Hz, ramps.sample_rate_Hz, ramps.sample_rate_Hz};
  return checked(waveform);
}

Waveform stepped(const SteppedParameters& parameters) {
  check_positive("frequency_Hz", parameters.frequency_Hz);
  check_below("bandwidth_Hz", parameters.bandwidth_Hz, parameters.frequency_Hz, "frequency");
  check_positive("step_s", parameters.step_s);
  check_count("steps", parameters.steps, 2, 65536);
  check_below("|shift_Hz|", std::abs(parameters.shift_Hz), parameters.bandwidth_Hz, "bandwidth");
  Waveform waveform =
      base(WaveformKind::stepped, parameters.frequency_Hz, parameters.bandwidth_Hz, true);
  for (int i = 0; i < 2 * parameters.steps; ++i) {
    const double climb = (i / 2 + 0.5) / parameters.steps - 0.5;
    const double shift_Hz = i % 2 == 0 ? 0.0 : parameters.shift_Hz;
    waveform.segments.push_back(
        {i * parameters.step_s, parameters.step_s,
         parameters.frequency_Hz + climb * parameters.bandwidth_Hz + shift_Hz, 0.0, 0, 0});
  }
  waveform.sample_rate_Hz = {parameters.sample_rate_Hz};
  return checked(waveform);
}

}  // namespace fanbeam::signal
