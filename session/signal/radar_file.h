// A radar as a TOML file: waveform, array, receiver and what is made of the samples, for
// fanbeam fmcw --radar and fanbeam track --radar, and written beside samples (radar.toml).
//
//   [waveform]    kind "automotive-76ghz" | a kind of fanbeam waveform; real, default false; the
//                 numbers of kWaveformNumbers by their keys: frequency_GHz, bandwidth_MHz, ramp_us, ...
//   [array]       transmitters, receivers, 1 to 64, on a line pitch_wavelengths apart (default 0.5);
//                 or at places within 10 m: transmitter_right_m and receiver_right_m, 1 to 64 numbers each,
//                 with transmitter_forward_m, transmitter_up_m and so on, 0 where missing (no pitch beside them, and
//                 counts only where they are theirs);
//                 gain_errors_dB, +-60, and phase_errors_deg, +-360, one for every channel: of samples that
//                 are made; those recorded have theirs
//   [receiver]    noise_figure_dB, 0 to 60; line_width_Hz, 0 to 1e6, or
//                 phase_noise_offsets_kHz, rising, above 0 to 1e9, with phase_noise_dBc_per_Hz,
//                 -300 to 60; adc_bits, 0 to 24; adc_full_scale_dBm, +-300
//   [samples]     of recorded samples (sample_file.h): axes, "channel, chirp, sample" and the like;
//                 scale_sqrtW, 1e-30 to 1e9, default 1; conjugate, of mixers that give received minus
//                 transmitted, of rising chirps alone; channel_gain_dB, +-60, and
//                 channel_phase_deg, +-360, one for every channel, known from calibration: taken off
//   [processing]  range_window, doppler_window, angle_window: "taylor:35" and the like (window.h);
//                 mitigation "none" | "zero" | "interpolate" of other radars' chirps (mitigation.h), with
//                 mitigation_threshold_dB, above 0 to 60;
//                 cfar "ca" | "os" | "go" | "so"; cfar_guard, cfar_training: [range, Doppler] cells on each
//                 side, 0 to 64, the guard over the windows' main lobe; false_alarm_probability, 1e-12 to 0.1;
//                 angle_method "beamforming" | "capon" | "music": the latter two, and angle_window (of beams,
//                 not of detections), of lines at one pitch alone; cluster_place_m, cluster_speed_mps, above 0
//                 to 1000; cluster_neighbours, 1 to 100; unfold; most_range_m, above 0 to 1e6
//
// All keys are optional; what is missing keeps its default, a scene's sensor's where there is one (without a scene
// frequency, bandwidth and noise figure have to be told, of samples their rate too). Unknown keys are errors.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/errors.h"
#include "session/signal/fmcw_settings.h"

namespace fanbeam::session {

void read_radar_file(const std::filesystem::path& file, FmcwSettings& settings,
                     core::ProblemList& problems);
// For whoever needs a whole one: throws all that is wrong.
FmcwSettings radar_settings(const std::filesystem::path& file);
void read_radar_text(std::string_view text, const std::string& name, FmcwSettings& settings,
                     core::ProblemList& problems);

// What a radar was made with where its settings leave it to the sensor and the scene; 0: not told.
struct RadarFigures {
  double frequency_Hz = 0.0, bandwidth_Hz = 0.0, noise_figure = 1.0;
  double sample_rate_Hz = 0.0;  // of a chirp sequence
};

// A file that read_radar_file reads to the same settings, with these figures in them.
std::string radar_toml(const FmcwSettings& settings, const std::string& waveform,
                       const RadarFigures& figures);

// What is wrong with a radar that a file describes, in the file's words: at the file, with the names of its
// keys instead of options.
core::InputError in_radar_file(const core::InputError& error, const std::filesystem::path& file);

// What `make` gives of a file's radar; where that fails, told as the file's fault.
template <class Make>
auto radar_in_file(const std::filesystem::path& file, const Make& make) {
  try {
    return make();
  } catch (const core::InputError& error) {
    throw in_radar_file(error, file);
  }
}

// What signal::window_of reads, for messages.
inline constexpr const char* kWindowWords =
    "rectangular, hann, hamming, blackman, blackman-harris, taylor:DB (10 to 120; taylor:DB:N, N "
    "from 1 to 50), chebyshev:DB (20 to 200) or kaiser:BETA (0 to 100)";

// "ca", "os", "go", "so".
std::string cfar_word(signal::CfarKind kind);
std::optional<signal::CfarKind> cfar_kind(std::string_view word);

}  // namespace fanbeam::session
