// What a radar measures of a target, and how it depends on the state.
//
//   range       R = r                    or  hypot(x, y)
//   range rate  v                        or  (x vx + y vy) / R
//   azimuth     (planar states alone)        atan2(y, x), positive to the right
// Jacobians of the planar form: dR = (x, y)/R; d(rate)/d(x, y) = ((vx, vy) - rate (x, y)/R)/R,
// d(rate)/d(vx, vy) = (x, y)/R; d(azimuth) = (-y, x)/R^2. The residual of the azimuth is brought
// into [-pi, pi).
// Source: Y. Bar-Shalom, X. R. Li, T. Kirubarajan, "Estimation with Applications to Tracking and
// Navigation", 2001, 10.3.
// With p and v the errors of position and velocity across the line of sight, the next order is
// p^2 / 2R in range and p v / R in range rate: its means P_pp / 2R and P_pv / R are added to what
// is expected, its variances P_pp^2 / 2R^2 and (P_pp P_vv + P_pv^2) / R^2 to the noise. Without, a
// tangential speed not yet known (20 m/s at 100 m: 0.2 m/s of range rate in 0.05 s) throws a new
// track away (M. Athans, R. P. Wishner, A. Bertolini, IEEE Trans. AC-13, 1968).
// Neglected: the correlation of these two terms, and the second order of the azimuth.
// observe() takes the noise alone; the tracker has put the rest into it (tracking/tracker/tracker.h).
// A planar state closer to the radar than 1 mm is taken as 1 mm away where it is divided by R, one at the radar itself as
// straight ahead: the second order then says how little is known, and a track that passes the radar coasts.
// Inputs: E-NONFINITE for anything not finite, E-RANGE for a negative standard deviation or azimuth for a state of one axis.
#pragma once

#include "tracking/filters/gaussian.h"

namespace fanbeam::tracking {

struct RadarMeasurement {
  double range_m = 0.0;
  double range_rate_mps = 0.0;
  double azimuth_rad = 0.0;
  // Standard deviations of noise.
  double range_sigma_m = 0.0;
  double range_rate_sigma_mps = 0.0;
  double azimuth_sigma_rad = 0.0;
  // Those of what else the source knows to be wrong: beats that neighbours pull or merge with, a
  // window's side lobes. 0 for a source that is exact but for noise. The tracker adds the squares.
  double range_systematic_m = 0.0;
  double range_rate_systematic_mps = 0.0;
  double azimuth_systematic_rad = 0.0;
};

enum class Measured { range, range_and_rate, range_rate_and_azimuth };
int dimension(Measured measured);

// A measurement linearised about a state.
struct Observation {
  int size = 0;
  std::array<double, kMostMeasured> value{};
  std::array<double, kMostMeasured> residual{};  // measured minus predicted
  std::array<double, kMostMeasured> noise{};     // variances; components are independent
  StateMatrix jacobian{};                        // `size` rows
};

// `axes` as of MotionModel.
Observation observe(const Gaussian& state, int axes, Measured measured,
                    const RadarMeasurement& measurement);

}  // namespace fanbeam::tracking
