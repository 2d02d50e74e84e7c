// How well a radar could measure a point target: the bounds of one triangle and of a line array.
//
//   e        signal-to-noise ratio after one ramp of T = radar.ramp_s, from the link budget
//   sigma_R  (c / 2B) sigma_bin / sqrt 2,  sigma_bin = sqrt(6 / e) / (2 pi)
//   sigma_v  (lambda / 4) sqrt 2 sigma_bin / T
//   azimuth  sqrt(6 / (r N (N^2 - 1))) / (2 pi d/lambda cos azimuth),  r = e / N
// Source: S. M. Kay, "Fundamentals of Statistical Signal Processing" I, 1993, 3.11; P. Stoica, A.
// Nehorai, IEEE Trans. ASSP-37, 1989. They hold above 15 dB; below, outliers take over.
// Errors as of signal/receiver/link_budget.h.
#pragma once

#include "core/highway.h"

namespace fanbeam::tracking {

inline constexpr double kLeastSignalToNoise = 31.622776601683793;  // 15 dB

struct MeasurementBound {
  double signal_to_noise = 0.0;
  double range_sigma_m = 0.0, range_rate_sigma_mps = 0.0, azimuth_sigma_rad = 0.0;
};
// At a ratio e that is known.
MeasurementBound bound_at(const core::HighwayRadar& radar, double signal_to_noise,
                          double azimuth_rad);
MeasurementBound measurement_bound(const core::HighwayRadar& radar, double cross_section_m2,
                                   double range_m, double azimuth_rad);

}  // namespace fanbeam::tracking
