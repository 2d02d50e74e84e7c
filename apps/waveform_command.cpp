#include "apps/waveform_command.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "session/signal/mixer_files.h"
#include "session/signal/waveform_choice.h"
#include "session/signal/waveform_figures.h"
#include "session/signal/waveform_target.h"

namespace fanbeam::apps {
namespace {

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

}  // namespace

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

}  // namespace fanbeam::apps
