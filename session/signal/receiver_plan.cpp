#include "session/signal/receiver_plan.h"

#include <algorithm>
#include <cmath>

#include "signal/receiver/receiver_noise.h"

namespace fanbeam::session {
namespace {

double largest_W(const signal::FloatCube& samples) {
  double largest = 0.0;
  for (const std::complex<float>& sample : samples.values)
    largest = std::max(largest, static_cast<double>(std::norm(sample)));
  return largest;
}

// Of the channel that has most.
double energy_W(const signal::FloatCube& samples) {
  double most = 0.0;
  for (int channel = 0; channel < samples.shape.channels; ++channel) {
    double sum = 0.0;
    for (std::size_t i = samples.index(channel, 0, 0); i < samples.index(channel + 1, 0, 0); ++i)
      sum += static_cast<double>(std::norm(samples.values[i]));
    most = std::max(most, sum);
  }
  return most;
}

}  // namespace

SignalBudget signal_budget(const scenes::Scene& scene) {
  return {scene.plan, scene.accuracy_grey, scene.options.wishes};
}

core::EffectPlan receiver_plan(const SignalBudget& budget, const SamplesShown& shown,
                               const FmcwReceiver& receiver, double echo_W,
                               const signal::FloatCube& beat,
                               const signal::FloatCube& interference) {
  renderer::SignalFacts signal;
  signal.window_dB = shown.window_dB;
  signal.samples_asked = shown.samples_asked;
  signal.beams = shown.beams;
  signal.echo_W = echo_W;
  signal.largest_sample_sqrtW = (std::sqrt(largest_W(beat)) + std::sqrt(largest_W(interference))) *
                                (receiver.complex_baseband ? 1.0 : std::sqrt(2.0));
  signal.interference_W = energy_W(interference);
  signal.noise_sample_W = signal::noise_sample_W(receiver.noise_figure, receiver.sample_rate_Hz);
  signal.complex_baseband = receiver.complex_baseband;
  if (!receiver.phase_noise.empty() && echo_W > 0.0) {
    const signal::ResidualPhase residual =
        signal::residual_phase(receiver.phase_noise, receiver.longest_delay_s,
                               receiver.sample_rate_Hz, beat.shape.samples);
    signal.phase_noise_rad = residual.largest_rms_rad;
    signal.phase_noise_peak = receiver.sample_rate_Hz * residual.largest_density_rad2_per_Hz;
  }
  signal.full_scale_sqrtW = receiver.full_scale_sqrtW;
  signal.adc_bits = receiver.adc_bits;
  renderer::SceneFacts facts;
  facts.sample = true;
  facts.signal = signal;
  return renderer::signal_plan(budget.sequence, facts, budget.accuracy_grey, budget.wishes);
}

void keep_larger(const core::EffectPlan& other, core::EffectPlan& plan) {
  if (plan.decisions.empty()) plan = other;
  for (std::size_t i = 0; i < plan.decisions.size(); ++i)
    if (other.decisions[i].bound_dB > plan.decisions[i].bound_dB)
      plan.decisions[i] = other.decisions[i];
}

}  // namespace fanbeam::session
