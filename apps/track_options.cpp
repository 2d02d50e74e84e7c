#include <CLI/CLI.hpp>

#include "apps/command_line.h"
#include "apps/number_check.h"
#include "apps/track_command.h"
#include "apps/value_words.h"

namespace fanbeam::apps {

namespace {

void add_own_data(CLI::App& command, TrackOptions& options) {
  command
      .add_option("--radar", options.radar_file,
                  "TOML file of the radar (docs/fmcw.md) that a scene is seen by or that recorded "
                  "samples or detections (default: the scene's, or radar.toml in the folder)")
      ->type_name(kFileValue);
  add_frames_option(command, options.frames, "Of a scene, A:B[:STEP] (default: all)");
  command.add_option("--sensor", options.sensor, "Of a scene, instead of its own")
      ->type_name(kSensorValue);
  command.add_option("--data", options.data, "Folder of terrain data, of a scene")
      ->type_name(kFolderValue);
  command
      .add_option("--radar-speed", options.radar_speed_mps,
                  "m/s forward, which tells what moves (default: as the scene, JSON of detections "
                  "or, for tables and samples, the run.json of fanbeam fmcw in the folder above "
                  "them tell, else 0)")
      ->check(number_from(-1000.0, 1000.0));
  command
      .add_option(
          "--frame-period", options.frame_period_s,
          "Seconds from frame to frame of samples (default: as the run.json of fanbeam fmcw "
          "beside them tells, else 0.05)")
      ->check(number_from(1e-6, 3600.0));
  command
      .add_option(
          "--body-errors", options.errors,
          "How far the echo of a body wanders over it: range in m, speed in m/s, azimuth in "
          "deg (default 0.3,0.1,1)")
      ->type_name("M,MPS,DEG")
      ->delimiter(',')
      ->expected(3)
      ->check(number_from(0.0, 1000.0));
}

// How measurements become tracks, of any input.
void add_tracker(CLI::App& command, TrackOptions& options) {
  command
      .add_option("--association", options.association,
                  "Measurements to tracks: best assignment, or joint probabilities")
      ->check(CLI::IsMember({"nearest", "joint"}))
      ->capture_default_str();
  command
      .add_option(
          "--acceleration", options.acceleration_mps2,
          "m/s2, unknown to the tracker, of targets that drive straight on: 0.5 for steady "
          "traffic. Braking has a model of its own, but not with --range-only: 4 to 8 there. "
          "More tells less of who is who after a crossing")
      ->check(number_from(0.01, 20.0))
      ->capture_default_str();
  command
      .add_option("--coast", options.coast_s, "Seconds that a track lives without a measurement")
      ->check(number_from(0.0, 60.0))
      ->capture_default_str();
}

// Of highway scenarios.
void add_simulation(CLI::App& command, TrackOptions& options) {
  command
      .add_option(
          "--waveform", options.scheme,
          "How beats become ranges and speeds: one triangle (all pairs, with ghosts; or "
          "pairs in order), two slopes, two stages, or a coded stretch between two ramps (default "
          "two-stage, or what the scenario names); ramps as the file has them")
      ->check(CLI::IsMember({"triangle", "sorted-triangle", "two-slopes", "two-stage", "coded"}));
  command
      .add_option("--detection-probability", options.detection_probability,
                  "Of each target in each frame")
      ->check(number_from(0.0, 1.0))
      ->capture_default_str();
  command.add_option("--false-measurements", options.false_per_frame, "Mean number in a frame")
      ->check(number_from(0.0, 100.0))
      ->capture_default_str();
  command.add_option("--noise-figure", options.noise_figure_dB, "dB, instead of the file's")
      ->check(number_from(0.0, 60.0));
  command.add_flag("--range-only", options.range_only,
                   "One receiver without azimuth: tracks of range and range rate alone");
  CLI::Option* samples = command.add_flag(
      "--samples", options.samples,
      "Measure from beat samples and noise (two stages) instead of from frequencies");
  samples->excludes("--waveform")->excludes("--detection-probability");
  samples->excludes("--false-measurements")->excludes("--range-only");
  command.add_option("--run", options.run, "Another draw of the same seed")
      ->check(whole_number_from(0, 1000000))
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
  command.add_option("--draws", options.family_draws, "Of each family of a study")
      ->check(whole_number_from(1, 10000))
      ->needs(study)
      ->capture_default_str();
}

}  // namespace

CLI::App& add_track_command(CLI::App& program, TrackOptions& options) {
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

}  // namespace fanbeam::apps
