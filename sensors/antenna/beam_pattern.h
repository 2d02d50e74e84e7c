// Antenna pattern cuts: gain at an angle, integrals, directivity, and a fast table for hot loops.
//
// Shapes; g(x) is one-way power relative to the peak, x the angle from it, w the half-power width:
//   gaussian      g = exp(-4 ln2 (x/w)^2)
//   sinc_squared  g = (sin(pi u) / (pi u))^2, u = k sin x: the far field of a uniformly lit
//                 aperture, k such that g(w/2) = 1/2
//                 (Balanis, Antenna Theory, 4th ed., chapter 12)
//   table         linear interpolation of power gain between the given angles, zero outside them
// Beyond `cut_rad` on either side every shape is zero. The two-way pattern is g^2.
//
// Input: half-power width 0.01 to 180 deg (the table brings its own), cut up to 180 deg, 90 deg
// for sinc_squared; sensor_file.h checks this.
// Neglected: cross-polarisation, side lobes other than those of the shape, the back lobe.
#pragma once

#include <cstddef>
#include <vector>

#include "sensors/sensor.h"

namespace fanbeam::sensors {

// sin(pi u) / (pi u): 1 at 0, exactly 0 at every other whole number. Relative error 1e-15.
double normalised_sinc(double u);

// Power relative to the peak, 0 to 1; 0 for NaN.
double one_way_gain(const BeamCut& cut, double offset_rad);
double two_way_gain(const BeamCut& cut, double offset_rad);

// Integral of the two-way pattern from one angle to another, in rad; negative when `to` < `from`.
// gaussian: difference of error functions, absolute error 1e-16 rad; table: exact;
// sinc_squared: Gauss-Legendre, 8 points per tenth of a half-power width, relative error 1e-12.
double two_way_integral(const BeamCut& cut, double from_rad, double to_rad);

// The same over the whole pattern: the width of the rectangular beam that returns as much from
// even ground.
// 0.7527 half-power widths for a Gaussian: 0.60215 deg for 0.8 deg.
double two_way_width(const BeamCut& cut);

// 4 pi over the integral of the normalised pattern g_az(azimuth) g_el(elevation - boresight) over
// the sphere.
//
// The solid angle depends on what azimuth means: for a scan over cones it is cos(azimuth) d
// azimuth d elevation; for a plane scan cos(elevation) d azimuth d elevation, hence 0.02 dB more
// for 10 deg of elevation beam at -3.8 deg. HiVision: 36.58 dB (cone). Relative error 1e-10
// (smooth shapes and tables).
double directivity(const Antenna& antenna, ScanSurface surface);

// The two-way gain from a uniform table with linear interpolation.
//
// Step: half-power width / 1024, at most 2^20 steps over the cut. Error at most 1.4e-6 of the peak
// for Gaussian and sinc_squared (step^2 / 8 times the largest second derivative), and for the
// Gaussian less than 2e-4 dB down to -60 dB; for a table, step times its steepest slope. The edge
// of the cut is exact.
// Cost: one multiplication, one load of two neighbours; 26 kB for HiVision's azimuth.
class TwoWayTable {
 public:
  explicit TwoWayTable(const BeamCut& cut);

  double operator()(double offset_rad) const noexcept {
    const double position = (offset_rad + cut_rad_) * steps_per_rad_;
    if (!(position >= 0.0 && position <= last_step_)) return 0.0;  // also NaN
    const auto step = static_cast<std::size_t>(position);
    const double share = position - static_cast<double>(step);
    return gain_[step] + share * (gain_[step + 1] - gain_[step]);
  }

  double cut_rad() const noexcept { return cut_rad_; }

 private:
  double cut_rad_ = 0.0;
  double steps_per_rad_ = 0.0;
  double last_step_ = 0.0;
  std::vector<double> gain_;  // one more than the nodes, so that the right end needs no branch
};

}  // namespace fanbeam::sensors
