// The exact phase of a beat signal.
//
// With tau the delay at the time t of reception, t counted from the segment's start, transmitted
// minus received phase:
//   linear      phi = 2 pi (f0 tau + S t tau - S tau^2 / 2)
//   sinusoidal  phi = 2 pi f0 tau + (D / fm) sin(2 pi fm (t - tau / 2)) sin(pi fm tau)
// The second is a difference of cosines as a product, so nothing cancels. The delay is that of the
// two straight lines transmitter - scatterer - receiver, exact for every pair of elements:
//   tau c = |x - p_t| + |x - p_r|,  x = (R + v t) u .
// The scatterer moves along its line of sight at constant speed.
// Neglected: motion between scattering and reception (2 |v| R / c, 0.02 mm at 100 m and 100 km/h),
// relativity, dispersion.
// Accuracy: the rounding of f0 tau, 1e-10 rad at 100 m and 2e-9 rad at 4 km.
#pragma once

#include <glm/vec3.hpp>

#include "signal/scatter_path.h"
#include "signal/waveform/array.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::signal {

// Two-way length of one path for one pair of elements, and how fast it grows.
struct PathLength {
  double length_m = 0.0;
  double rate_mps = 0.0;
};

class PathGeometry {
 public:
  PathGeometry(const ScatterPath& path, const glm::dvec3& transmitter_m,
               const glm::dvec3& receiver_m);
  PathLength at(double time_s) const;

 private:
  double range_m_, speed_mps_;
  double along_m_[2];    // u . p of transmitter and receiver
  double square_m2_[2];  // p . p
};

// Turns (phase / 2 pi), not reduced.
double beat_turns(const Waveform& waveform, const Segment& segment, double in_segment_s,
                  double delay_s);

// Throws InputError: a value that is not finite, a range not above 0 or not below 1e7 m at both
// ends of the waveform, a speed of 1e5 m/s or more.
void check(const Waveform& waveform, const std::vector<ScatterPath>& paths);

}  // namespace fanbeam::signal
