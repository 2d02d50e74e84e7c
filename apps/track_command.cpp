#include "apps/track_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "apps/command_line.h"
#include "apps/commands.h"
#include "apps/option_kinds.h"
#include "apps/progress.h"
#include "apps/track_inputs.h"
#include "scenes/highway_reader.h"
#include "session/signal/tracks/own_tracks.h"
#include "session/signal/tracks/scenario_record.h"
#include "tracking/simulation/sampled_frame.h"
#include "tracking/tracker/track_geometry.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;

void add_own_data(CLI::App& command, TrackOptions& options) {
  add_file(command, "--radar", options.radar_file,
           "TOML file of the radar (docs/fmcw.md) that a scene is seen by or that recorded "
           "samples or detections (default: the scene's, or radar.toml in the folder)");
  add_frames_option(command, options.frames, "Of a scene, A:B[:STEP] (default: all)");
  command.add_option("--sensor", options.sensor, "Of a scene, instead of its own")
      ->type_name(kSensorValue);
  add_folder(command, "--data", options.data, "Folder of terrain data, of a scene");
  add_number(command, "--radar-speed", options.radar_speed_mps, {-1000.0, 1000.0},
             "m/s forward, which tells what moves (default: as the scene, JSON of detections "
             "or, for tables and samples, the run.json of fanbeam fmcw in the folder above "
             "them tell, else 0)");
  add_number(command, "--frame-period", options.frame_period_s, {1e-6, 3600.0},
             "Seconds from frame to frame of samples (default: as the run.json of fanbeam fmcw "
             "beside them tells, else 0.05)");
  add_number(command, "--body-errors", options.errors, {0.0, 1000.0},
             "How far the echo of a body wanders over it: range in m, speed in m/s, azimuth in "
             "deg (default 0.3,0.1,1)")
      ->type_name("M,MPS,DEG")
      ->delimiter(',')
      ->expected(3);
}

// How measurements become tracks, of any input.
void add_tracker(CLI::App& command, TrackOptions& options) {
  add_word(command, "--association", options.association, {"nearest", "joint"},
           "Measurements to tracks: best assignment, or joint probabilities")
      ->capture_default_str();
  add_number(command, "--acceleration", options.acceleration_mps2, {0.01, 20.0},
             "m/s2, unknown to the tracker, of targets that drive straight on: 0.5 for steady "
             "traffic. Braking has a model of its own, but not with --range-only: 4 to 8 there. "
             "More tells less of who is who after a crossing")
      ->capture_default_str();
  add_number(command, "--coast", options.coast_s, {0.0, 60.0},
             "Seconds that a track lives without a measurement")
      ->capture_default_str();
}

// Of highway scenarios.
void add_simulation(CLI::App& command, TrackOptions& options) {
  add_word(command, "--waveform", options.scheme,
           {"triangle", "sorted-triangle", "two-slopes", "two-stage", "coded"},
           "How beats become ranges and speeds: one triangle (all pairs, with ghosts; or "
           "pairs in order), two slopes, two stages, or a coded stretch between two ramps (default "
           "two-stage, or what the scenario names); ramps as the file has them");
  add_number(command, "--detection-probability", options.detection_probability, {0.0, 1.0},
             "Of each target in each frame")
      ->capture_default_str();
  add_number(command, "--false-measurements", options.false_per_frame, {0.0, 100.0},
             "Mean number in a frame")
      ->capture_default_str();
  add_number(command, "--noise-figure", options.noise_figure_dB, {0.0, 60.0},
             "dB, instead of the file's");
  command.add_flag("--range-only", options.range_only,
                   "One receiver without azimuth: tracks of range and range rate alone");
  CLI::Option* samples = command.add_flag(
      "--samples", options.samples,
      "Measure from beat samples and noise (two stages) instead of from frequencies");
  samples->excludes("--waveform")->excludes("--detection-probability");
  samples->excludes("--false-measurements")->excludes("--range-only");
  add_whole_number(command, "--run", options.run, {0, 1000000}, "Another draw of the same seed")
      ->capture_default_str();
}

// Beside it stands only what it does not vary itself.
void add_study(CLI::App& command, TrackOptions& options) {
  CLI::Option* study = command.add_flag(
      "--study", options.study,
      "What accuracy costs: buffer, noise figure, reflections, ghosts, waveform and association "
      "against error and time, and families of random traffic, as tables and plots (two minutes); "
      "with --samples the families alone, from samples (a quarter of an hour); needs gnuplot");
  for (const char* studied : {"--waveform", "--association", "--plots", "--run"})
    study->excludes(studied);
  add_whole_number(command, "--draws", options.family_draws, {1, 10000},
                   "Of each family of a study")
      ->needs(study)
      ->capture_default_str();
}

