// What a radar transmits over one frame, as data: stretches of constant frequency slope, where they
// start, whose turn it is, and how the beat is sampled.
//
// Transmit phase inside a segment, t since its start: 2 pi (f0 t + S t^2 / 2).
// Sinusoidal modulation: 2 pi f0 t - (D / (2 fm)) cos(2 pi fm t), so that the frequency is
// f0 + (D / 2) sin(2 pi fm t).
// Source: M. I. Skolnik, Radar Handbook, 3rd ed., ch. 8; A. G. Stove, "Linear FMCW radar
// techniques", IEE Proc. F 139(5), 1992.
// Neglected: the echo of one segment inside the next (sampling should begin after the longest
// delay), and any curvature of a ramp.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace fanbeam::signal {

enum class WaveformKind {
  continuous,      // one tone: speed, no range
  pulsed,          // time of flight
  chirp_sequence,  // fast sawtooth ramps
  triangle,        // a slow ramp up, a slow ramp down
  sinusoidal,      // sinusoidal frequency modulation
  two_slopes,      // two triangles of different duration: pairings that fit both are targets
  two_stage,       // a chirp sequence, coarse and unambiguous, then a triangle, fine
  coded_triangle,  // a flat stretch that hops between two tones by a code, between the ramps
  stepped,         // MFSK: two interleaved staircases of frequency
};

// "chirp-sequence" and so on, as on the command line.
std::string_view name(WaveformKind kind);
std::optional<WaveformKind> waveform_kind(std::string_view name);
const std::vector<WaveformKind>& all_waveform_kinds();

// Of a frame, and of a frame with all its channels.
inline constexpr double kMostFrameSamples = 1e8;

struct Segment {
  double start_s = 0.0;  // on the waveform's clock, whose zero is that of ScatterPath::range_m
  double duration_s = 0.0;
  double start_frequency_Hz = 0.0;
  double slope_Hz_per_s = 0.0;
  int slot = 0;   // transmitter of a time-division array
  int stage = 0;  // segments of one stage have the same duration and make one cube

  double middle_frequency_Hz() const {
    return start_frequency_Hz + 0.5 * slope_Hz_per_s * duration_s;
  }
  double middle_s() const { return start_s + 0.5 * duration_s; }
};

struct SinusoidalModulation {
  double deviation_Hz = 0.0;  // peak to peak
  double frequency_Hz = 0.0;
};

struct Waveform {
  WaveformKind kind = WaveformKind::continuous;
  std::vector<Segment> segments;  // in order of start
  double centre_frequency_Hz = 0.0;
  double bandwidth_Hz = 0.0;  // swept or hopped over; 0 for a lone tone; of a pulse, 1 / width
  std::vector<double> sample_rate_Hz;  // of every stage
  // Real samples fold negative beat frequencies onto positive ones.
  bool complex_baseband = true;
  SinusoidalModulation sinusoidal;  // of kind sinusoidal
  double pulse_width_s = 0.0;       // of kind pulsed

  double wavelength_m() const;
  int stages() const;
  double duration_s() const;  // first start to last end
};

// Segments of one stage, in order. One chirp of a cube is `slots` of them.
std::vector<Segment> stage_segments(const Waveform& waveform, int stage);
int slots(const std::vector<Segment>& stage);
double middle_s(const std::vector<Segment>& stage);            // of all its segments, not empty
int samples_per_segment(const Waveform& waveform, int stage);  // the last partial one is dropped

// Throws InputError for anything a hand-made waveform may get wrong: values that are not finite or
// not positive, unordered or overlapping segments, unequal durations in a stage, slots out of turn,
// more than 1e6 segments or 1e8 samples in all.
void check(const Waveform& waveform);

}  // namespace fanbeam::signal
