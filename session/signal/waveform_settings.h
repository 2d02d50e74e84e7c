// Which waveform is asked for, by its kind and the numbers that kinds have, in handy units.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace fanbeam::session {

// A parameter that some kinds of waveform have, as the command line names and takes it.
struct WaveformNumber {
  const char* option;
  const char* key;  // of a radar file (radar_file.h)
  const char* help;
  double least, most;
  double to_SI;
};
inline constexpr std::array kWaveformNumbers = {
    WaveformNumber{"--frequency", "frequency_GHz",
                   "Centre frequency, GHz (default 76; of a scene's signals the sensor's)", 1e-3,
                   1000.0, 1e9},
    WaveformNumber{"--bandwidth", "bandwidth_MHz",
                   "Swept or stepped over, MHz (default 250; of a scene's signals the sensor's)",
                   1e-6, 1e5, 1e6},
    WaveformNumber{"--sample-rate", "sample_rate_MHz",
                   "Of the beat, MHz (default: as the kind of waveform needs)", 1e-6, 1e5, 1e6},
    WaveformNumber{"--fine-sample-rate", "fine_sample_rate_MHz",
                   "Of two-stage's triangle, MHz (default 0.5)", 1e-6, 1e5, 1e6},
    WaveformNumber{"--duration", "duration_us", "Of the tone, us (default 20000)", 1e-3, 1e9, 1e-6},
    WaveformNumber{"--pulse-width", "pulse_width_ns", "Of a pulse, ns (default 10)", 1e-3, 1e9,
                   1e-9},
    WaveformNumber{"--interval", "interval_us",
                   "From chirp to chirp (default: the ramp) or pulse to pulse, us", 1e-3, 1e9,
                   1e-6},
    WaveformNumber{"--pulses", "pulses", "Pulses of a frame (default 64)", 1, 65536, 1},
    WaveformNumber{"--ramp", "ramp_us", "Of a chirp or a triangle's half, us (default 20, 2000)",
                   1e-3, 1e9, 1e-6},
    WaveformNumber{"--second-ramp", "second_ramp_us", "Of the second triangle, us (default 3000)",
                   1e-3, 1e9, 1e-6},
    WaveformNumber{"--fine-ramp", "fine_ramp_us", "Of two-stage's triangle, us (default 2000)",
                   1e-3, 1e9, 1e-6},
    WaveformNumber{"--chirps", "chirps", "Chirps of each transmitter (default 256)", 1, 65536, 1},
    WaveformNumber{"--slots", "slots",
                   "Transmitters in turn (default 1; of a scene's signals by automotive-76ghz all)",
                   1, 256, 1},
    WaveformNumber{"--modulation", "modulation_Hz", "Of sinusoidal modulation, Hz (default 500)",
                   1e-3, 1e9, 1},
    WaveformNumber{"--flat", "flat_us", "Flat stretch, us (default 2000)", 1e-3, 1e9, 1e-6},
    WaveformNumber{"--hop", "hop_kHz",
                   "Between the two tones of the flat stretch, kHz (default 700)", 1e-3, 1e9, 1e3},
    WaveformNumber{"--code-degree", "code_degree", "n of 2^n - 1 chips (default 7)", 3, 12, 1},
    WaveformNumber{"--steps", "steps", "Of each staircase (default 256)", 2, 65536, 1},
    WaveformNumber{"--step", "step_us", "Duration of a step, us (default 10)", 1e-3, 1e9, 1e-6},
    WaveformNumber{"--shift", "shift_kHz", "Of the second staircase, kHz (default -488.28)", -1e9,
                   1e9, 1e3},
};

struct WaveformSettings {
  std::string kind = "chirp-sequence";
  std::array<std::optional<double>, kWaveformNumbers.size()> numbers;
  bool real = false, down_first = false;
};

}  // namespace fanbeam::session
