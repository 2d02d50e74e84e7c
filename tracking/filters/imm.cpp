#include "tracking/filters/imm.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.h"

namespace fanbeam::tracking {
namespace {

constexpr int kKinematic = 4;
constexpr int kPlanarAxes = 2;

// The state of model `from` in the shape of model `to`: what `from` lacks comes from `to` itself.
Gaussian in_shape_of(const Gaussian& from, const Gaussian& to) {
  Gaussian result = to;
  for (int row = 0; row < kKinematic; ++row) {
    result.mean[static_cast<std::size_t>(row)] = from.mean[static_cast<std::size_t>(row)];
    for (int column = 0; column < to.size; ++column) {
      const double value = column < kKinematic ? from.variance(row, column) : 0.0;
      result.variance(row, column) = result.variance(column, row) = value;
    }
  }
  return result;
}

ImmState mixed(const ImmModel& model, double step_s, const ImmState& state) {
  const std::size_t count = state.states.size();
  if (count == 1) return state;
  const double leave = -std::expm1(-step_s / model.sojourn_s);
  const double other = leave / static_cast<double>(count - 1);
  ImmState result = state;
  for (std::size_t to = 0; to < count; ++to) {
    std::vector<WeightedGaussian> parts;
    double total = 0.0;
    for (std::size_t from = 0; from < count; ++from) {
      const double weight = (from == to ? 1.0 - leave : other) * state.probabilities[from];
      total += weight;
      parts.push_back({weight, from == to ? state.states[from]
                                          : in_shape_of(state.states[from], state.states[to])});
    }
    if (total > 0.0) result.states[to] = moments(parts);
    result.probabilities[to] = total;
  }
  return result;
}

}  // namespace

ImmState start_imm(const ImmModel& model, const Gaussian& kinematic, const ImmStart& start) {
  if (model.motions.empty() || !(model.sojourn_s > 0.0))
    core::throw_input_error(core::ErrorClass::range, "imm.motions",
                            static_cast<double>(model.motions.size()),
                            "at least one, and a sojourn above 0 s");
  if (kinematic.size != kKinematic)
    core::throw_input_error(core::ErrorClass::range, "imm.state.size", kinematic.size, "4");
  ImmState result;
  for (const MotionModel& motion : model.motions) {
    if (motion.axes != kPlanarAxes)
      core::throw_input_error(core::ErrorClass::range, "imm.motion.axes", motion.axes, "2");
    Gaussian state = kinematic;
    state.size = states(motion);
    const double sigma = motion.kind == MotionKind::coordinated_turn
                             ? start.turn_sigma_rad_per_s
                             : start.acceleration_sigma_mps2;
    for (int extra = kKinematic; extra < state.size; ++extra)
      state.variance(extra, extra) = sigma * sigma;
    result.states.push_back(state);
    result.probabilities.push_back(1.0 / static_cast<double>(model.motions.size()));
  }
  return result;
}

void predict(const ImmModel& model, double step_s, ImmState& state) {
  if (step_s == 0.0) return;
  if (!(step_s > 0.0))
    core::throw_input_error(
        std::isnan(step_s) ? core::ErrorClass::nonfinite : core::ErrorClass::time, "step_s", step_s,
        "0 or later");
  ImmState next = mixed(model, step_s, state);
  for (std::size_t i = 0; i < next.states.size(); ++i)
    predict(model.motions[i], step_s, next.states[i]);
  state = std::move(next);
}

Update update(ImmState& state, Measured measured, const RadarMeasurement& measurement) {
  ImmState next = state;
  std::vector<Update> told;
  double best = -std::numeric_limits<double>::infinity();
  Update result;
  for (std::size_t i = 0; i < next.states.size(); ++i) {
    told.push_back(
        update(next.states[i], observe(next.states[i], kPlanarAxes, measured, measurement)));
    const double weight = std::log(std::max(state.probabilities[i], 1e-300));
    if (!told[i].applied || told[i].log_likelihood + weight <= best) continue;
    best = told[i].log_likelihood + weight;
    result = told[i];
  }
  if (!result.applied) return result;
  double total = 0.0;
  for (std::size_t i = 0; i < next.states.size(); ++i) {
    next.probabilities[i] *= told[i].applied ? std::exp(told[i].log_likelihood - best) : 0.0;
    total += next.probabilities[i];
  }
  for (double& probability : next.probabilities) probability /= total;
  result.log_likelihood = best + std::log(total);
  state = std::move(next);
  return result;
}

Update innovation(const ImmState& state, Measured measured, const RadarMeasurement& measurement) {
  ImmState copy = state;
  return update(copy, measured, measurement);
}

Gaussian combined(const ImmState& state) {
  std::vector<WeightedGaussian> parts;
  for (std::size_t i = 0; i < state.states.size(); ++i)
    parts.push_back({state.probabilities[i], marginal(state.states[i], kKinematic)});
  return moments(parts);
}

}  // namespace fanbeam::tracking
