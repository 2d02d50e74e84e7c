// A road scenario's tracks, their score, and their files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/highway.h"
#include "session/signal/tracks/scenario_history.h"
#include "session/signal/tracks/track_plots.h"
#include "session/signal/tracks/track_settings.h"
#include "tracking/simulation/scenario_run.h"

namespace fanbeam::session {

struct ScenarioTracks {
  tracking::ScenarioScore score;
  ScenarioHistory history;
  std::string tracks, measurements;  // CSV
  std::string scheme;                // "two-stage", as --waveform
  // Of the last frame.
  tracking::ScenarioFrame last;
  std::vector<tracking::Track> tracks_at_end;
  std::vector<tracking::Crossing> crossings;
  int skipped_updates = 0;
  std::int64_t left_out = 0;  // by joint association
  int beyond = 0;             // instances of targets in view that the samples cannot show
  double measuring_s = 0.0, tracking_s = 0.0;
};

// The target that a track follows; -1 for none.
int target_of(const tracking::ScenarioScore& score, int track);

// E-RANGE where the waveform that the settings mean takes longer than a frame.
void check_waveform(const core::HighwayScenario& scenario, const TrackSettings& settings,
                    core::ProblemList& problems);

// `progress` is told after each frame how many are done.
ScenarioTracks track_scenario(const core::HighwayScenario& scenario,
                              const core::HighwayRadar& radar, const TrackSettings& settings,
                              const std::function<void(int done)>& progress);

// What run.json says of a scenario: metrics, crossings, where each track ended.
std::string scenario_tracks_json(const core::HighwayScenario& scenario,
                                 const core::HighwayRadar& radar, const ScenarioTracks& tracks);
// In the folder of its id: tracks.csv, measurements.csv and, to `draw`, ranges and errors as SVG and PNG. Those that
// `plots` knows of an earlier run go.
void write_scenario_tracks(const core::HighwayScenario& scenario, const ScenarioTracks& tracks,
                           bool draw, const std::filesystem::path& folder, TrackPlots& plots);

}  // namespace fanbeam::session
