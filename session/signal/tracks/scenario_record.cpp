#include "session/signal/tracks/scenario_record.h"

#include <nlohmann/json.hpp>

#include "core/files.h"
#include "core/text.h"
#include "session/version.h"

namespace fanbeam::session {
namespace {

// The id becomes a folder beside the run's records.
void check_scenario_id(const std::string& id, const std::string& file,
                       core::ProblemList& problems) {
  if (!core::is_safe_word(id))
    problems.error(core::ErrorClass::path, {file}, "scenario id", "\"" + id + "\"",
                   "1 to 64 letters, digits, '.', '-' and '_', the first a letter or digit");
  else if (id == "run.json" || id == "timing.json")
    problems.error(core::ErrorClass::path, {file}, "scenario id", "\"" + id + "\"",
                   "another id: it is a folder's name, and that of a record in the same place");
}

}  // namespace

std::vector<StudyScenario> chosen_scenarios(const scenes::HighwayFile& file, const std::string& id,
                                            const TrackSettings& settings) {
  std::vector<StudyScenario> chosen;
  std::string known;
  for (const core::HighwayScenario& scenario : file.scenarios) {
    known += (known.empty() ? "" : ", ") + scenario.id;
    if (id.empty() || id == scenario.id)
      chosen.push_back({&scenario, radar_under(settings, scenario.radar)});
  }
  if (chosen.empty())
    core::throw_input_error(core::ErrorClass::ref, "--scenario", "\"" + id + "\"",
                            "one of: " + known);
  core::ProblemList problems;
  for (const StudyScenario& one : chosen) check_scenario_id(one.scenario->id, file.name, problems);
  problems.throw_if_errors();
  return chosen;
}

void ScenarioRecord::add(const StudyScenario& tracked, const ScenarioTracks& tracks) {
  const double frames = tracks.score.gospa_m.count();
  scenarios_.push_back(scenario_tracks_json(*tracked.scenario, tracked.radar, tracks));
  timing_.push_back(
      {tracked.scenario->id, 1e3 * tracks.measuring_s / frames, 1e3 * tracks.tracking_s / frames});
}

void ScenarioRecord::write(const std::filesystem::path& folder, const TrackPlots& plots) const {
  using Json = nlohmann::ordered_json;
  Json json = {{"version", version_text()},
               {"commit", commit_text()},
               {"seed", settings_.seed},
               {"run", settings_.run},
               {"association", settings_.association},
               {"from_samples", settings_.samples},
               {"acceleration_mps2", settings_.acceleration_mps2},
               {"coast_s", settings_.coast_s},
               {"detection_probability", settings_.detection_probability},
               {"false_measurements", settings_.false_per_frame},
               {"scenarios", Json::array()}};
  for (const std::string& scenario : scenarios_) json["scenarios"].push_back(Json::parse(scenario));
  json["plots"] = plots.files();
  Json timing = Json::array();
  for (const Timing& one : timing_)
    timing.push_back({{"id", one.id},
                      {"measuring_ms_per_scan", one.measuring_ms_per_scan},
                      {"tracking_ms_per_scan", one.tracking_ms_per_scan}});
  core::write_file_atomically(folder / "run.json", json.dump(2) + "\n");
  core::write_file_atomically(folder / "timing.json", timing.dump(2) + "\n");
}

}  // namespace fanbeam::session
