// Range and speed from the beats of a ramp up and a ramp down.
//
// With R and v at the turnaround (the middle between the ramps), tau' = 2 v / c, h the time from
// the turnaround to the middle of a ramp, S the slope up, the beats at mid ramp are
//   up    fu =  S (2 R / c -+ tau' h) (1 - tau') + fc tau'
//   down  fd = -S (2 R / c +- tau' h) (1 - tau') + fc tau'      (upper sign: up first)
// so that
//   v = c (fu + fd) / (4 (fc -+ S h (1 - tau'))),   R = c (fu - fd) / (4 S (1 - tau')) .
// For ramps that meet, S h = B / 2: the speed is scaled by the frequency at which they meet, fc -
// B/2 for up first (down first fc + B/2). The centre frequency instead would bias it by B / 2 fc,
// 0.16 % of v. Without 1 - tau' the range would be long by 2 |v| R / c.
// Beats keep their sign (complex baseband): with magnitudes a slow ramp and a fast closing target
// give a wrong pair.
// Source: A. G. Stove, IEE Proc. F 139(5), 1992; derivation above. Neglected: acceleration.
// Accuracy with exact beats at mid ramp: 1e-9 m, 1e-10 m/s at 200 m, 60 m/s.
#pragma once

#include <vector>

#include "signal/waveform/waveform.h"

namespace fanbeam::signal {

struct RangeSpeed {
  double range_m = 0.0;
  double radial_speed_mps = 0.0;
};

struct BeatPair {
  double up_Hz = 0.0, down_Hz = 0.0;
};

struct TriangleModel {
  double centre_frequency_Hz = 0.0;
  double slope_Hz_per_s = 0.0;  // of the ramp up
  double ramp_s = 0.0;
  // From the turnaround to the middle of the ramp up: negative when it comes first.
  double up_middle_s = 0.0;
  double turnaround_s = 0.0;  // on the waveform's clock

  double bin_Hz() const { return 1.0 / ramp_s; }
};

// Of a stage that is a triangle; of a coded triangle (any stage) both ramps around the flat
// stretch. E-UNSUPPORTED for others.
TriangleModel triangle_model(const Waveform& waveform, int stage);

// Range at the turnaround.
RangeSpeed solve(const TriangleModel& model, const BeatPair& beats);
BeatPair predict(const TriangleModel& model, const RangeSpeed& target);

// Which solutions are taken for targets at all.
struct PairingLimits {
  double least_range_m = 0.0, most_range_m = 250.0;
  double most_speed_mps = 70.0;
  bool allow(const RangeSpeed& target) const;
};

// The k-th beat of one ramp with the k-th of the other, by amount of range frequency: right for
// targets whose order is the same on both ramps, cheap, and wrong for the rest.
std::vector<RangeSpeed> pair_sorted(const TriangleModel& model, std::vector<double> up_Hz,
                                    std::vector<double> down_Hz, const PairingLimits& limits);

// All M^2 pairs inside the limits: the targets and up to M^2 - M ghosts.
std::vector<RangeSpeed> pair_all(const TriangleModel& model, const std::vector<double>& up_Hz,
                                 const std::vector<double>& down_Hz, const PairingLimits& limits);

}  // namespace fanbeam::signal
