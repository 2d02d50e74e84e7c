#include "apps/track_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "core/files.h"
#include "scenes/highway_reader.h"
#include "tracking/simulation/scenario_run.h"
#include "tracking/tracker/track_geometry.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;

tracking::SimulationSettings simulation_of(const TrackOptions& options) {
  tracking::SimulationSettings settings;
  settings.scheme = options.scheme == "triangle"     ? tracking::Scheme::triangle
                    : options.scheme == "two-slopes" ? tracking::Scheme::two_slopes
                                                     : tracking::Scheme::two_stage;
  settings.detection_probability = options.detection_probability;
  settings.false_per_frame = options.false_per_frame;
  return settings;
}

tracking::TrackerSettings tracker_of(const TrackOptions& options,
                                     const tracking::SimulationSettings& simulation,
                                     const core::HighwayRadar& radar, double radar_speed_mps) {
  tracking::TrackerSettings settings = tracking::road_tracker(radar, radar_speed_mps);
  if (options.association == "joint") settings.association = tracking::Association::joint;
  // Never certain, so that a miss does not cost infinitely much.
  settings.joint.detection_probability = std::clamp(options.detection_probability, 0.05, 0.98);
  const double space =
      radar.most_range_m * 2.0 * simulation.most_speed_mps * 2.0 * radar.most_azimuth_rad;
  settings.joint.clutter_density =
      std::max(settings.joint.clutter_density, options.false_per_frame / space);
  return settings;
}

// The id becomes a folder.
void check_id(const std::string& id) {
  const bool plain =
      !id.empty() && id.size() <= 64 && std::all_of(id.begin(), id.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '-' || c == '_';
      });
  if (!plain)
    core::throw_input_error(core::ErrorClass::path, "scenario id", "\"" + id + "\"",
                            "1 to 64 letters, digits, - and _");
}

struct Tables {
  std::string tracks =
      "time_s,track,confirmed,x_m,y_m,vx_mps,vy_mps,range_m,range_rate_mps,azimuth_rad,moving,"
      "identity_probability,target\n";
  std::string measurements = "time_s,range_m,range_rate_mps,azimuth_rad\n";
};

void add_rows(const core::HighwayScenario& scenario, const tracking::ScenarioFrame& frame,
              const tracking::ScenarioScore& score, Tables& tables) {
  for (const tracking::RadarMeasurement& one : frame.measurements)
    tables.measurements += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g}\n", frame.time_s, one.range_m,
                                       one.range_rate_mps, one.azimuth_rad);
  for (const tracking::Track& track : frame.tracker->tracks()) {
    const tracking::Gaussian state = combined(track.state);
    const tracking::PolarPlace place = polar(track.state);
    std::string target;
    for (const auto& [index, id] : score.mot.current_match())
      if (id == track.id) target = scenario.targets[static_cast<std::size_t>(index)].id;
    tables.tracks +=
        fmt::format("{:.9g},{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{},{:.6g},{}\n",
                    frame.time_s, track.id, track.confirmed ? 1 : 0, state.mean[0], state.mean[1],
                    state.mean[2], state.mean[3], place.range_m, place.range_rate_mps,
                    place.azimuth_rad, is_moving(track, {scenario.radar_speed_mps, 0.0}) ? 1 : 0,
                    track.identity_probability, target);
  }
}

nlohmann::ordered_json json_of(const core::HighwayScenario& scenario,
                               const tracking::ScenarioScore& score) {
  nlohmann::ordered_json json = {{"id", scenario.id},
                                 {"title", scenario.title},
                                 {"frames", score.gospa_m.count()},
                                 {"confirmed_tracks", score.tracks.size()},
                                 {"gospa_mean_m", score.gospa_m.mean()},
                                 {"ospa_mean_m", score.ospa_m.mean()},
                                 {"mota", score.mot.mota()}};
  if (const auto motp_m = score.mot.motp_m()) json["motp_m"] = *motp_m;
  json["missed"] = score.mot.missed();
  json["false_tracks"] = score.mot.false_tracks();
  json["switches"] = score.mot.switches();
  json["range_rmse_m"] = score.range_m.rms();
  json["range_error_largest_m"] = score.range_m.largest();
  json["range_rate_rmse_mps"] = score.range_rate_mps.rms();
  return json;
}

nlohmann::ordered_json run_one(const TrackOptions& options, const CommonOptions& common,
                               const core::HighwayScenario& scenario,
                               const core::HighwayRadar& radar, const fs::path& folder) {
  const tracking::SimulationSettings simulation = simulation_of(options);
  tracking::ScenarioScore score;
  Tables tables;
  run_scenario(scenario, radar, simulation,
               tracker_of(options, simulation, radar, scenario.radar_speed_mps), options.seed,
               static_cast<std::uint32_t>(options.run), [&](const tracking::ScenarioFrame& frame) {
                 score.add(scenario, frame);
                 add_rows(scenario, frame, score, tables);
               });
  core::write_file_atomically(folder / scenario.id / "tracks.csv", tables.tracks);
  core::write_file_atomically(folder / scenario.id / "measurements.csv", tables.measurements);
  if (!common.quiet)
    fmt::print(
        "{:<4} {:>2} tracks of {} targets, GOSPA {:.3f} m, MOTA {:.4f}, {} switches, "
        "range {:.4g} m rms, speed {:.4g} m/s rms\n",
        scenario.id, score.tracks.size(), scenario.targets.size(), score.gospa_m.mean(),
        score.mot.mota(), score.mot.switches(), score.range_m.rms(), score.range_rate_mps.rms());
  return json_of(scenario, score);
}

}  // namespace

int track(const TrackOptions& options, const CommonOptions& common) {
  const scenes::HighwayFile file = scenes::read_highway_file(options.file);
  std::vector<const core::HighwayScenario*> chosen;
  std::string known;
  for (const core::HighwayScenario& scenario : file.scenarios) {
    known += (known.empty() ? "" : ", ") + scenario.id;
    if (options.scenario.empty() || options.scenario == scenario.id) chosen.push_back(&scenario);
  }
  if (chosen.empty())
    core::throw_input_error(core::ErrorClass::ref, "--scenario", "\"" + options.scenario + "\"",
                            known.empty() ? "a file with scenarios" : "one of: " + known);
  for (const core::HighwayScenario* scenario : chosen) check_id(scenario->id);
  const fs::path folder =
      options.output.empty()
          ? fs::path("out") / (fs::path(options.file).stem().string() + "-tracks")
          : fs::path(options.output);
  nlohmann::ordered_json json = {{"version", version_text()},
                                 {"commit", commit_text()},
                                 {"seed", options.seed},
                                 {"run", options.run},
                                 {"waveform", options.scheme},
                                 {"association", options.association},
                                 {"detection_probability", options.detection_probability},
                                 {"false_measurements", options.false_per_frame},
                                 {"scenarios", nlohmann::ordered_json::array()}};
  for (const core::HighwayScenario* scenario : chosen)
    json["scenarios"].push_back(run_one(options, common, *scenario, file.radar, folder));
  core::write_file_atomically(folder / "run.json", json.dump(2) + "\n");
  if (!common.quiet)
    fmt::print("record {}\n", fs::absolute(folder / "run.json").lexically_normal().string());
  return kExitDone;
}

}  // namespace fanbeam::apps
