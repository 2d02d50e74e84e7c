#include "renderer/plan/signal_effects.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/decibel.h"
#include "renderer/plan/effect_texts.h"

namespace fanbeam::renderer {
namespace {

constexpr double kLargestNormal = 6.77;  // sqrt(2 * 33 ln 2): core/random.h

double noise_part_sqrtW(const SignalFacts& signal) {
  return std::sqrt(0.5 * signal.noise_sample_W);
}

double largest_part_sqrtW(const SignalFacts& signal) {
  return signal.largest_sample_sqrtW + kLargestNormal * noise_part_sqrtW(signal);
}

double step_sqrtW(const SignalFacts& signal) {
  return std::ldexp(
      signal.full_scale_sqrtW > 0.0 ? signal.full_scale_sqrtW : largest_part_sqrtW(signal),
      1 - signal.adc_bits);
}

// Of real samples the other half of the spectrum adds its own.
double images_of(const SignalFacts& signal) { return signal.complex_baseband ? 1.0 : 2.0; }

bool may_clip(const SignalFacts& signal) {
  return signal.full_scale_sqrtW > 0.0 && largest_part_sqrtW(signal) > signal.full_scale_sqrtW;
}

// Noise is there to hide behind, and only pictures are asked for.
bool noise_hides(const SceneFacts& facts) {
  return facts.noise_shown && facts.signal->noise_sample_W > 0.0 && !facts.signal->samples_asked;
}

std::string whole_text(const std::string& what, const SceneFacts& facts) {
  const SignalFacts& signal = *facts.signal;
  if (signal.samples_asked) return what + ": samples are asked for, and show it whatever it is";
  return what + " can change the picture's whole window of " + figure_text(signal.window_dB) +
         " dB" + (facts.noise_shown ? "" : ", since no noise hides it");
}

}  // namespace

bool has_phase_noise(const SceneFacts& facts) {
  return facts.signal && facts.signal->phase_noise_rad > 0.0;
}

bool has_quantiser(const SceneFacts& facts) { return facts.signal && facts.signal->adc_bits > 0; }

bool has_interference(const SceneFacts& facts) {
  return facts.signal && facts.signal->interference_W > 0.0;
}

double phase_noise_bound_dB(const SceneFacts& facts) {
  const SignalFacts& signal = *facts.signal;
  if (!noise_hides(facts)) return signal.window_dB;
  const double variance = signal.phase_noise_rad * signal.phase_noise_rad;
  const double pedestal_W = signal.beams * signal.echo_W * images_of(signal) *
                            signal.phase_noise_peak *
                            (variance > 0.0 ? -std::expm1(-variance) / variance : 1.0);
  const double raised_dB = core::kDecibelsPerNeper * std::log1p(pedestal_W / signal.noise_sample_W);
  return std::min(signal.window_dB, std::max(raised_dB, core::kDecibelsPerNeper * variance));
}

double quantiser_bound_dB(const SceneFacts& facts) {
  const SignalFacts& signal = *facts.signal;
  if (!noise_hides(facts)) return signal.window_dB;
  const double steps = step_sqrtW(signal) / noise_part_sqrtW(signal);
  if (!(steps <= 1.0) || may_clip(signal)) return signal.window_dB;
  return std::min(signal.window_dB, core::kDecibelsPerNeper * std::log1p(steps * steps / 12.0));
}

double interference_bound_dB(const SceneFacts& facts) {
  const SignalFacts& signal = *facts.signal;
  if (!noise_hides(facts)) return signal.window_dB;
  const double energy_W = signal.beams * images_of(signal) * signal.interference_W;
  return std::min(signal.window_dB,
                  core::kDecibelsPerNeper * std::log1p(energy_W / signal.noise_sample_W));
}

std::string receiver_noise_cause(const SceneFacts& facts, double) {
  return whole_text("the receiver's noise, on which thresholds, colours and watts stand,", facts);
}

std::string phase_noise_cause(const SceneFacts& facts, double bound_dB) {
  const SignalFacts& signal = *facts.signal;
  const std::string what = "phase noise of " + figure_text(signal.phase_noise_rad) + " rad";
  if (bound_dB >= signal.window_dB) return whole_text(what, facts);
  return what + " of echoes of " +
         figure_text(10.0 * std::log10(signal.echo_W / signal.noise_sample_W)) +
         " dB over the noise of a sample can change a cell by up to " + figure_text(bound_dB) +
         " dB";
}

std::string quantiser_cause(const SceneFacts& facts, double bound_dB) {
  const SignalFacts& signal = *facts.signal;
  const std::string what =
      std::to_string(signal.adc_bits) + (signal.adc_bits == 1 ? " bit" : " bits");
  if (!noise_hides(facts)) return whole_text("rounding to " + what, facts);
  const std::string steps = "rounding to " + what + ", in steps of " +
                            figure_text(step_sqrtW(signal) / noise_part_sqrtW(signal)) +
                            " of the noise's standard deviation,";
  if (may_clip(signal)) return whole_text("clipping at the quantiser's full scale", facts);
  if (bound_dB >= signal.window_dB) return whole_text(steps, facts);
  return steps + " can lift the noise by up to " + figure_text(bound_dB) + " dB";
}

std::string interference_cause(const SceneFacts& facts, double bound_dB) {
  const SignalFacts& signal = *facts.signal;
  const std::string what = "other radars' chirps";
  if (bound_dB >= signal.window_dB) return whole_text(what, facts);
  return what + ", " +
         figure_text(10.0 * std::log10(signal.interference_W / signal.noise_sample_W)) +
         " dB over the noise of a sample in all samples of a channel together, can change a cell "
         "by up to " +
         figure_text(bound_dB) + " dB";
}

}  // namespace fanbeam::renderer
