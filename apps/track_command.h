// fanbeam track: road scenarios to measurements, tracks, errors and metrics.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/common.h"
#include "tracking/simulation/scenario_run.h"

namespace fanbeam::apps {

struct TrackOptions {
  std::string file;
  std::string scenario;  // its id; empty: all of the file
  std::string output;    // default out/<file's name>-tracks
  std::string scheme;    // empty: two-stage, unless the scenario names others alone
  std::string association = "nearest";
  double detection_probability = 1.0;
  double false_per_frame = 0.0;
  std::optional<double> noise_figure_dB{};  // instead of the file's
  double acceleration_mps2 = tracking::kSteady_mps2;
  double coast_s = tracking::kCoast_s;
  bool range_only = false;
  bool samples = false;
  bool plots = false;
  bool study = false;
  // Of what is no road scenario (apps/track/own_data.h).
  std::string radar_file, frames, sensor, data;
  std::optional<double> radar_speed_mps{};
  double frame_period_s = 0.05;
  std::vector<double> errors{0.3, 0.1, 1.0};  // m, m/s, deg
  std::uint64_t seed = 0;
  int run = 0;
  std::set<std::string> given{};  // names of options that the command line has
};

// Returns an exit code; throws InputError for bad input.
int track(const TrackOptions& options, const CommonOptions& common);
CLI::App& add_track_command(CLI::App& program, TrackOptions& options, CommonOptions& common);

}  // namespace fanbeam::apps
