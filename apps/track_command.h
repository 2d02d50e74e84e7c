// fanbeam track: road scenarios to measurements, tracks, errors and metrics.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/common.h"
#include "session/signal/tracks/track_settings.h"

namespace fanbeam::apps {

struct TrackOptions : session::TrackSettings {
  std::string file;
  std::string scenario;  // its id; empty: all of the file
  std::string output;    // default out/<file's name>-tracks
  bool plots = false;
  bool study = false;
  // Of what is no road scenario (apps/track_inputs.h).
  std::string radar_file, frames, sensor, data;
  std::optional<double> radar_speed_mps{}, frame_period_s{};
  std::vector<double> errors{0.3, 0.1, 1.0};  // m, m/s, deg
  std::set<std::string> given{};              // names of options that the command line has
};

}  // namespace fanbeam::apps
