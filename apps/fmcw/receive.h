// What the receiver makes of a beat cube: phase noise, thermal noise, quantiser, in this order.
#pragma once

#include <cstddef>

#include "core/random.h"
#include "signal/cube.h"
#include "signal/waveform/array.h"

namespace fanbeam::apps {

struct FmcwReceiver {
  double noise_figure = 1.0;
  double sample_rate_Hz = 0.0;
  bool complex_baseband = true;
  bool thermal_noise = true;
  double phase_noise_rad = 0.0;  // 0: none
  int adc_bits = 0;              // 0: no quantiser; else its range is the cube's largest sample
};

// Returns how many parts of samples the quantiser clipped.
std::size_t receive(const signal::Array& array, const FmcwReceiver& receiver,
                    const core::RandomKey& key, signal::FloatCube& beat);

}  // namespace fanbeam::apps
