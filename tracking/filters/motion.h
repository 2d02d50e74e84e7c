// How a target moves between measurements: constant velocity, constant acceleration, smooth turn.
//
// constant_velocity      each axis: r += v T; white acceleration, constant inside a step,
//                        Q = sa^2 [[T^4/4, T^3/2], [T^3/2, T^2]]
// constant_acceleration  each axis: r += v T + a T^2/2, v += a T; white jerk of density q,
//                        Q = q [[T^5/20, T^4/8, T^3/6], [T^4/8, T^3/3, T^2/2], [T^3/6, T^2/2, T]]
// smooth_turn            planar: the velocity over ground turns at the rate w and grows by the acceleration a along it,
//                        both evenly inside a step, with their means u and p; R(.) turns right,
//                        x += s gx - c gy - ex T, y += c gx + s gy - ey T, (x, y) += R(u T / 2) n P,
//                        g := R(u T) (g + n p T),
//                        s = sin(u T)/u, c = (1 - cos(u T))/u, g = v + e, n along g (forward where g is below 0.5 m/s),
//                        P the acceleration integrated twice;
//                        w = f + b: steering f, which returns to 0, and the road's bend b, which lasts. f, f', f'',
//                        b, a, a' and a'' are states; (d/dt + k)^3 f is white noise of density 16/3 sf^2 k^5, so that f
//                        has the standard deviation sf and is forgotten within some 3 / k; a likewise, with its
//                        own; b is a random walk of density qb
// Who steers turns a wheel, who drives presses a pedal, which takes time: neither jumps, and nothing but these two moves
// a car. How smooth a model takes that to be decides how true its errors are on who drives straight on: where
// position is the n-th integral of white noise, position and speed of a target without any have a normalised error
// squared of 2 - 2/n instead of 2 (tests/tracking/consistency_test.cpp). Here n is 5, for white acceleration 2.
// e is the radar's own velocity over ground, constant; v is relative to the radar.
// Where neither is known, to 1 m/s or half of g, the product of their errors matters, which a linearised turn leaves out: then
// there is white acceleration along g too, constant inside a step. Without, a car whose speed across and turn are not yet
// known (20 m/s, 0.3 rad/s) is believed to turn a second late, and errs by twice what it tells until then.
// Source: Y. Bar-Shalom, X. R. Li, T. Kirubarajan, "Estimation with Applications to Tracking and
// Navigation", 2001, 6.2, 6.3 and 11.7; noise in a derivative of the curvature: E. D. Dickmanns, B. D. Mysliwetz,
// "Recursive 3-D road and relative ego-state recognition", IEEE Trans. PAMI-14, 1992; the law of f and a (Matern, 5/2) as a
// state: J. Hartikainen, S. Sarkka, "Kalman filtering and smoothing solutions to temporal Gaussian process regression
// models", IEEE MLSP, 2010.
// Neglected: rotation and acceleration of the radar; how w changes inside a step (for positions, w' T^3 |g| / 12: 10 um
// at 30 m/s, 50 ms and 0.03 rad/s2). For small u T the limits of s and c are used: both forms agree to 1e-10 at the
// change. Transition and noise of f, b and a are exact for any step.
// Of the noise within a step, place and velocity get a fixed share of that at its end, which is right for short
// steps: at 30 m/s, with steering known as add_turn tells it and no bend at first, a step of 1 s tells 1.20 m across where 400
// steps tell 1.33 m; 2 s 3.27 and 4.72 m, 3 s 5.56 and 9.46 m (sf 0.095 rad/s, 1 / k 0.32 s).
// Inputs: 0 leaves the state alone; a negative step is E-TIME, one that is not finite E-NONFINITE;
// noise that is negative and a time that is not above 0 E-RANGE. The state is then unchanged.
#pragma once

#include "tracking/filters/gaussian.h"

namespace fanbeam::tracking {

enum class MotionKind { constant_velocity, constant_acceleration, smooth_turn };

struct MotionModel {
  MotionKind kind = MotionKind::constant_velocity;
  int axes = 2;                            // 1: range alone; 2: planar (a turn is always planar)
  double acceleration_mps2 = 1.0;          // sa; of a smooth turn, while its velocity is not known
  double jerk_density_m2_per_s5 = 1.0;     // q
  double lateral_jerk_share = 1.0;         // of q, on the second axis: cars brake along the road
  double steering_sigma_rad_per_s = 0.1;   // sf
  double steering_time_s = 0.3;            // 1 / k
  double along_sigma_mps2 = 0.2;           // of a
  double along_time_s = 0.3;               // 1 / k of a
  double bend_density_rad2_per_s3 = 1e-5;  // qb
  double bend_sigma_rad_per_s = 0.3;       // of b when a track starts
  std::array<double, 2> radar_velocity_mps = {0.0, 0.0};  // e: forward, right
};

// 2, 3 for one axis; 4, 6, 11 for the plane.
int states(const MotionModel& model);

// Position and velocity of the plane become a state of smooth_turn whose turn and acceleration are any: 0, with the
// spread that steering has at any time, sf^2 [[1, 0, -k^2/3], [0, k^2/3, 0], [-k^2/3, 0, k^4]], likewise the acceleration's,
// and the bend's when a track starts.
void add_turn(const MotionModel& model, Gaussian& state);

void predict(const MotionModel& model, double step_s, Gaussian& state);

}  // namespace fanbeam::tracking
