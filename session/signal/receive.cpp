#include "session/signal/receive.h"

#include <algorithm>
#include <cmath>

#include "core/effect_plan.h"
#include "signal/receiver/receiver_noise.h"

namespace fanbeam::session {
namespace {

std::size_t convert(int bits, signal::FloatCube& beat) {
  float largest = 0.0F;
  for (const std::complex<float>& sample : beat.values)
    largest = std::max({largest, std::abs(sample.real()), std::abs(sample.imag())});
  if (!(largest > 0.0F)) return 0;
  return signal::quantise(signal::Quantiser{bits, static_cast<double>(largest)}, beat);
}

}  // namespace

std::size_t receive(const signal::Array& array, const FmcwReceiver& receiver,
                    const core::EffectPlan& plan, const core::RandomKey& key,
                    signal::FloatCube& beat) {
  if (plan.runs(core::EffectId::phase_noise))
    signal::apply_phase_noise(signal::PhaseNoise{.rms_rad = receiver.phase_noise_rad,
                                                 .sample_rate_Hz = receiver.sample_rate_Hz,
                                                 .key = key},
                              beat);
  if (!receiver.complex_baseband) signal::keep_real(beat);
  if (plan.runs(core::EffectId::receiver_noise))
    signal::add_receiver_noise(
        array,
        {signal::noise_sample_W(receiver.noise_figure, receiver.sample_rate_Hz),
         receiver.complex_baseband, key},
        beat);
  return plan.runs(core::EffectId::quantiser) ? convert(receiver.adc_bits, beat) : 0;
}

}  // namespace fanbeam::session
