#include "session/signal/radar_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "core/config_table.h"
#include "core/decibel.h"
#include "core/units.h"
#include "session/signal/sample_file.h"
#include "session/signal/waveform_choice.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::session {
namespace {

using core::ConfigTable;
using core::ErrorClass;

constexpr std::array<std::pair<const char*, signal::CfarKind>, 4> kCfarWords = {
    {{"ca", signal::CfarKind::cell_averaging},
     {"os", signal::CfarKind::ordered_statistic},
     {"go", signal::CfarKind::greatest_of},
     {"so", signal::CfarKind::smallest_of}}};

void read_waveform(ConfigTable table, FmcwSettings& settings) {
  if (!table.present()) return;
  if (const auto kind = table.optional_text("kind")) {
    if (*kind != kAutomotive && !signal::waveform_kind(*kind))
      table.error(ErrorClass::ref, "kind", "\"" + *kind + "\"",
                  "one of: " + std::string(kAutomotive) + ", " + waveform_kinds_text());
    settings.waveform = *kind;
  }
  settings.real = table.boolean("real", settings.real);
  for (std::size_t i = 0; i < kWaveformNumbers.size(); ++i) {
    const WaveformNumber& number = kWaveformNumbers[i];
    if (const auto value = table.optional_number(number.key, {number.least, number.most}))
      settings.numbers[i] = *value;
  }
}

// The places of one side of the array; empty where the line is meant.
std::vector<glm::dvec3> read_places(ConfigTable& table, const std::string& side) {
  constexpr core::NumberRange kPlaces{-10.0, 10.0};
  const auto list = [&](const char* axis) { return table.numbers(side + axis, kPlaces, 1, 64); };
  const std::vector<double> right = list("_right_m"), forward = list("_forward_m"),
                            up = list("_up_m");
  for (const auto& [axis, values] : {std::pair{"_forward_m", &forward}, std::pair{"_up_m", &up}})
    if (!values->empty() && values->size() != right.size())
      table.error(ErrorClass::range, side + axis, std::to_string(values->size()) + " numbers",
                  "as many as " + side + "_right_m, " + std::to_string(right.size()));
  std::vector<glm::dvec3> places;
  for (std::size_t i = 0; i < right.size(); ++i)
    places.emplace_back(i < forward.size() ? forward[i] : 0.0, right[i],
                        i < up.size() ? up[i] : 0.0);
  return places;
}

// Of places, the line's figures say nothing: counts may stand beside them where they are the same.
void refuse_line_beside_places(ConfigTable& table, const FmcwSettings& settings) {
  const auto check = [&](const char* key, int count, std::size_t places) {
    if (places > 0 && table.has(key) && static_cast<std::size_t>(count) != places)
      table.error(ErrorClass::range, key, std::to_string(count),
                  std::to_string(places) + ", the number of places, or no such key");
  };
  check("transmitters", settings.transmitters, settings.transmitters_m.size());
  check("receivers", settings.receivers, settings.receivers_m.size());
  if (!settings.receivers_m.empty() && table.has("pitch_wavelengths"))
    table.error(ErrorClass::unsupported, "pitch_wavelengths",
                core::number_text(settings.pitch_wavelengths),
                "a pitch or places of the elements, not both");
}

void read_array(ConfigTable table, FmcwSettings& settings) {
  if (!table.present()) return;
  settings.transmitters =
      static_cast<int>(table.integer("transmitters", 1, 64, settings.transmitters));
  settings.receivers = static_cast<int>(table.integer("receivers", 1, 64, settings.receivers));
  settings.pitch_wavelengths =
      table.number("pitch_wavelengths", {0.0, 1000.0, true}, settings.pitch_wavelengths);
  settings.transmitters_m = read_places(table, "transmitter");
  settings.receivers_m = read_places(table, "receiver");
  refuse_line_beside_places(table, settings);
  if (settings.transmitters_m.empty() != settings.receivers_m.empty())
    table.error(ErrorClass::ref,
                settings.transmitters_m.empty() ? "transmitter_right_m" : "receiver_right_m",
                "missing", "places of both sides, or of none");
  settings.gain_errors_dB = table.numbers("gain_errors_dB", {-60.0, 60.0}, 1, 4096);
  settings.phase_errors_rad = table.numbers("phase_errors_deg", {-360.0, 360.0}, 1, 4096);
  for (double& phase : settings.phase_errors_rad) phase = core::radians(phase);
}

void read_receiver(ConfigTable table, FmcwSettings& settings) {
  if (!table.present()) return;
  if (const auto figure = table.optional_number("noise_figure_dB", {0.0, 60.0}))
    settings.noise_figure_dB = figure;
  settings.line_width_Hz = table.number("line_width_Hz", {0.0, 1e6}, settings.line_width_Hz);
  signal::PhaseNoiseTable noise;
  noise.offsets_Hz = table.numbers("phase_noise_offsets_kHz", {0.0, 1e9, true}, 1, 100);
  noise.levels_dBc_per_Hz = table.numbers("phase_noise_dBc_per_Hz", {-300.0, 60.0}, 1, 100);
  for (double& offset : noise.offsets_Hz) offset *= 1e3;
  if (noise.offsets_Hz.size() != noise.levels_dBc_per_Hz.size())
    table.error(ErrorClass::range, "phase_noise_dBc_per_Hz",
                std::to_string(noise.levels_dBc_per_Hz.size()) + " numbers",
                "one for each of " + std::to_string(noise.offsets_Hz.size()) + " offsets");
  else if (std::adjacent_find(noise.offsets_Hz.begin(), noise.offsets_Hz.end(),
                              std::greater_equal<>()) != noise.offsets_Hz.end())
    table.error(ErrorClass::range, "phase_noise_offsets_kHz", "not rising", "rising offsets");
  else
    settings.phase_noise = noise;
  if (!noise.offsets_Hz.empty() && table.has("line_width_Hz"))
    table.error(ErrorClass::unsupported, "line_width_Hz", core::number_text(settings.line_width_Hz),
                "a line width or a table of phase noise, not both");
  settings.adc_bits = static_cast<int>(table.integer("adc_bits", 0, 24, settings.adc_bits));
  if (const auto scale = table.optional_number("adc_full_scale_dBm", {-300.0, 300.0}))
    settings.adc_full_scale_dBm = scale;
}

void read_samples(ConfigTable table, SampleLayout& layout) {
  if (!table.present()) return;
  if (const auto axes = table.optional_text("axes")) {
    if (const auto found = sample_axes(*axes))
      layout.axes = *found;
    else
      table.error(ErrorClass::ref, "axes", "\"" + *axes + "\"", kAxesWords);
  }
  layout.scale_sqrtW = table.number("scale_sqrtW", {1e-30, 1e9}, layout.scale_sqrtW);
  layout.conjugate = table.boolean("conjugate", layout.conjugate);
  layout.channel_gains_dB = table.numbers("channel_gain_dB", {-60.0, 60.0}, 1, 4096);
  layout.channel_phases_rad = table.numbers("channel_phase_deg", {-360.0, 360.0}, 1, 4096);
  for (double& phase : layout.channel_phases_rad) phase = core::radians(phase);
}

void read_window(ConfigTable& table, const char* key, signal::Window& window) {
  const auto text = table.optional_text(key);
  if (!text) return;
  if (const auto found = signal::window_of(*text))
    window = *found;
  else
    table.error(ErrorClass::ref, key, "\"" + *text + "\"", kWindowWords);
}

void read_span(ConfigTable& table, const char* key, CellSpan& span) {
  const std::vector<double> cells = table.numbers(key, {0.0, 64.0}, 2, 2);
  if (cells.size() != 2) return;
  for (const double count : cells)
    if (count != std::floor(count))
      table.error(ErrorClass::range, key, core::number_text(count), "whole numbers");
  span = {static_cast<int>(cells[0]), static_cast<int>(cells[1])};
}

void read_processing(ConfigTable table, ProcessingSettings& settings) {
  if (!table.present()) return;
  read_window(table, "range_window", settings.range_window);
  read_window(table, "doppler_window", settings.doppler_window);
  read_window(table, "angle_window", settings.angle_window);
  if (table.has("mitigation"))
    settings.mitigation = static_cast<signal::Mitigation>(
        table.choice("mitigation", {"none", "zero", "interpolate"}, 0));
  if (const auto threshold_dB = table.optional_number("mitigation_threshold_dB", {0.0, 60.0, true}))
    settings.mitigation_threshold = core::power_from_dB(*threshold_dB);
  if (table.has("cfar"))
    settings.cfar = kCfarWords[table.choice("cfar", {"ca", "os", "go", "so"}, 1)].second;
  read_span(table, "cfar_guard", settings.cfar_guard);
  read_span(table, "cfar_training", settings.cfar_training);
  settings.false_alarm_probability =
      table.number("false_alarm_probability", {1e-12, 0.1}, settings.false_alarm_probability);
  if (table.has("angle_method"))
    settings.angle_method = static_cast<signal::AngleMethod>(
        table.choice("angle_method", {"beamforming", "capon", "music"}, 0));
  if (const auto place = table.optional_number("cluster_place_m", {0.0, 1000.0, true}))
    settings.cluster_place_m = place;
  if (const auto speed = table.optional_number("cluster_speed_mps", {0.0, 1000.0, true}))
    settings.cluster_speed_mps = speed;
  settings.cluster_neighbours =
      static_cast<int>(table.integer("cluster_neighbours", 1, 100, settings.cluster_neighbours));
  settings.unfold = table.boolean("unfold", settings.unfold);
  if (const auto range = table.optional_number("most_range_m", {0.0, 1e6, true}))
    settings.most_range_m = range;
}

void read(ConfigTable root, FmcwSettings& settings) {
  if (!root.present()) return;
  read_waveform(root.table("waveform"), settings);
  read_array(root.table("array"), settings);
  read_receiver(root.table("receiver"), settings);
  read_samples(root.table("samples"), settings.layout);
  read_processing(root.table("processing"), settings);
  root.report_unknown_keys();
}

// The shortest text that reads back as the number.
std::string digits(double value) { return fmt::format("{}", value); }

std::string list(const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(digits(value));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

std::string places_toml(const char* side, const std::vector<glm::dvec3>& places) {
  std::vector<double> forward, right, up;
  for (const glm::dvec3& place : places) {
    forward.push_back(place.x);
    right.push_back(place.y);
    up.push_back(place.z);
  }
  return fmt::format("{0}_forward_m = {1}\n{0}_right_m = {2}\n{0}_up_m = {3}\n", side,
                     list(forward), list(right), list(up));
}

std::string array_toml(const ArraySettings& array) {
  std::string text = "\n[array]\n";
  if (array.transmitters_m.empty())
    text += fmt::format("transmitters = {}\nreceivers = {}\npitch_wavelengths = {}\n",
                        array.transmitters, array.receivers, digits(array.pitch_wavelengths));
  else
    text += places_toml("transmitter", array.transmitters_m) +
            places_toml("receiver", array.receivers_m);
  if (!array.gain_errors_dB.empty())
    text += fmt::format("gain_errors_dB = {}\n", list(array.gain_errors_dB));
  if (!array.phase_errors_rad.empty()) {
    std::vector<double> phases_deg = array.phase_errors_rad;
    for (double& phase : phases_deg) phase = core::degrees(phase);
    text += fmt::format("phase_errors_deg = {}\n", list(phases_deg));
  }
  return text;
}

std::string receiver_toml(const ReceiverSettings& receiver, double noise_figure) {
  std::string text =
      fmt::format("\n[receiver]\nnoise_figure_dB = {}\n", digits(10.0 * std::log10(noise_figure)));
  if (receiver.line_width_Hz > 0.0)
    text += fmt::format("line_width_Hz = {}\n", digits(receiver.line_width_Hz));
  if (!receiver.phase_noise.empty()) {
    std::vector<double> offsets_kHz = receiver.phase_noise.offsets_Hz;
    for (double& offset : offsets_kHz) offset *= 1e-3;
    text += fmt::format("phase_noise_offsets_kHz = {}\nphase_noise_dBc_per_Hz = {}\n",
                        list(offsets_kHz), list(receiver.phase_noise.levels_dBc_per_Hz));
  }
  if (receiver.adc_bits > 0) text += fmt::format("adc_bits = {}\n", receiver.adc_bits);
  if (receiver.adc_full_scale_dBm)
    text += fmt::format("adc_full_scale_dBm = {}\n", digits(*receiver.adc_full_scale_dBm));
  return text;
}

std::string processing_toml(const ProcessingSettings& settings) {
  std::string text = fmt::format(
      "\n[processing]\nrange_window = \"{}\"\ndoppler_window = \"{}\"\nangle_window = \"{}\"\n"
      "mitigation = \"{}\"\n"
      "cfar = \"{}\"\ncfar_guard = [{}, {}]\ncfar_training = [{}, {}]\n"
      "false_alarm_probability = {}\nangle_method = \"{}\"\ncluster_neighbours = {}\n",
      signal::name(settings.range_window), signal::name(settings.doppler_window),
      signal::name(settings.angle_window), signal::name(settings.mitigation),
      cfar_word(settings.cfar), settings.cfar_guard.range, settings.cfar_guard.doppler,
      settings.cfar_training.range, settings.cfar_training.doppler,
      digits(settings.false_alarm_probability), signal::name(settings.angle_method),
      settings.cluster_neighbours);
  const auto add = [&](const char* key, const std::optional<double>& value) {
    if (value) text += fmt::format("{} = {}\n", key, digits(*value));
  };
  add("cluster_place_m", settings.cluster_place_m);
  add("cluster_speed_mps", settings.cluster_speed_mps);
  add("most_range_m", settings.most_range_m);
  if (settings.mitigation_threshold != signal::kCrossedOverMedian)
    text += fmt::format("mitigation_threshold_dB = {}\n",
                        digits(10.0 * std::log10(settings.mitigation_threshold)));
  if (settings.unfold) text += "unfold = true\n";
  return text;
}

}  // namespace

void read_radar_file(const std::filesystem::path& file, FmcwSettings& settings,
                     core::ProblemList& problems) {
  read(ConfigTable::from_file(file, problems), settings);
}

FmcwSettings radar_settings(const std::filesystem::path& file) {
  FmcwSettings settings;
  core::ProblemList problems;
  read_radar_file(file, settings, problems);
  problems.throw_if_errors();
  return settings;
}

void read_radar_text(std::string_view text, const std::string& name, FmcwSettings& settings,
                     core::ProblemList& problems) {
  read(ConfigTable::from_text(text, name, problems), settings);
}

std::string radar_toml(const FmcwSettings& settings, const std::string& waveform,
                       const RadarFigures& figures) {
  std::string text = fmt::format("[waveform]\nkind = \"{}\"\n", waveform);
  if (settings.real) text += "real = true\n";
  for (std::size_t i = 0; i < kWaveformNumbers.size(); ++i) {
    std::optional<double> value = settings.numbers[i];
    const std::string_view option = kWaveformNumbers[i].option;
    const double figure_SI = option == "--frequency"     ? figures.frequency_Hz
                             : option == "--bandwidth"   ? figures.bandwidth_Hz
                             : option == "--sample-rate" ? figures.sample_rate_Hz
                                                         : 0.0;
    if (figure_SI > 0.0) value = figure_SI / kWaveformNumbers[i].to_SI;
    if (value) text += fmt::format("{} = {}\n", kWaveformNumbers[i].key, digits(*value));
  }
  return text + array_toml(settings) + receiver_toml(settings, figures.noise_figure) +
         processing_toml(settings);
}

core::InputError in_radar_file(const core::InputError& error, const std::filesystem::path& file) {
  std::vector<core::Problem> problems = error.problems();
  for (core::Problem& problem : problems) {
    if (problem.place.file.empty()) problem.place.file = file.string();
    for (const WaveformNumber& number : kWaveformNumbers)
      if (problem.field == number.option) problem.field = std::string("waveform.") + number.key;
    if (problem.field.starts_with("--")) problem.field = problem.field.substr(2);
  }
  return core::InputError(std::move(problems));
}

std::string cfar_word(signal::CfarKind kind) {
  for (const auto& [word, each] : kCfarWords)
    if (each == kind) return word;
  throw core::InternalError("unknown detector");
}

std::optional<signal::CfarKind> cfar_kind(std::string_view text) {
  for (const auto& [word, each] : kCfarWords)
    if (word == text) return each;
  return std::nullopt;
}

}  // namespace fanbeam::session
