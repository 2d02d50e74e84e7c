// What the receiver makes of a beat cube: thermal noise, quantiser, in this order, each where the
// plan runs it. Before it, where the plan runs phase noise, every echo is turned by what its delay
// leaves of the oscillator's (signal/receiver/oscillator.h).
#pragma once

#include <cstddef>
#include <functional>

#include "core/effect_plan.h"
#include "core/random.h"
#include "sensors/sensor.h"
#include "session/signal/receiver_settings.h"
#include "signal/cube.h"
#include "signal/waveform/array.h"

namespace fanbeam::session {

struct FmcwReceiver {
  double noise_figure = 1.0;
  double sample_rate_Hz = 0.0;
  bool complex_baseband = true;
  signal::PhaseNoiseTable phase_noise;  // empty: none
  double longest_delay_s = 0.0;         // of the echoes
  int adc_bits = 0;                     // 0: no quantiser
  // Of a part; 0: the cube's largest, which if positive is clipped by the one step that levels end below it.
  double full_scale_sqrtW = 0.0;
};

// What the settings say of the receiver of a radar with this noise figure.
FmcwReceiver fmcw_receiver(const ReceiverSettings& settings, double noise_figure,
                           double sample_rate_Hz, bool complex_baseband);

// Of the settings, else the sensor's; as a power ratio.
double noise_figure_of(const ReceiverSettings& settings, const sensors::Sensor& sensor);

// What the oscillator leaves at the longest delay, rms.
double phase_noise_rad(const FmcwReceiver& receiver, int samples);

// The cube of echoes each turned by its own phase: `synthesise` makes that of some of them.
using SynthesiseSome = std::function<signal::FloatCube(const std::vector<std::size_t>&)>;
signal::FloatCube with_phase_noise(const signal::Array& array, const FmcwReceiver& receiver,
                                   const core::RandomKey& key, const std::vector<double>& delays_s,
                                   const SynthesiseSome& synthesise);

// The complex cube becomes real samples (signal::keep_real) where the receiver has those. Returns how
// many parts of samples the quantiser clipped.
std::size_t receive(const signal::Array& array, const FmcwReceiver& receiver,
                    const core::EffectPlan& plan, const core::RandomKey& key,
                    signal::FloatCube& beat);

}  // namespace fanbeam::session
