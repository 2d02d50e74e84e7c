// Antenna pattern cuts: gain at an angle, integrals, directivity, and a fast table for hot loops.
//
// Shapes; g(x) is one-way power relative to the peak, x the angle from it, w the half-power width:
//   gaussian      g = exp(-4 ln2 (x/w)^2)
//   sinc_squared  g = (sin(pi u) / (pi u))^2, u = k sin x: the far field of a uniformly lit
//                 aperture, k such that g(w/2) = 1/2
//                 (Balanis, Antenna Theory, 4th ed., chapter 12)
//   cosine_aperture  g = (cos(pi u) / (1 - 4 u^2))^2, u = k sin x: an aperture lit as a cosine,
//                 first side lobe -23.0 dB (Balanis, 4th ed., table 12.1)
//   cosecant_squared  the Gaussian down to y = -x = y1 below the peak, from there to y2
//                 g = g(y1) sin^2(d1) / sin^2(d), d the depression below the horizon, d1 at y1:
//                 flat ground gives equal power at all ranges (Skolnik, Introduction to Radar
//                 Systems, 3rd ed., section 9.11); above the peak the Gaussian
//   table         linear interpolation of power gain between the given angles, zero outside them
// Beyond `cut_rad` on either side every shape is zero: that is the main beam, which all functions
// here mean unless they say otherwise. The two-way pattern is g^2.
// Side lobes: a uniform one-way level from the cut to `side_lobe_extent_rad`, which stands for the
// mean of lobes and scatter; nulls inside the cut are not filled.
//
// Input: half-power width 0.01 to 180 deg (the table brings its own), cut up to 180 deg, 90 deg
// for sinc_squared; sensor_file.h checks this.
// Neglected: cross-polarisation, the structure of the side lobes.
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

// The same with the side lobes behind the cut.
double one_way_gain_with_side_lobes(const BeamCut& cut, double offset_rad);
double two_way_gain_with_side_lobes(const BeamCut& cut, double offset_rad);

// How far from the peak the pattern reaches, side lobes included.
double reach_rad(const BeamCut& cut);

// The cut without side lobes: no level behind the cut, and a sinc or cosine aperture ends at its
// first null.
BeamCut main_beam(const BeamCut& cut);

// Integral of the two-way pattern from one angle to another, in rad; negative when `to` < `from`.
// gaussian: difference of error functions, absolute error 1e-16 rad; table: exact;
// sinc_squared: Gauss-Legendre, 8 points per tenth of a half-power width, relative error 1e-12.
double two_way_integral(const BeamCut& cut, double from_rad, double to_rad);

// The same over the whole pattern: the width of the rectangular beam that returns as much from
// even ground.
// 0.7527 half-power widths for a Gaussian: 0.60215 deg for 0.8 deg.
double two_way_width(const BeamCut& cut);

// 4 pi over the integral of the normalised pattern g_az(azimuth) g_el(elevation - boresight) over
// the sphere, side lobes included.
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
// of the cut is exact. With side lobes the table reaches as far as they do, and the jump at the cut
// is smeared over one step.
// Cost: one multiplication, one load of two neighbours; 26 kB for HiVision's azimuth.
class TwoWayTable {
 public:
  explicit TwoWayTable(const BeamCut& cut);  // with its side lobes

  double operator()(double offset_rad) const noexcept {
    const double position = (offset_rad + reach_rad_) * steps_per_rad_;
    if (!(position >= 0.0 && position <= last_step_)) return 0.0;  // also NaN
    const auto step = static_cast<std::size_t>(position);
    const double share = position - static_cast<double>(step);
    return gain_[step] + share * (gain_[step + 1] - gain_[step]);
  }

 private:
  double reach_rad_ = 0.0;
  double steps_per_rad_ = 0.0;
  double last_step_ = 0.0;
  std::vector<double> gain_;  // one more than the nodes, so that the right end needs no branch
};

}  // namespace fanbeam::sensors
