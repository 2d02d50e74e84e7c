#include "session/signal/receive.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/decibel.h"
#include "core/effect_plan.h"
#include "signal/receiver/receiver_noise.h"

namespace fanbeam::session {
namespace {

std::size_t convert(const FmcwReceiver& receiver, signal::FloatCube& beat) {
  // A real tone of that power reaches the square root of twice of it.
  double full_scale =
      receiver.full_scale_sqrtW * (receiver.complex_baseband ? 1.0 : std::sqrt(2.0));
  if (!(full_scale > 0.0))
    for (const std::complex<float>& sample : beat.values)
      full_scale = std::max({full_scale, static_cast<double>(std::abs(sample.real())),
                             static_cast<double>(std::abs(sample.imag()))});
  if (!(full_scale > 0.0)) return 0;
  return signal::quantise(signal::Quantiser{receiver.adc_bits, full_scale}, beat);
}

}  // namespace

FmcwReceiver fmcw_receiver(const ReceiverSettings& settings, double noise_figure,
                           double sample_rate_Hz, bool complex_baseband) {
  FmcwReceiver receiver;
  receiver.noise_figure = noise_figure;
  receiver.sample_rate_Hz = sample_rate_Hz;
  receiver.complex_baseband = complex_baseband;
  receiver.phase_noise = settings.phase_noise;
  if (settings.line_width_Hz > 0.0)
    receiver.phase_noise = signal::lorentzian(settings.line_width_Hz);
  receiver.adc_bits = settings.adc_bits;
  if (settings.adc_full_scale_dBm)
    receiver.full_scale_sqrtW = std::pow(10.0, 0.05 * (*settings.adc_full_scale_dBm - 30.0));
  return receiver;
}

double noise_figure_of(const ReceiverSettings& settings, const sensors::Sensor& sensor) {
  return settings.noise_figure_dB ? core::power_from_dB(*settings.noise_figure_dB)
                                  : sensor.receiver.noise_figure;
}

double phase_noise_rad(const FmcwReceiver& receiver, int samples) {
  return signal::residual_phase(receiver.phase_noise, receiver.longest_delay_s,
                                receiver.sample_rate_Hz, samples)
      .rms_rad;
}

signal::FloatCube with_phase_noise(const signal::Array& array, const FmcwReceiver& receiver,
                                   const core::RandomKey& key, const std::vector<double>& delays_s,
                                   const SynthesiseSome& synthesise) {
  signal::FloatCube sum;
  for (const signal::DelayGroup& group : signal::delay_groups(delays_s)) {
    signal::FloatCube part = synthesise(group.members);
    signal::apply_oscillator(receiver.phase_noise, group.delay_s, receiver.sample_rate_Hz, key,
                             array, part);
    if (sum.values.empty()) {
      sum = std::move(part);
      continue;
    }
    for (std::size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += part.values[i];
  }
  return sum;
}

std::size_t receive(const signal::Array& array, const FmcwReceiver& receiver,
                    const core::EffectPlan& plan, const core::RandomKey& key,
                    signal::FloatCube& beat) {
  if (!receiver.complex_baseband) signal::keep_real(beat);
  if (plan.runs(core::EffectId::receiver_noise))
    signal::add_receiver_noise(
        array,
        {signal::noise_sample_W(receiver.noise_figure, receiver.sample_rate_Hz),
         receiver.complex_baseband, key},
        beat);
  return plan.runs(core::EffectId::quantiser) ? convert(receiver, beat) : 0;
}

}  // namespace fanbeam::session
