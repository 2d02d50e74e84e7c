// fanbeam fmcw: a scene at signal level, from scatterers to detections.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "apps/render_command.h"
#include "apps/waveform_command.h"

namespace fanbeam::apps {

inline constexpr std::array<Product, 8> kFmcwProducts = {
    {{"beat", "samples, NPY", "beat/00000.npy"},
     {"spectrum", "power against range of one receiver, PNG and CSV",
      "spectrum/00000.png and .csv"},
     {"cube", "range, speed and azimuth, complex, NPY", "cube/00000.npy"},
     {"range-doppler", "map, PNG and EXR", "range-doppler/00000.png and .exr"},
     {"range-azimuth", "map, PNG and EXR", "range-azimuth/00000.png and .exr"},
     {"top-view", "map, PNG and EXR", "top-view/00000.png and .exr"},
     {"detections", "with clusters, CSV and JSON", "detections/00000.csv and .json"},
     {"bscope", "the sensor's picture from one sweep a column, PNG and EXR",
      "bscope/00000.png and .exr"}}};

inline constexpr const char* kAutomotive = "automotive-76ghz";
inline constexpr std::size_t kMostDirectPaths = 20'000;

struct FmcwOptions : SceneChoice {
  FmcwOptions() { scene = "street-76ghz"; }
  std::string output;  // default out/<scene name>-fmcw
  std::string frames = "0";
  std::string products;  // empty: all that the waveform has but samples and cubes
  std::string waveform;  // a kind, or kAutomotive; empty: by the sensor's frequency
  std::array<std::optional<double>, kWaveformNumbers.size()> numbers;
  bool real = false;
  int transmitters = 3, receivers = 4;
  double false_alarm_probability = 1e-6;
  double rays_per_cell = 1.0;
  int looks = 0;  // of the B-scope; 0: the sensor's
  double dynamic_range_dB = 60.0;
  double line_width_Hz = 0.0;  // of the oscillator; 0: no phase noise
  int adc_bits = 0;            // 0: no quantiser
  double accuracy_grey = 0.0;  // 0: the scene's, else the default
  std::string effects;         // --effects; empty: what the scene and its samples call for
  bool refuse_folding = false;
  bool unfold = false;     // speeds of detections
  bool overwrite = false;  // where other files are
  int threads = 0;
  std::uint64_t seed = 0;
};

// Returns an exit code; throws InputError for bad input. Stopped by signals as render is.
int fmcw(const FmcwOptions& options, const CommonOptions& common);
CLI::App& add_fmcw_command(CLI::App& program, FmcwOptions& options, CommonOptions& common);

}  // namespace fanbeam::apps
