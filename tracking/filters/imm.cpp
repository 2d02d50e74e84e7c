#include "tracking/filters/imm.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/errors.h"

namespace fanbeam::tracking {
namespace {

// The state of model `from` in the shape of model `to`: what `from` lacks beyond the first `common`
// components comes from `to` itself.
Gaussian in_shape_of(const Gaussian& from, const Gaussian& to, int common) {
  Gaussian result = to;
  for (int row = 0; row < common; ++row) {
    result.mean[static_cast<std::size_t>(row)] = from.mean[static_cast<std::size_t>(row)];
    for (int column = 0; column < to.size; ++column) {
      const double value = column < common ? from.variance(row, column) : 0.0;
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
      parts.push_back(
          {weight, from == to ? state.states[from]
                              : in_shape_of(state.states[from], state.states[to], 2 * state.axes)});
    }
    if (total > 0.0) result.states[to] = moments(parts);
    result.probabilities[to] = total;
  }
  return result;
}

// The mixture's update from those of its models. `probabilities` become those after it, unless no
// model's was applied.
Update mixture_of(const std::vector<Update>& told, std::vector<double>& probabilities) {
  double best = -std::numeric_limits<double>::infinity();
  Update result;
  for (std::size_t i = 0; i < told.size(); ++i) {
    const double weight = std::log(std::max(probabilities[i], 1e-300));
    if (!told[i].applied || told[i].log_likelihood + weight <= best) continue;
    best = told[i].log_likelihood + weight;
    result = told[i];
  }
  if (!result.applied) return result;
  double total = 0.0;
  for (std::size_t i = 0; i < told.size(); ++i) {
    probabilities[i] *= told[i].applied ? std::exp(told[i].log_likelihood - best) : 0.0;
    total += probabilities[i];
  }
  for (double& probability : probabilities) probability /= total;
  result.log_likelihood = best + std::log(total);
  return result;
}

}  // namespace

ImmState start_imm(const ImmModel& model, const Gaussian& kinematic, const ImmStart& start) {
  if (model.motions.empty() || !(model.sojourn_s > 0.0))
    core::throw_input_error(core::ErrorClass::range, "imm.motions",
                            static_cast<double>(model.motions.size()),
                            "at least one, and a sojourn above 0 s");
  if (!model.at_start.empty() && model.at_start.size() != model.motions.size())
    core::throw_input_error(core::ErrorClass::range, "imm.at_start",
                            static_cast<double>(model.at_start.size()),
                            "one for each model, or none");
  ImmState result;
  result.axes = model.axes();
  const int common = 2 * result.axes;
  if (kinematic.size != common)
    core::throw_input_error(core::ErrorClass::range, "imm.state.size", kinematic.size,
                            core::number_text(common));
  for (const MotionModel& motion : model.motions) {
    const bool turn = motion.kind == MotionKind::smooth_turn;
    if (motion.axes != result.axes || (turn && result.axes != 2))
      core::throw_input_error(core::ErrorClass::range, "imm.motion.axes", motion.axes,
                              "the same for all models, 2 for a turn");
    Gaussian state = kinematic;
    state.size = states(motion);
    for (int extra = common; extra < state.size; ++extra)
      state.variance(extra, extra) = std::pow(start.acceleration_sigma_mps2, 2);
    if (turn) add_turn(motion, state);
    result.states.push_back(state);
    result.probabilities.push_back(
        model.at_start.empty() ? 1.0 : model.at_start[result.probabilities.size()]);
  }
  const double all = std::accumulate(result.probabilities.begin(), result.probabilities.end(), 0.0);
  for (double& probability : result.probabilities) probability /= all;
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
  for (Gaussian& one : next.states)
    told.push_back(update(one, observe(one, state.axes, measured, measurement)));
  const Update result = mixture_of(told, next.probabilities);
  if (result.applied) state = std::move(next);
  return result;
}

Update innovation(const ImmState& state, Measured measured, const RadarMeasurement& measurement) {
  std::vector<Update> told;
  for (const Gaussian& one : state.states)
    told.push_back(innovation(one, observe(one, state.axes, measured, measurement)));
  std::vector<double> probabilities = state.probabilities;
  return mixture_of(told, probabilities);
}

Gaussian combined(const ImmState& state) {
  std::vector<WeightedGaussian> parts;
  for (std::size_t i = 0; i < state.states.size(); ++i)
    parts.push_back({state.probabilities[i], marginal(state.states[i], 2 * state.axes)});
  return moments(parts);
}

}  // namespace fanbeam::tracking
