#include "session/signal/radar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/decibel.h"
#include "core/errors.h"
#include "session/signal/receive.h"
#include "session/signal/waveform_choice.h"
#include "signal/detection/cfar_calibration.h"
#include "signal/fourier/window_figures.h"
#include "signal/receiver/receiver_noise.h"
#include "signal/synthesis/frame.h"
#include "signal/transform/angle_transform.h"

namespace fanbeam::session {
namespace {

using signal::WaveformKind;

// The default radar's twelve elements make beams 8.5 deg wide: five cells each.
constexpr int kAngleCells = 64;

constexpr double kAutomotiveFrom_Hz = 70e9, kAutomotiveTo_Hz = 82e9;

// A default that an option replaces, in SI.
void suggest(std::string_view option, double value, WaveformSettings& wanted) {
  const std::size_t i = waveform_number(option);
  if (!wanted.numbers[i]) wanted.numbers[i] = value / kWaveformNumbers[i].to_SI;
}

WaveformKind kind_of(const std::string& name) {
  if (name == kAutomotive) return WaveformKind::chirp_sequence;
  const auto kind = signal::waveform_kind(name);
  if (!kind)
    core::throw_input_error(core::ErrorClass::ref, "--waveform", "\"" + name + "\"",
                            "one of: " + std::string(kAutomotive) + ", " + waveform_kinds_text());
  return *kind;
}

// What a sensor file says of the radar, or what stands for it.
struct Front {
  double frequency_Hz = 0.0, bandwidth_Hz = 0.0, noise_figure = 1.0;
  std::optional<double> most_range_m;  // missing: as far as the samples reach
};

double wanted_range_m(const FmcwSettings& options, const Front& front) {
  return options.most_range_m.value_or(front.most_range_m.value_or(0.0));
}

// Samples that reach the last range cell without folding, in whole megahertz.
double reaching_rate_Hz(const WaveformSettings& wanted, double most_range_m) {
  const auto ramp = wanted.numbers[waveform_number("--ramp")];
  const double ramp_s = ramp ? *ramp * 1e-6 : 20e-6;
  const double bandwidth_Hz = wanted.numbers[waveform_number("--bandwidth")].value() * 1e6;
  const double beat_Hz = 2.0 * bandwidth_Hz / ramp_s * most_range_m / core::kSpeedOfLight_mps;
  return 1e6 * std::ceil(std::max(1e6, 1.05 * beat_Hz) * 1e-6) * (wanted.real ? 2.0 : 1.0);
}

int transmitters_of(const ArraySettings& array) {
  return array.transmitters_m.empty() ? array.transmitters
                                      : static_cast<int>(array.transmitters_m.size());
}

signal::Waveform waveform_of(const FmcwSettings& options, const std::string& name,
                             const Front& front) {
  const WaveformKind kind = kind_of(name);
  WaveformSettings wanted;
  wanted.kind = std::string(signal::name(kind));
  wanted.numbers = options.numbers;
  wanted.real = options.real;
  suggest("--frequency", front.frequency_Hz, wanted);
  if (kind != WaveformKind::continuous && kind != WaveformKind::pulsed)
    suggest("--bandwidth", front.bandwidth_Hz, wanted);
  if (name == kAutomotive) {
    suggest("--slots", transmitters_of(options), wanted);
    suggest("--sample-rate", 20e6, wanted);
  } else if (is_sequence(kind)) {
    suggest("--sample-rate", reaching_rate_Hz(wanted, wanted_range_m(options, front)), wanted);
  }
  return chosen_waveform(wanted);
}

signal::Array array_of(const FmcwSettings& options, const signal::Waveform& waveform,
                       double pitch_m, core::ProblemList& problems) {
  signal::Array array = signal::line_array(options.transmitters, options.receivers, pitch_m);
  if (!options.transmitters_m.empty()) array.transmitters_m = options.transmitters_m;
  if (!options.receivers_m.empty()) array.receivers_m = options.receivers_m;
  signal::check(array);
  const auto channels = static_cast<std::size_t>(array.channels());
  for (const auto* errors : {&options.gain_errors_dB, &options.phase_errors_rad})
    if (!errors->empty() && errors->size() != channels)
      problems.error(core::ErrorClass::range, {}, "channel errors", std::to_string(errors->size()),
                     "one for each of " + std::to_string(channels) + " channels");
  const int slots = signal::slots(signal::stage_segments(waveform, 0));
  array.multiplex = slots == 1 ? signal::Multiplex::simultaneous : signal::Multiplex::time_division;
  if (slots != 1 && slots != static_cast<int>(array.transmitters_m.size()))
    problems.error(core::ErrorClass::unsupported, {}, "--slots", std::to_string(slots),
                   "1, or as many as --transmitters");
  return array;
}

// Left to right across the boresight at one pitch, as the Fourier transform over channels needs it.
bool is_line(const std::vector<glm::dvec3>& elements_m) {
  if (!signal::is_uniform_line(elements_m)) return false;
  if (elements_m.size() < 2) return true;
  const glm::dvec3 pitch_m = elements_m[1] - elements_m[0];
  return pitch_m.y > 0.0 && std::hypot(pitch_m.x, pitch_m.z) <= 1e-6 * pitch_m.y;
}

// In the words of the options: the detector only knows its cells.
void check_training(const ProcessingSettings& options) {
  const CellSpan &guard = options.cfar_guard, &training = options.cfar_training;
  const auto cells = [](int range, int doppler) { return (2 * range + 1) * (2 * doppler + 1); };
  const int count = cells(guard.range + training.range, guard.doppler + training.doppler) -
                    cells(guard.range, guard.doppler);
  if (count == 0 || count > signal::kMostCalibratedCells)
    core::throw_input_error(
        core::ErrorClass::range, "--cfar-training",
        fmt::format("{},{}", training.range, training.doppler),
        count == 0
            ? std::string("1 or more in range, Doppler or both")
            : fmt::format("fewer, or fewer --cfar-guard: {} training cells around a cell are "
                          "more than {}",
                          count, signal::kMostCalibratedCells));
}

signal::CfarSettings cfar_of(const ProcessingSettings& options,
                             const signal::CellCorrelation& cells, int looks) {
  check_training(options);
  signal::CfarSettings cfar;
  cfar.kind = options.cfar;
  cfar.design_probability = options.false_alarm_probability;
  cfar.along_columns = {options.cfar_guard.range, options.cfar_training.range, false};
  cfar.along_rows = {options.cfar_guard.doppler, options.cfar_training.doppler, true};
  const signal::CfarCalibration calibration = signal::calibrated_cfar(cfar, cells, looks);
  cfar.design_probability = calibration.design_probability;
  cfar.mean_estimate = calibration.mean_estimate;
  return cfar;
}

signal::ClusterScales clusters_of(const ProcessingSettings& options,
                                  const signal::RangeDopplerAxes& axes,
                                  const std::vector<double>& range_weights,
                                  const std::vector<double>& doppler_weights) {
  constexpr double kWidths = 4.0;  // parts of a car 3.3 m apart are one at 250 MHz
  const auto width = [](const std::vector<double>& weights) {
    return weights.size() < 3 ? 1.0 : signal::window_figures(weights).half_power_width_bins;
  };
  signal::ClusterScales scales;
  scales.place_m =
      options.cluster_place_m.value_or(kWidths * axes.range_step_m * width(range_weights));
  scales.speed_mps = options.cluster_speed_mps.value_or(
      kWidths * (axes.speed_mps(1.0) - axes.speed_mps(0.0)) * width(doppler_weights));
  scales.least_neighbours = options.cluster_neighbours;
  return scales;
}

void prepare_maps(const FmcwSettings& options, const Front& front, FmcwRadar& radar) {
  const auto segments = signal::stage_segments(radar.waveform, 0);
  const int slots = radar.array.slots();
  const int samples = signal::samples_per_segment(radar.waveform, 0);
  const int chirps = static_cast<int>(segments.size()) / slots;
  const double fs_Hz = radar.waveform.sample_rate_Hz[0];
  // Real samples hold every range twice.
  const int whole = options.real ? samples / 2 : samples;
  if (whole < 2)
    core::throw_input_error(core::ErrorClass::range, "--sample-rate",
                            fmt::format("{} in a ramp", samples),
                            options.real ? "4 samples or more" : "2 samples or more");
  radar.timing = {fs_Hz, segments[0].slope_Hz_per_s, segments[1].start_s - segments[0].start_s,
                  radar.waveform.wavelength_m()};
  radar.middle_s = signal::middle_s(segments);
  radar.axes = signal::range_doppler_axes(fs_Hz, radar.timing.slope_Hz_per_s,
                                          slots * radar.timing.slot_period_s,
                                          radar.timing.wavelength_m, samples, chirps);
  radar.azimuths_rad = signal::angle_cell_azimuths_rad(
      std::max(kAngleCells, radar.array.channels()), radar.pitch_m, radar.waveform.wavelength_m());
  signal::DetectionSettings& settings = radar.detection;
  const double most_range_m = wanted_range_m(options, front);
  settings.transform.kept_range_cells =
      most_range_m > 0.0
          ? std::clamp(static_cast<int>(std::ceil(most_range_m / radar.axes.range_step_m)), 2,
                       whole)
          : whole;
  settings.transform.range_window = options.range_window;
  settings.transform.doppler_window = options.doppler_window;
  settings.refinement = signal::Refinement::windowed;
  settings.angle = options.angle_method;
  settings.unfold = options.unfold;
  const auto range_weights = signal::window_weights(settings.transform.range_window, samples);
  const auto doppler_weights = signal::window_weights(settings.transform.doppler_window, chirps);
  settings.cfar = cfar_of(options, {range_weights, samples, doppler_weights, chirps},
                          std::min(radar.array.channels(), signal::kMostLooks));
  radar.clusters = clusters_of(options, radar.axes, range_weights, doppler_weights);
  radar.noise_cell_W = signal::noise_sample_W(radar.noise_figure, fs_Hz) *
                       signal::noise_gain(range_weights) * signal::noise_gain(doppler_weights);
  // The largest of some hundred noise cells is about six times their mean; Capon's sums them.
  constexpr double kLargestOverMean = 6.0;
  radar.noise_azimuth_W = radar.noise_cell_W / radar.array.channels() *
                          (options.angle_method == signal::AngleMethod::capon
                               ? 1.0 / signal::noise_gain(doppler_weights)
                               : kLargestOverMean);
  // Real samples of noise have half of that, which the scale makes up for.
  radar.power_scale = options.real ? 2.0 : 1.0;
}

}  // namespace

bool is_sequence(WaveformKind kind) {
  return kind == WaveformKind::chirp_sequence || kind == WaveformKind::two_stage;
}

std::string waveform_name(const FmcwSettings& options, const sensors::Sensor& sensor) {
  if (!options.waveform.empty()) return options.waveform;
  const double frequency_Hz = sensor.waveform.frequency_Hz;
  return frequency_Hz >= kAutomotiveFrom_Hz && frequency_Hz <= kAutomotiveTo_Hz
             ? kAutomotive
             : std::string(signal::name(WaveformKind::chirp_sequence));
}

namespace {

void check_receiver(const ReceiverSettings& receiver, core::ProblemList& problems) {
  if (receiver.adc_full_scale_dBm && receiver.adc_bits == 0)
    problems.error(core::ErrorClass::ref, {}, "--adc-bits", "0",
                   "1 or more, or no full scale of the converter");
  if (receiver.line_width_Hz > 0.0 && !receiver.phase_noise.empty())
    problems.error(core::ErrorClass::unsupported, {}, "--line-width",
                   core::number_text(receiver.line_width_Hz),
                   "a line width or a table of phase noise, not both");
}

// What `make` throws goes to the others.
template <class Make>
bool attempt(core::ProblemList& problems, const Make& make) {
  try {
    make();
    return true;
  } catch (const core::InputError& error) {
    problems.append(error.problems());
    return false;
  }
}

// What is asked for of azimuths and folds, and this array cannot.
void check_methods(const FmcwSettings& options, const FmcwRadar& radar, std::size_t channels,
                   core::ProblemList& problems) {
  const bool beams = options.angle_method == signal::AngleMethod::beamforming;
  const auto refuse = [&](const char* what, const std::string& value, const std::string& expected) {
    problems.error(core::ErrorClass::unsupported, {}, what, value, expected);
  };
  const std::string method(signal::name(options.angle_method));
  if (!radar.line && !beams)
    refuse("angle method", method, "beamforming, or an array on a line at one pitch");
  if (!radar.line && options.angle_window.kind != signal::WindowKind::rectangular &&
      !(options.angle_window == ProcessingSettings{}.angle_window))
    refuse("angle window", signal::name(options.angle_window),
           "rectangular, or an array on a line at one pitch");
  if (channels < signal::kFewestElements && !beams)
    refuse("angle method", method,
           "beamforming, or an array of " + std::to_string(signal::kFewestElements) +
               " channels or more");
  if (options.unfold && radar.array.slots() == 1)
    refuse("--unfold", "true",
           "two transmitters or more that take turns: their phases tell the fold");
}

void set_array(const FmcwSettings& options, FmcwRadar& radar, core::ProblemList& problems) {
  radar.pitch_m = options.pitch_wavelengths * radar.waveform.wavelength_m();
  radar.array = array_of(options, radar.waveform, radar.pitch_m, problems);
  signal::check_size(radar.waveform, radar.array);  // before rays are sent for it
  const std::vector<glm::dvec3> elements_m = signal::virtual_elements_m(radar.array);
  radar.line = is_line(elements_m);
  if (!radar.line)
    radar.pitch_m = 0.5 * radar.waveform.wavelength_m();
  else if (elements_m.size() > 1)
    radar.pitch_m = elements_m[1].y - elements_m[0].y;
  check_methods(options, radar, elements_m.size(), problems);
  const std::vector<signal::Segment> segments = signal::stage_segments(radar.waveform, 0);
  const int slots = radar.array.slots();
  radar.maps = is_sequence(radar.waveform.kind) && signal::slots(segments) == slots &&
               segments.size() > static_cast<std::size_t>(slots);
}

FmcwRadar made(const FmcwSettings& options, const std::string& name, const Front& front) {
  core::ProblemList problems;
  check_receiver(options, problems);
  FmcwRadar radar;
  radar.waveform_name = name;
  radar.noise_figure = front.noise_figure;
  const bool whole =
      attempt(problems, [&] { radar.waveform = waveform_of(options, name, front); }) &&
      attempt(problems, [&] { set_array(options, radar, problems); });
  if (whole && radar.maps) attempt(problems, [&] { prepare_maps(options, front, radar); });
  problems.throw_if_errors();
  return radar;
}

}  // namespace

FmcwRadar fmcw_radar(const FmcwSettings& options, const sensors::Sensor& sensor) {
  if (sensor.scan.surface != sensors::ScanSurface::plane)
    core::throw_input_error(core::ErrorClass::unsupported, "scan.surface", "\"cone\"",
                            "a plane scan: a line array measures cones by itself");
  if (const auto told = options.numbers[waveform_number("--frequency")])
    if (std::abs(*told * 1e9 / sensor.waveform.frequency_Hz - 1.0) > 1e-6)
      core::throw_input_error(core::ErrorClass::range, "waveform.frequency_GHz", *told,
                              "the scene's sensor's " +
                                  core::number_text(sensor.waveform.frequency_Hz * 1e-9) + " GHz");
  const std::string name = waveform_name(options, sensor);
  // Samples of its chirps alone, as recordings are, may be of transmitters in turn.
  const double slots = options.numbers[waveform_number("--slots")].value_or(1.0);
  if (kind_of(name) == WaveformKind::two_stage && slots != 1.0)
    core::throw_input_error(core::ErrorClass::unsupported, "--slots", slots,
                            "1 with two-stage, in whose triangle all transmitters send at once");
  return made(options, name,
              {sensor.waveform.frequency_Hz, sensor.waveform.bandwidth_Hz,
               noise_figure_of(options, sensor), sensor.range.maximum_m()});
}

namespace {

std::string name_without_scene(const FmcwSettings& options) {
  return options.waveform.empty() ? kAutomotive : options.waveform;
}

}  // namespace

FmcwRadar fmcw_radar(const FmcwSettings& options) {
  core::ProblemList problems;
  const auto told = [&](const char* option, const char* key) {
    const auto value = options.numbers[waveform_number(option)];
    if (!value) problems.error(core::ErrorClass::ref, {}, key, "missing", "a number");
    return value.value_or(1.0);
  };
  Front front;
  front.frequency_Hz = told("--frequency", "waveform.frequency_GHz") * 1e9;
  front.bandwidth_Hz = told("--bandwidth", "waveform.bandwidth_MHz") * 1e6;
  if (!options.noise_figure_dB)
    problems.error(core::ErrorClass::ref, {}, "receiver.noise_figure_dB", "missing", "a number");
  problems.throw_if_errors();
  front.noise_figure = core::power_from_dB(*options.noise_figure_dB);
  return made(options, name_without_scene(options), front);
}

void check_has_maps(const FmcwRadar& radar) {
  if (!radar.maps)
    core::throw_input_error(
        core::ErrorClass::unsupported, "waveform.kind", radar.waveform_name,
        "a chirp sequence, of 2 chirps or more: nothing else has maps and detections");
}

void check_detects(const FmcwRadar& radar) {
  check_has_maps(radar);
  const signal::CfarReach& reach = radar.detection.cfar.along_rows;
  const int window = 2 * (reach.guard + reach.reference);
  if (radar.axes.doppler_cells <= window)
    core::throw_input_error(core::ErrorClass::range, "--chirps", radar.axes.doppler_cells,
                            "more than the " + std::to_string(window) +
                                " Doppler cells over which --cfar-guard and --cfar-training reach");
  if (!(radar.detection.cfar.design_probability > 0.0))
    core::throw_input_error(
        core::ErrorClass::range, "--cfar-guard",
        fmt::format("{},{}", radar.detection.cfar.along_columns.guard, reach.guard),
        "more, over the main lobe of the windows: cells in it tell nothing of "
        "the background");
}

void check_tells_samples(const FmcwSettings& options) {
  const std::string name = name_without_scene(options);
  if (name != kAutomotive && is_sequence(kind_of(name)) &&
      !options.numbers[waveform_number("--sample-rate")])
    core::throw_input_error(core::ErrorClass::ref, "waveform.sample_rate_MHz", "missing",
                            "the rate that the samples were taken at");
}

}  // namespace fanbeam::session
