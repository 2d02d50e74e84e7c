// What is asked of a scene's signal level: which radar looks at it, and how closely. What its parts
// cannot take they refuse (E-RANGE, E-UNSUPPORTED), in the words of the command's options.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "session/products/products.h"
#include "session/signal/processing_settings.h"
#include "session/signal/receiver_settings.h"
#include "session/signal/sample_layout.h"
#include "session/signal/waveform_settings.h"

namespace fanbeam::session {

inline constexpr std::array<Product, 10> kFmcwProducts = {
    {{"beat", "samples, NPY", "beat/00000.npy"},
     {"spectrum", "power against range of one receiver, PNG and CSV",
      "spectrum/00000.png and .csv"},
     {"cube", "range, speed and azimuth, complex, NPY", "cube/00000.npy"},
     {"range-doppler", "map, PNG and EXR", "range-doppler/00000.png and .exr"},
     {"range-azimuth", "map, PNG and EXR", "range-azimuth/00000.png and .exr"},
     {"top-view", "map, PNG and EXR", "top-view/00000.png and .exr"},
     {"detections", "with clusters, CSV and JSON", "detections/00000.csv and .json"},
     {"spectrogram", "power over speed and time of all frames, micro-Doppler, PNG and EXR",
      "spectrogram/all.png and .exr"},
     {"interference",
      "floor and detections without other radars, with them, and with each mitigation, CSV "
      "and PNG",
      "interference/00000.csv and .png"},
     {"bscope", "the sensor's picture from one sweep a column, PNG and EXR",
      "bscope/00000.png and .exr"}}};

inline constexpr const char* kAutomotive = "automotive-76ghz";
inline constexpr std::size_t kMostDirectPaths = 20'000;

struct FmcwSettings : ProcessingSettings, ArraySettings, ReceiverSettings {
  std::string waveform;  // a kind, or kAutomotive; empty: by the sensor's frequency
  // Of kWaveformNumbers, in their handy units; what is missing is the kind's default.
  std::array<std::optional<double>, kWaveformNumbers.size()> numbers;
  SampleLayout layout;             // of samples that are read from files
  bool real = false;               // samples: negative beats read as positive ones
  double rays_per_cell = 1.0;      // scatterers, 0.3 to 1000
  int looks = 0;                   // of the B-scope, to 100 000; 0: the sensor's
  double dynamic_range_dB = 60.0;  // of maps as pictures, 1 to 300
  bool refuse_folding = false;     // E-RANGE where echoes fold in range or speed
  std::uint64_t seed = 0;          // of everything random
};

}  // namespace fanbeam::session