CLI::App& declare_track(CLI::App& program, TrackOptions& options) {
  CLI::App& command = *program.add_subcommand("track",
                                              "A highway scenario, a scene's signals, recorded "
                                              "samples or detections to tracks and metrics");
  command
      .add_option(
          "INPUT", options.file,
          "JSON file of highway scenarios; or a scene; a folder of fanbeam fmcw; detections, "
          ".csv or .json, or a folder of either; samples, .npy")
      ->type_name(kInputValue)
      ->required();
  add_own_data(command, options);
  command.add_option("--scenario", options.scenario, "Id of one scenario (default: all)");
  add_output_option(command, options.output,
                    "Folder to write to (default out/<file's name>-tracks)");
  add_tracker(command, options);
  add_simulation(command, options);
  command.add_flag("--plots", options.plots, "Draw range and errors over time too (needs gnuplot)");
  add_seed_option(command, options.seed);
  add_study(command, options);
  command.footer(
      "Writes tracks.csv (with the covariance of x, y, vx, vy and the normalised error squared "
      "against the truth) and measurements.csv for each scenario, run.json with the metrics and "
      "timing.json; plots that an earlier run.json there lists are removed. With --study it writes "
      "study.md and its plots instead. Prints where each track ended, "
      "where its target is, and how likely the track is still on the target it began with. "
      "Of a scene, its point targets are the truth: run.json and the summary tell how often each "
      "was "
      "followed within 4 m and 2 m/s. --waveform, --samples, --study and what else concerns the "
      "simulated radar belong to highway scenarios alone. "
      "Places are relative to the radar, x forward and y right; azimuths positive right, speeds "
      "positive receding.");
  command.parse_complete_callback([&command, &options] {
    for (const CLI::Option* option : command.get_options())
      if (option->count() > 0) options.given.insert(option->get_name());
  });
  return command;
}

// Where nothing was measured against a target there is no error, not one of 0.
std::string rms_text(const tracking::MeanSquare& errors, const char* unit) {
  return errors.count() > 0 ? fmt::format("{:.4g} {} rms", errors.rms(), unit) : "-";
}

void print(const core::HighwayScenario& scenario, const session::ScenarioTracks& tracks) {
  const tracking::ScenarioScore& score = tracks.score;
  fmt::print(
      "{:<4} {:>2} tracks of {} targets, GOSPA {:.3f} m, MOTA {}, {} switches, range {}, speed "
      "{}\n",
      scenario.id, score.tracks.size(), scenario.targets.size(), score.gospa_m.mean(),
      score.mot.instances() > 0 ? fmt::format("{:.4f}", score.mot.mota()) : "-",
      score.mot.switches(), rms_text(score.range_m, "m"), rms_text(score.range_rate_mps, "m/s"));
  if (tracks.beyond > 0)
    fmt::print(
        "     W-FOLDED: {} times a target in view is beyond what these samples show: farther than "
        "their range cells, above {:g} m/s, of a beat over half the triangle's sample rate, or at "
        "an azimuth that elements so far apart do not tell from another\n",
        tracks.beyond, tracking::SampledRadar::most_speed_mps());
  for (const tracking::Crossing& one : tracks.crossings)
    fmt::print("     tracks {} and {} {} at {:.2f} s, exchanged with probability {:.2g}\n",
               one.first, one.second, one.given_up ? "were one for too long" : "parted", one.time_s,
               one.swap_probability);
  for (const tracking::Track& track : tracks.tracks_at_end) {
    if (!track.confirmed) continue;
    const int target = session::target_of(score, track.id);
    const std::string truth =
        target < 0 ? std::string("no target there")
                   : fmt::format("{} at {:.3f} m, its identity right with probability {:.6g}",
                                 scenario.targets[static_cast<std::size_t>(target)].id,
                                 tracks.last.truth[static_cast<std::size_t>(target)].range_m,
                                 track.identity_probability);
    fmt::print("     track {} ends at {:.3f} m, exists with probability {:.6g}: {}\n", track.id,
               polar(track.state).range_m, track.existence.probability(), truth);
  }
}

