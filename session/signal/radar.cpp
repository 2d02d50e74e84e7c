#include "session/signal/radar.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/errors.h"
#include "session/signal/waveform_choice.h"
#include "signal/detection/cfar_calibration.h"
#include "signal/receiver/receiver_noise.h"
#include "signal/transform/angle_transform.h"

namespace fanbeam::session {
namespace {

using signal::WaveformKind;

// The default radar's twelve elements make beams 8.5 deg wide: five cells each.
constexpr int kAngleCells = 64;

constexpr double kAutomotiveFrom_Hz = 70e9, kAutomotiveTo_Hz = 82e9;

bool is_sequence(WaveformKind kind) {
  return kind == WaveformKind::chirp_sequence || kind == WaveformKind::two_stage;
}

std::size_t number_of(std::string_view option) {
  for (std::size_t i = 0; i < kWaveformNumbers.size(); ++i)
    if (kWaveformNumbers[i].option == option) return i;
  throw core::InternalError("no such option of a waveform");
}

// A default that an option replaces, in SI.
void suggest(std::string_view option, double value, WaveformSettings& wanted) {
  const std::size_t i = number_of(option);
  if (!wanted.numbers[i]) wanted.numbers[i] = value / kWaveformNumbers[i].to_SI;
}

WaveformKind kind_of(const std::string& name) {
  if (name == kAutomotive) return WaveformKind::chirp_sequence;
  const auto kind = signal::waveform_kind(name);
  if (!kind)
    core::throw_input_error(core::ErrorClass::ref, "--waveform", "\"" + name + "\"",
                            std::string(kAutomotive) + " or a kind that fanbeam waveform knows");
  return *kind;
}

// Samples that reach the last range cell without folding, in whole megahertz.
double reaching_rate_Hz(const WaveformSettings& wanted, const sensors::Sensor& sensor) {
  const double bandwidth_Hz = sensor.waveform.bandwidth_Hz;
  const auto ramp = wanted.numbers[number_of("--ramp")];
  const double ramp_s = ramp ? *ramp * 1e-6 : 20e-6;
  const double beat_Hz =
      2.0 * bandwidth_Hz / ramp_s * sensor.range.maximum_m() / core::kSpeedOfLight_mps;
  return 1e6 * std::ceil(std::max(1e6, 1.05 * beat_Hz) * 1e-6) * (wanted.real ? 2.0 : 1.0);
}

signal::Waveform waveform_of(const FmcwSettings& options, const std::string& name,
                             const sensors::Sensor& sensor) {
  const WaveformKind kind = kind_of(name);
  WaveformSettings wanted;
  wanted.kind = std::string(signal::name(kind));
  wanted.numbers = options.numbers;
  wanted.real = options.real;
  suggest("--frequency", sensor.waveform.frequency_Hz, wanted);
  if (kind != WaveformKind::continuous && kind != WaveformKind::pulsed)
    suggest("--bandwidth", sensor.waveform.bandwidth_Hz, wanted);
  if (name == kAutomotive) {
    suggest("--slots", options.transmitters, wanted);
    suggest("--sample-rate", 20e6, wanted);
  } else if (is_sequence(kind)) {
    suggest("--sample-rate", reaching_rate_Hz(wanted, sensor), wanted);
  }
  return chosen_waveform(wanted);
}

signal::Array array_of(const FmcwSettings& options, const signal::Waveform& waveform,
                       double pitch_m) {
  signal::Array array = signal::line_array(options.transmitters, options.receivers, pitch_m);
  const int slots = signal::slots(signal::stage_segments(waveform, 0));
  array.multiplex = slots == 1 ? signal::Multiplex::simultaneous : signal::Multiplex::time_division;
  if (slots != 1 && slots != options.transmitters)
    core::throw_input_error(core::ErrorClass::unsupported, "--slots", slots,
                            "1, or as many as --transmitters");
  return array;
}

void prepare_maps(const FmcwSettings& options, const sensors::Sensor& sensor, FmcwRadar& radar) {
  const auto segments = signal::stage_segments(radar.waveform, 0);
  const int slots = radar.array.slots();
  const int samples = signal::samples_per_segment(radar.waveform, 0);
  const int chirps = static_cast<int>(segments.size()) / slots;
  const double fs_Hz = radar.waveform.sample_rate_Hz[0];
  if (segments.size() < 2 || chirps < 2 || samples < 2)
    core::throw_input_error(core::ErrorClass::range, "--chirps", chirps, "2 or more");
  radar.timing = {fs_Hz, segments[0].slope_Hz_per_s, segments[1].start_s - segments[0].start_s,
                  radar.waveform.wavelength_m()};
  radar.axes = signal::range_doppler_axes(fs_Hz, radar.timing.slope_Hz_per_s,
                                          slots * radar.timing.slot_period_s,
                                          radar.timing.wavelength_m, samples, chirps);
  radar.azimuths_rad = signal::angle_cell_azimuths_rad(
      std::max(kAngleCells, radar.array.channels()), radar.pitch_m, radar.waveform.wavelength_m());
  signal::DetectionSettings& settings = radar.detection;
  // Real samples hold every range twice.
  const int whole = options.real ? samples / 2 : samples;
  settings.transform.kept_range_cells = std::clamp(
      static_cast<int>(std::ceil(sensor.range.maximum_m() / radar.axes.range_step_m)), 2, whole);
  // Echoes of a street span more than the 35 dB of the usual Taylor window.
  settings.transform.range_window = settings.transform.doppler_window = {
      .kind = signal::WindowKind::chebyshev, .level_dB = 60.0, .symmetric = true};
  settings.refinement = signal::Refinement::windowed;
  settings.unfold = options.unfold && slots > 1;
  settings.cfar = {.kind = signal::CfarKind::ordered_statistic,
                   .design_probability = options.false_alarm_probability,
                   .along_columns = {2, 4, false},
                   .along_rows = {2, 2, true}};
  const auto range_weights = signal::window_weights(settings.transform.range_window, samples);
  const auto doppler_weights = signal::window_weights(settings.transform.doppler_window, chirps);
  settings.cfar.design_probability =
      signal::calibrated_cfar(settings.cfar, {range_weights, samples, doppler_weights, chirps},
                              radar.array.channels())
          .design_probability;
  radar.noise_cell_W = signal::noise_sample_W(sensor.receiver.noise_figure, fs_Hz) *
                       signal::noise_gain(range_weights) * signal::noise_gain(doppler_weights);
  // Real samples of noise have half of that, which the scale makes up for.
  radar.power_scale = options.real ? 2.0 : 1.0;
}

}  // namespace

std::string waveform_name(const FmcwSettings& options, const sensors::Sensor& sensor) {
  if (!options.waveform.empty()) return options.waveform;
  const double frequency_Hz = sensor.waveform.frequency_Hz;
  return frequency_Hz >= kAutomotiveFrom_Hz && frequency_Hz <= kAutomotiveTo_Hz
             ? kAutomotive
             : std::string(signal::name(WaveformKind::chirp_sequence));
}

FmcwRadar fmcw_radar(const FmcwSettings& options, const sensors::Sensor& sensor) {
  if (sensor.scan.surface != sensors::ScanSurface::plane)
    core::throw_input_error(core::ErrorClass::unsupported, "scan.surface", "\"cone\"",
                            "a plane scan: a line array measures cones by itself");
  FmcwRadar radar;
  radar.waveform_name = waveform_name(options, sensor);
  radar.waveform = waveform_of(options, radar.waveform_name, sensor);
  radar.pitch_m = 0.5 * radar.waveform.wavelength_m();
  radar.array = array_of(options, radar.waveform, radar.pitch_m);
  radar.maps = is_sequence(radar.waveform.kind);
  if (radar.maps) prepare_maps(options, sensor, radar);
  return radar;
}

}  // namespace fanbeam::session
