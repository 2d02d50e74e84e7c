// One step of the smooth turn (motion.h). Private: carries the matrix library's types.
#pragma once

#include "tracking/filters/matrices_private.h"
#include "tracking/filters/motion.h"

namespace fanbeam::tracking {

// Where a turn's state has f, f', f'', then b, then a, a', a''.
inline constexpr int kSteering = 4, kBend = 7, kAlong = 8, kTurnStates = 11;

struct MotionStep {
  Vector mean;
  Matrix jacobian, noise;
};

MotionStep turn_step(const MotionModel& model, double step_s, const Gaussian& state);

}  // namespace fanbeam::tracking