fs::path output_of(const TrackOptions& options, const std::string& name,
                   const std::vector<std::string>& parts) {
  const fs::path folder =
      options.output.empty() ? fs::path("out") / (name + "-tracks") : fs::path(options.output);
  check_output(options.file, folder, parts);
  return folder;
}

void print_record(const fs::path& file) { fmt::print("record {}\n", full_path(file)); }

void print(const session::MeasuredSource& source, const session::OwnTracks& tracks) {
  fmt::print("{}: {} frames of {}, {:.1f} detections and {:.1f} measurements a frame\n",
             source.name, tracks.frames, source.kind,
             static_cast<double>(tracks.detections) / tracks.frames,
             static_cast<double>(tracks.measured) / tracks.frames);
  fmt::print("{} tracks confirmed, {} of them of something that moves\n", tracks.confirmed.size(),
             tracks.moving());
  if (!source.resolution)
    fmt::print("no radar is told (--radar): what it can resolve is assumed, see run.json\n");
  for (const auto& [name, one] : tracks.targets)
    fmt::print("     {:<32} followed {:>3} of {} times that it is seen\n", name, one.followed,
               one.seen);
}

session::OwnTracks tracks_of(session::MeasuredSource& source, const TrackOptions& options,
                             bool quiet) {
  Progress progress(source.name, source.frames(), quiet);  // ends before anything is printed
  return session::track_source(source, options, [&](int done) { progress.step(done); });
}

int track_own_data(const TrackOptions& options, session::TrackInput input,
                   const CommonOptions& common) {
  if (!options.output.empty())
    check_output(options.file, options.output, {""});  // before all is read
  const auto source = own_source(options, input);
  const fs::path folder = output_of(options, source->name, {""});
  const session::OwnTracks tracks = tracks_of(*source, options, common.quiet);
  write_own_tracks(tracks, *source, options, body_errors(options), options.plots, folder);
  if (common.quiet) return kExitDone;
  print_problems(source->warnings);
  print(*source, tracks);
  print_record(folder / "run.json");
  return kExitDone;
}

int study(const TrackOptions& options, const scenes::HighwayFile& file,
          const std::vector<session::StudyScenario>& scenarios, const fs::path& folder,
          bool quiet) {
  session::track_study(scenarios, radar_under(options, file.radar), options, folder,
                       [&](const char* part) {
                         if (!quiet) fmt::print("{}\n", part);
                       });
  if (!quiet) print_record(folder / "study.md");
  return kExitDone;
}

// From frequencies, fewer are done in seconds: a bar would only flicker.
constexpr int kManyFrames = 50'000;

session::ScenarioTracks track_one(const TrackOptions& options, const session::StudyScenario& one,
                                  bool quiet) {
  const int frames = tracking::frames_of(*one.scenario, one.radar);
  Progress progress(one.scenario->id, frames, quiet || !(options.samples || frames > kManyFrames));
  return session::track_scenario(*one.scenario, one.radar, options,
                                 [&](int done) { progress.step(done); });
}

int track(const TrackOptions& options, const CommonOptions& common) {
  const session::TrackInput input = session::track_input(options.file);
  refuse_other_options(options, input);
  if (input != session::TrackInput::scenarios) return track_own_data(options, input, common);
  const scenes::HighwayFile file = scenes::read_highway_file(options.file);
  const auto scenarios = session::chosen_scenarios(file, options.scenario, options);
  std::vector<std::string> parts;
  if (!options.study)
    for (const session::StudyScenario& one : scenarios) parts.push_back(one.scenario->id);
  const fs::path folder = output_of(options, fs::path(options.file).stem().string(), parts);
  if (options.study) return study(options, file, scenarios, folder, common.quiet);
  core::ProblemList problems;
  for (const session::StudyScenario& one : scenarios)
    session::check_waveform(*one.scenario, options, problems);
  problems.throw_if_errors();
  session::ScenarioRecord record(options);
  session::TrackPlots plots(folder);
  for (const session::StudyScenario& one : scenarios) {
    const session::ScenarioTracks tracks = track_one(options, one, common.quiet);
    write_scenario_tracks(*one.scenario, tracks, options.plots, folder, plots);
    if (!common.quiet) print(*one.scenario, tracks);
    record.add(one, tracks);
  }
  record.write(folder, plots);
  if (!common.quiet) print_record(folder / "run.json");
  return kExitDone;
}

}  // namespace

void add_track(CommandLine& line) { line.add(declare_track, track); }

}  // namespace fanbeam::apps
