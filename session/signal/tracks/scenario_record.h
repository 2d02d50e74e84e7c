// Which scenarios of a file are tracked, and what a run over them says of itself.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/highway_reader.h"
#include "session/signal/tracks/scenario_tracks.h"
#include "session/signal/tracks/study.h"

namespace fanbeam::session {

// The scenario of that id, all of the file where it is empty, each with its radar under the settings. `file` must
// outlive them. Throws InputError: E-REF of --scenario for an id that the file does not have, E-PATH for all that are
// no name of a folder (core::is_safe_word) or that of a record beside it.
std::vector<StudyScenario> chosen_scenarios(const scenes::HighwayFile& file, const std::string& id,
                                            const TrackSettings& settings);

class ScenarioRecord {
 public:
  explicit ScenarioRecord(const TrackSettings& settings) : settings_(settings) {}
  void add(const StudyScenario& tracked, const ScenarioTracks& tracks);
  // run.json and timing.json.
  void write(const std::filesystem::path& folder, const TrackPlots& plots) const;

 private:
  struct Timing {
    std::string id;
    double measuring_ms_per_scan, tracking_ms_per_scan;
  };
  TrackSettings settings_;
  std::vector<std::string> scenarios_;  // JSON
  std::vector<Timing> timing_;
};

}  // namespace fanbeam::session
