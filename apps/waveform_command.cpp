// fanbeam waveform: what a radar waveform can measure, and what it reads for a target.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "apps/command_line.h"
#include "apps/commands.h"
#include "apps/option_kinds.h"
#include "session/signal/mixer_files.h"
#include "session/signal/waveform_choice.h"
#include "session/signal/waveform_figures.h"
#include "session/signal/waveform_settings.h"
#include "session/signal/waveform_target.h"
#include "signal/waveform/waveform.h"

namespace fanbeam::apps {
namespace {

struct WaveformOptions : session::WaveformSettings {
  std::optional<double> range_m, speed_mps;  // of a target
  bool refuse_folding = false;
  bool json = false;
  std::string mixer;  // folder of --mixer; empty: none
};

CLI::App& declare_waveform(CLI::App& program, WaveformOptions& options) {
  CLI::App& command = *program.add_subcommand(
      "waveform", "What a radar waveform can measure, and what it reads for a target");
  std::vector<std::string> kinds;
  for (const signal::WaveformKind kind : signal::all_waveform_kinds())
    kinds.emplace_back(signal::name(kind));
  add_word(command, "KIND", options.kind, kinds, "Kind of waveform")->capture_default_str();
  for (std::size_t i = 0; i < session::kWaveformNumbers.size(); ++i) {
    const session::WaveformNumber& number = session::kWaveformNumbers[i];
    add_number(command, number.option, options.numbers[i], {number.least, number.most},
               number.help);
  }
  command.add_flag("--real", options.real, "Real samples: negative beats read as positive ones");
  command.add_flag("--down-first", options.down_first, "The triangle begins with the ramp down");
  CLI::Option* range = add_number(command, "--range", options.range_m, {1e-3, 1e7},
                                  "A target's range, m: prints its beats");
  add_number(command, "--speed", options.speed_mps, {-9e4, 9e4},
             "Its radial speed, m/s, positive receding (default 0)")
      ->needs(range);
  command
      .add_flag("--refuse-folding", options.refuse_folding,
                "A target beyond the unambiguous spans is an error")
      ->needs(range);
  add_folder(command, "--mixer", options.mixer,
             "Folder for what the mixer gets and gives: transmitted, received, product and beat "
             "of the first ramp or step, as tables and a picture")
      ->needs(range);
  command.add_flag("--json", options.json, "Print JSON");
  command.footer(
      "A parameter that the kind does not have is refused. The range of a triangle's target is "
      "that at its turnaround. Beats are transmitted minus received frequency: a receding target's "
      "Doppler is positive.");
  return command;
}

std::optional<session::WaveformTarget> target_of(const WaveformOptions& options,
                                                 const signal::Waveform& waveform) {
  if (!options.range_m) return std::nullopt;
  signal::ScatterPath path;
  path.range_m = *options.range_m;
  path.radial_speed_mps = options.speed_mps.value_or(0.0);
  return session::target_seen_by(
      waveform, path,
      options.refuse_folding ? signal::FoldingPolicy::refuse : signal::FoldingPolicy::count);
}

nlohmann::ordered_json json_of(const signal::Waveform& waveform,
                               const std::optional<session::WaveformTarget>& target) {
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(session::waveform_json(waveform));
  if (target)
    json["target"] = nlohmann::ordered_json::parse(session::waveform_target_json(*target));
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

void print_target(const session::WaveformTarget& target) {
  fmt::print("\ntarget at {:.8g} m, {:.8g} m/s: Doppler shift of the echo {:.8g} Hz\n",
             target.path.range_m, target.path.radial_speed_mps, target.doppler_shift_Hz);
  for (const session::SlopeBeat& beat : target.beats)
    fmt::print("  stage {}, ramp {:<4}  beat {:>16.8g} Hz\n", beat.stage, beat.up ? "up" : "down",
               beat.beat_Hz);
}

int waveform(const WaveformOptions& options, const CommonOptions& common) {
  const signal::Waveform made = session::chosen_waveform(options);
  const std::optional<session::WaveformTarget> target = target_of(options, made);
  if (!options.mixer.empty())
    session::write_mixer(options.mixer, signal::mixer_trace(made, target->path),
                         fmt::format("{}: echo at {:.6g} m, {:.6g} m/s", signal::name(made.kind),
                                     target->path.range_m, target->path.radial_speed_mps));
  if (options.json) {
    fmt::print("{}\n", json_of(made, target).dump(2));
    return kExitDone;
  }
  print_tables(made);
  if (target) print_target(*target);
  if (target && !common.quiet) print_problems(target->warnings);
  if (!options.mixer.empty()) fmt::print("\nmixer {}\n", options.mixer);
  return kExitDone;
}

}  // namespace

void add_waveform(CommandLine& line) { line.add(declare_waveform, waveform); }

}  // namespace fanbeam::apps
