// How a target moves between measurements: constant velocity, constant acceleration, coordinated
// turn.
//
// constant_velocity      each axis: r += v T; white acceleration, constant inside a step,
//                        Q = sa^2 [[T^4/4, T^3/2], [T^3/2, T^2]]
// constant_acceleration  each axis: r += v T + a T^2/2, v += a T; white jerk of density q,
//                        Q = q [[T^5/20, T^4/8, T^3/6], [T^4/8, T^3/3, T^2/2], [T^3/6, T^2/2, T]]
// coordinated_turn       planar: the velocity over ground turns at the rate w,
//                        x += s gx - c gy - ex T, y += c gx + s gy - ey T, g turned by w T,
//                        s = sin(w T)/w, c = (1 - cos(w T))/w, g = v + e;
//                        noise as constant velocity, and w a random walk of density qw
// e is the radar's own velocity over ground, constant; v is relative to the radar.
// Source: Y. Bar-Shalom, X. R. Li, T. Kirubarajan, "Estimation with Applications to Tracking and
// Navigation", 2001, 6.2, 6.3 and 11.7.
// Neglected: rotation and acceleration of the radar. For small w T the limits of s and c are used:
// both forms agree to 1e-10 at the change. The turn's covariance is linearised at the mean.
// Inputs: 0 leaves the state alone; a negative step is E-TIME, one that is not finite E-NONFINITE;
// noise that is negative E-RANGE. The state is then unchanged.
#pragma once

#include "tracking/filters/gaussian.h"

namespace fanbeam::tracking {

enum class MotionKind { constant_velocity, constant_acceleration, coordinated_turn };

struct MotionModel {
  MotionKind kind = MotionKind::constant_velocity;
  int axes = 2;                            // 1: range alone; 2: planar (a turn is always planar)
  double acceleration_mps2 = 1.0;          // sa
  double jerk_density_m2_per_s5 = 1.0;     // q
  double lateral_jerk_share = 1.0;         // of q, on the second axis: cars brake along the road
  double turn_density_rad2_per_s3 = 0.01;  // qw
  std::array<double, 2> radar_velocity_mps = {0.0, 0.0};  // e: forward, right
};

// 2, 3 for one axis; 4, 6, 5 for the plane.
int states(const MotionModel& model);

void predict(const MotionModel& model, double step_s, Gaussian& state);

}  // namespace fanbeam::tracking
