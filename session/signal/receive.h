// What the receiver makes of a beat cube: phase noise, thermal noise, quantiser, in this order, each
// where the plan runs it.
#pragma once

#include <cstddef>

#include "core/effect_plan.h"
#include "core/random.h"
#include "signal/cube.h"
#include "signal/waveform/array.h"

namespace fanbeam::session {

struct FmcwReceiver {
  double noise_figure = 1.0;
  double sample_rate_Hz = 0.0;
  bool complex_baseband = true;
  double phase_noise_rad = 0.0;  // 0: none
  int adc_bits = 0;              // 0: no quantiser; else its range is the cube's largest sample
};

// The complex cube becomes real samples (signal::keep_real) where the receiver has those: after
// the phase noise, which turns both parts. Returns how many parts of samples the quantiser
// clipped.
std::size_t receive(const signal::Array& array, const FmcwReceiver& receiver,
                    const core::EffectPlan& plan, const core::RandomKey& key,
                    signal::FloatCube& beat);

}  // namespace fanbeam::session
