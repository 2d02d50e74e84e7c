#include "apps/waveform_command.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "session/signal/mixer_files.h"
#include "session/signal/waveform_choice.h"
#include "session/signal/waveform_figures.h"
#include "signal/waveform/doppler.h"
#include "signal/waveform/folding.h"

namespace fanbeam::apps {
namespace {

struct Beat {
  int stage;
  bool up;
  double beat_Hz;
};

struct Target {
  signal::ScatterPath path;
  double doppler_shift_Hz = 0.0;
  std::vector<Beat> beats;  // one of every slope of every stage that has one
  std::vector<core::Problem> warnings;
};

std::optional<Target> target_of(const WaveformOptions& options, const signal::Waveform& waveform) {
  if (!options.range_m) return std::nullopt;
  Target target;
  target.path.range_m = *options.range_m;
  target.path.radial_speed_mps = options.speed_mps.value_or(0.0);
  const auto policy =
      options.refuse_folding ? signal::FoldingPolicy::refuse : signal::FoldingPolicy::count;
  target.warnings =
      signal::folding_warnings(signal::count_folding(waveform, {target.path}, policy));
  target.doppler_shift_Hz =
      signal::doppler_shift_Hz(target.path.radial_speed_mps, waveform.centre_frequency_Hz);
  for (const signal::Segment& segment : waveform.segments) {
    const bool up = segment.slope_Hz_per_s > 0.0;
    const bool known = !target.beats.empty() && target.beats.back().stage == segment.stage &&
                       target.beats.back().up == up;
    if (segment.slope_Hz_per_s == 0.0 || known) continue;
    const double range_m = target.path.range_m + target.path.radial_speed_mps * segment.middle_s();
    target.beats.push_back(
        {segment.stage, up, signal::beat_Hz(segment, range_m, target.path.radial_speed_mps)});
  }
  return target;
}

nlohmann::ordered_json json_of(const signal::Waveform& waveform,
                               const std::optional<Target>& target) {
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(session::waveform_json(waveform));
  if (!target) return json;
  nlohmann::ordered_json beats = nlohmann::ordered_json::array();
  for (const Beat& beat : target->beats)
    beats.push_back(
        {{"stage", beat.stage}, {"ramp", beat.up ? "up" : "down"}, {"beat_Hz", beat.beat_Hz}});
  nlohmann::ordered_json warnings = nlohmann::ordered_json::array();
  for (const core::Problem& warning : target->warnings) warnings.push_back(to_string(warning));
  json["target"] = {{"range_m", target->path.range_m},
                    {"radial_speed_mps", target->path.radial_speed_mps},
                    {"doppler_shift_Hz", target->doppler_shift_Hz},
                    {"beats", beats},
                    {"warnings", warnings}};
  return json;
}

void print_tables(const signal::Waveform& waveform) {
  const std::vector<signal::StageFigures> stages = signal::figures(waveform);
  fmt::print("{}: {:.6g} GHz, wavelength {:.6g} mm, bandwidth {:.6g} MHz, {:.6g} ms, {} samples\n",
             signal::name(waveform.kind), waveform.centre_frequency_Hz * 1e-9,
             waveform.wavelength_m() * 1e3, waveform.bandwidth_Hz * 1e-6,
             waveform.duration_s() * 1e3, waveform.complex_baseband ? "complex" : "real");
  for (std::size_t i = 0; i < stages.size(); ++i) {
    fmt::print("\nstage {}, sampled at {:.6g} MHz\n", i, waveform.sample_rate_Hz[i] * 1e-6);
    for (const session::WaveformFigure& figure : session::waveform_figures(stages[i]))
      if (figure.value)
        fmt::print("  {:<30} {:>14.8g} {}\n", figure.text, *figure.value, figure.unit);
  }
}

void print_target(const Target& target) {
  fmt::print("\ntarget at {:.8g} m, {:.8g} m/s: Doppler shift of the echo {:.8g} Hz\n",
             target.path.range_m, target.path.radial_speed_mps, target.doppler_shift_Hz);
  for (const Beat& beat : target.beats)
    fmt::print("  stage {}, ramp {:<4}  beat {:>16.8g} Hz\n", beat.stage, beat.up ? "up" : "down",
               beat.beat_Hz);
}

// The factories name fields; here they are options.
core::Problem in_words_of_options(core::Problem problem) {
  constexpr std::pair<const char*, const char*> kNames[] = {{"frequency_Hz", "--frequency"},
                                                            {"bandwidth_Hz", "--bandwidth"},
                                                            {"deviation_Hz", "--bandwidth"},
                                                            {"sample_rate_Hz", "--sample-rate"},
                                                            {"interval_s", "--interval"},
                                                            {"ramp_s", "--ramp"},
                                                            {"second_ramp_s", "--second-ramp"},
                                                            {"pulse_width_s", "--pulse-width"},
                                                            {"hop_Hz", "--hop"},
                                                            {"|shift_Hz|", "--shift"},
                                                            {"chirps x slots", "--chirps"},
                                                            {"samples", "--sample-rate"}};
  for (const auto& [field, option] : kNames)
    if (problem.field == field) problem.field = option;
  return problem;
}

}  // namespace

int waveform(const WaveformOptions& options, const CommonOptions& common) {
  try {
    const signal::Waveform made = session::chosen_waveform(options);
    const std::optional<Target> target = target_of(options, made);
    if (!options.mixer.empty())
      session::write_mixer(options.mixer, signal::mixer_trace(made, target->path),
                           fmt::format("{}: echo at {:.6g} m, {:.6g} m/s", signal::name(made.kind),
                                       target->path.range_m, target->path.radial_speed_mps));
    if (options.json) {
      fmt::print("{}\n", json_of(made, target).dump(2));
    } else {
      print_tables(made);
      if (target) print_target(*target);
      if (target && !common.quiet) print_problems(target->warnings);
      if (!options.mixer.empty()) fmt::print("\nmixer {}\n", options.mixer);
    }
  } catch (const core::InputError& error) {
    std::vector<core::Problem> problems;
    for (const core::Problem& problem : error.problems())
      problems.push_back(in_words_of_options(problem));
    throw core::InputError(problems);
  }
  return kExitDone;
}

}  // namespace fanbeam::apps
