// What a waveform can measure: cells, widths, unambiguous spans, and the beats of a target.
//
// With slope S, bandwidth B, interval Tc between chirps of one transmitter, frame Tf, rate fs:
//   range cell c / 2B, its half-power width 0.8858 cells without a window, 1.1869 with a Taylor
//   window (nbar 5, -35 dB); the two are not the same figure and are told apart here;
//   unambiguous range fs c / 2S, half of it for real samples;
//   speed cell lambda / 2 Tf, unambiguous speed lambda / 4 Tc: [-that, +that).
// A beat is transmitted minus received frequency, complex, with its sign:
//   fb = S tau (1 - tau') + f_mid tau' at mid segment, tau = 2 R / c, tau' = 2 v / c,
// and drifts by 2 S tau' T over the ramp (v is positive receding).
// Sources: as of factories.h, and M. A. Richards, "Fundamentals of Radar Signal Processing", 2nd
// ed., ch. 4. Speeds are taken as small against c; exact Doppler is in doppler.h.
#pragma once

#include <optional>
#include <vector>

#include "signal/waveform/waveform.h"

namespace fanbeam::signal {

inline constexpr double kRectangularWidthCells = 0.8858;
inline constexpr double kTaylorWidthCells = 1.1869;  // nbar 5, -35 dB

// Empty where a stage does not measure it.
struct StageFigures {
  double segment_s = 0.0;
  int segments = 0;
  int samples = 0;  // per segment
  double slope_Hz_per_s = 0.0;
  double frequency_bin_Hz = 0.0;  // 1 / T
  double beat_Hz_per_m = 0.0;     // 2 |S| / c
  // Range read too long by a sawtooth alone: fc / S of speed.
  std::optional<double> coupling_m_per_mps;
  std::optional<double> range_cell_m;
  std::optional<double> rectangular_width_m;
  std::optional<double> taylor_width_m;
  std::optional<double> unambiguous_range_m;
  std::optional<double> speed_cell_mps;
  std::optional<double> unambiguous_speed_mps;  // [-this, +this)
};

// One entry for every stage.
std::vector<StageFigures> figures(const Waveform& waveform);

// Beat at the middle of a segment; range and speed at that moment.
double beat_Hz(const Segment& segment, double range_m, double radial_speed_mps);

}  // namespace fanbeam::signal
