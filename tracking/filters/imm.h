// Interacting multiple models: one target, several laws of motion, one probability each.
//
// Each step mixes the models' states by the probability that the target came to model j from i,
//   w(i|j) = p_ij mu_i / sum_i p_ij mu_i,
// predicts and updates each filter, and weighs the models with the likelihood of the innovation.
// Models keep their own states: those of position and velocity are common and mixed; what a model
// has beyond them (acceleration, turn rate) is kept from that model itself, uncorrelated with what
// comes from others, which biases nothing.
// p_ij over a step T: a model is left after `sojourn_s` on average, 1 - exp(-T / sojourn) in a
// step, to the others in equal parts. Nothing happens in a step of 0.
// Source: H. A. P. Blom, Y. Bar-Shalom, IEEE Trans. AC-33, 1988; for unequal states K. Granstrom,
// P. Willett, Y. Bar-Shalom, "Systematic approach to IMM mixing for unequal dimension states", IEEE
// Trans. AES-51, 2015. Neglected: modes that depend on the state.
// Errors as of motion.h and observation.h; the state is then unchanged.
#pragma once

#include <vector>

#include "tracking/filters/kalman.h"
#include "tracking/filters/motion.h"

namespace fanbeam::tracking {

struct ImmModel {
  std::vector<MotionModel> motions;  // at least one; all of the same axes
  double sojourn_s = 2.0;            // above 0
  // How likely each model is when a track starts; none: all alike. As many as there are models, above 0.
  std::vector<double> at_start{};

  int axes() const { return motions.front().axes; }
};

struct ImmState {
  std::vector<Gaussian> states;       // of each model
  std::vector<double> probabilities;  // sum 1
  int axes = 2;
  bool operator==(const ImmState&) const = default;
};

// Starts every model from position and velocity. Accelerations start at 0 with this standard deviation, turns by
// their own law (add_turn). E-RANGE for no model, another number of `at_start`, one of other axes than the first (a
// turn has two), or a state that is not of two components for each axis.
struct ImmStart {
  double acceleration_sigma_mps2 = 3.0;
};
ImmState start_imm(const ImmModel& model, const Gaussian& kinematic, const ImmStart& start = {});

void predict(const ImmModel& model, double step_s, ImmState& state);

// `applied` where at least one filter's innovation could be inverted. The normalised innovation is
// that of the likeliest model, the likelihood that of the mixture.
Update update(ImmState& state, Measured measured, const RadarMeasurement& measurement);
// What the update would tell, without changing or copying the state; the gain is left empty.
Update innovation(const ImmState& state, Measured measured, const RadarMeasurement& measurement);

// Position and velocity of the mixture: x, y, vx, vy; r, v on one axis.
Gaussian combined(const ImmState& state);

}  // namespace fanbeam::tracking
