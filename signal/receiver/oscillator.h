// What is left of an oscillator's phase noise in beat signals, echo by echo.
//
// Transmitter and mixer share the oscillator. Its phase theta(t) turns an echo of delay tau by
// theta(t) - theta(t - tau): range correlation, which lets near echoes keep
//   S_beat(f) = 4 sin^2(pi f tau) S_theta(f).
// S_theta(f), of both sides, is L(f) in dBc/Hz at the offset |f|: a table, straight lines over the
// logarithm of the offset, level before the first and after the last, or a Lorentzian line of width D,
// L = D / (2 pi f^2) (so that the variance of the difference is 2 pi D tau).
// Draws: theta over every chirp apart, Gaussian, by a Fourier sum of offsets up to half the sample
// rate, from 1 / 8 of that of a chirp up; what an oscillator wanders more slowly cancels within a
// chirp but for its slope. Chirps are independent.
// Sources: M. C. Budge, M. P. Burt, "Range correlation effects in radars", IEEE Radar Conf. 1993;
// IEEE Std 1139-2008 (L and S).
// Inputs: 1 to 100 offsets, rising, above 0 to 1e12 Hz; levels -300 to 60 dBc/Hz. E-RANGE otherwise.
#pragma once

#include <cstddef>
#include <vector>

#include "core/random.h"
#include "signal/cube.h"
#include "signal/waveform/array.h"

namespace fanbeam::signal {

struct PhaseNoiseTable {
  std::vector<double> offsets_Hz;
  std::vector<double> levels_dBc_per_Hz;
  bool empty() const { return offsets_Hz.empty(); }
};

// A line of that width as a table from 1 Hz to 1 GHz: two places are enough, as both axes are logarithmic.
PhaseNoiseTable lorentzian(double line_width_Hz);

void check(const PhaseNoiseTable& table);

// L at an offset, as a number.
double phase_density_rad2_per_Hz(const PhaseNoiseTable& table, double offset_Hz);

// Of theta(t) - theta(t - delay), in the band of the draws.
struct ResidualPhase {
  double rms_rad = 0.0;
  // For this delay and all shorter ones: of the rms, and of the density of both sides.
  double largest_rms_rad = 0.0, largest_density_rad2_per_Hz = 0.0;
};
ResidualPhase residual_phase(const PhaseNoiseTable& table, double delay_s, double sample_rate_Hz,
                             int samples);

// Turns the echoes of one delay. The same key gives the same theta for every delay. Transmitters that take
// turns have chirps, and draws, of their own.
void apply_oscillator(const PhaseNoiseTable& table, double delay_s, double sample_rate_Hz,
                      const core::RandomKey& key, const Array& array, FloatCube& cube);

// Echoes that may share a delay. Up to 32 echoes keep their own; more are gathered where delays lie
// within a 32nd of the logarithm of their span: 9 % of the delay and 0.8 dB of the residue, for delays up
// to 300 times the shortest.
struct DelayGroup {
  double delay_s = 0.0;
  std::vector<std::size_t> members;
};
std::vector<DelayGroup> delay_groups(const std::vector<double>& delays_s);

}  // namespace fanbeam::signal
