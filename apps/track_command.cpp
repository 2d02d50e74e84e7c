#include "apps/track_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/progress.h"
#include "apps/track/own_data.h"
#include "apps/track/plots.h"
#include "apps/track/study.h"
#include "apps/track/track_table.h"
#include "core/decibel.h"
#include "core/files.h"
#include "core/text.h"
#include "scenes/highway_reader.h"
#include "session/version.h"
#include "tracking/simulation/sampled_frame.h"
#include "tracking/simulation/scenario_run.h"
#include "tracking/tracker/track_geometry.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;

// The option, or two stages, or what the scenario names first where it does not name those.
std::string scheme_of(const TrackOptions& options, const core::HighwayScenario& scenario) {
  if (!options.scheme.empty()) return options.scheme;
  const auto& types = scenario.waveform_types;
  if (types.empty() || std::find(types.begin(), types.end(), "two-stage") != types.end())
    return "two-stage";
  return types[0] == "triangle-pair" ? "two-slopes" : types[0] == "triangle" ? "triangle" : "coded";
}

tracking::SimulationSettings simulation_of(const TrackOptions& options,
                                           const core::HighwayScenario& scenario) {
  tracking::SimulationSettings settings;
  const std::string scheme = scheme_of(options, scenario);
  settings.scheme = scheme == "triangle"          ? tracking::Scheme::triangle
                    : scheme == "sorted-triangle" ? tracking::Scheme::sorted_triangle
                    : scheme == "two-slopes"      ? tracking::Scheme::two_slopes
                    : scheme == "coded"           ? tracking::Scheme::coded
                                                  : tracking::Scheme::two_stage;
  settings.detection_probability = options.detection_probability;
  settings.false_per_frame = options.false_per_frame;
  return settings;
}

tracking::TrackerSettings tracker_of(const TrackOptions& options,
                                     const tracking::SimulationSettings& simulation,
                                     const core::HighwayRadar& radar, double radar_speed_mps) {
  tracking::TrackerSettings settings =
      tracking::road_tracker(radar, radar_speed_mps, options.acceleration_mps2, options.coast_s);
  if (options.association == "joint") settings.association = tracking::Association::joint;
  // Never certain, so that a miss does not cost infinitely much.
  settings.detection.detection_probability = std::clamp(options.detection_probability, 0.05, 0.98);
  const double angles = settings.motion.axes() == 1 ? 1.0 : 2.0 * radar.most_azimuth_rad;
  const double space = radar.most_range_m * 2.0 * simulation.most_speed_mps * angles;
  settings.detection.clutter_density =
      std::max(settings.detection.clutter_density, options.false_per_frame / space);
  return settings;
}

// The id becomes a folder.
void check_id(const std::string& id) {
  if (!core::is_safe_word(id))
    core::throw_input_error(
        core::ErrorClass::path, "scenario id", "\"" + id + "\"",
        "1 to 64 letters, digits, '.', '-' and '_', the first a letter or digit");
}

struct Outcome {
  tracking::ScenarioScore score;
  TrackHistory history;
  std::string tracks =
      std::string(kTrackColumns) + ",target,existence,nees," + kCovarianceColumns + "\n";
  std::string measurements = kMeasurementColumns;
  // Of the last frame.
  tracking::ScenarioFrame last;
  std::vector<tracking::Track> tracks_at_end;
  std::vector<tracking::Crossing> crossings;
  int skipped_updates = 0;
  int beyond = 0;  // instances of targets in view that the samples cannot show
  double measuring_s = 0.0, tracking_s = 0.0;
};

// The target that a track follows; -1 for none.
int target_of(const tracking::ScenarioScore& score, int track) {
  for (const auto& [index, id] : score.mot.current_match())
    if (id == track) return index;
  return -1;
}

void add_rows(const core::HighwayScenario& scenario, const tracking::ScenarioFrame& frame,
              Outcome& outcome) {
  for (const tracking::RadarMeasurement& one : frame.measurements)
    outcome.measurements += measurement_row(frame.time_s, one);
  for (const tracking::Track& track : frame.tracker->tracks()) {
    const int target = target_of(outcome.score, track.id);
    outcome.tracks += fmt::format(
        "{},{},{:.6g},{}{}\n", track_cells(frame.time_s, track, scenario.radar_speed_mps),
        target < 0 ? std::string() : scenario.targets[static_cast<std::size_t>(target)].id,
        track.existence.probability(),
        target < 0
            ? std::string()
            : fmt::format("{:.6g}", nees_of(track, frame.motion[static_cast<std::size_t>(target)])),
        covariance_cells(combined(track.state)));
  }
}

int beyond(const tracking::SampledRadar& radar, const tracking::ScenarioFrame& frame) {
  return static_cast<int>(
      std::count_if(frame.truth.begin(), frame.truth.end(), [&](const core::HighwayTruth& one) {
        return one.in_view && (one.range_m > radar.most_range_m() ||
                               std::abs(one.range_rate_mps) > radar.most_speed_mps());
      }));
}

// From frequencies, fewer are done in seconds: a bar would only flicker.
constexpr int kManyFrames = 50'000;

Outcome run_one(const TrackOptions& options, const core::HighwayScenario& scenario,
                const core::HighwayRadar& radar, bool quiet) {
  Outcome outcome;
  const int frames = tracking::frames_of(scenario, radar);
  Progress progress(scenario.id, frames, quiet || !(options.samples || frames > kManyFrames));
  const tracking::SimulationSettings simulation = simulation_of(options, scenario);
  const auto run = static_cast<std::uint32_t>(options.run);
  std::optional<tracking::SampledRadar> sampled;
  if (options.samples) sampled.emplace(radar);
  tracking::run_scenario(
      scenario, radar, tracker_of(options, simulation, radar, scenario.radar_speed_mps),
      [&](int frame) {
        return sampled ? sampled->measure(scenario, options.seed, run, frame)
                       : simulated_frame(scenario, radar, simulation, options.seed, run, frame);
      },
      [&](const tracking::ScenarioFrame& frame) {
        outcome.score.add(scenario, frame);
        if (sampled) outcome.beyond += beyond(*sampled, frame);
        outcome.history.add(scenario, frame, outcome.score);
        add_rows(scenario, frame, outcome);
        outcome.measuring_s += frame.measuring_s;
        outcome.tracking_s += frame.tracking_s;
        outcome.tracks_at_end = frame.tracker->tracks();
        outcome.crossings = frame.tracker->crossings();
        outcome.skipped_updates = frame.tracker->skipped_updates();
        outcome.last = frame;
        outcome.last.tracker = nullptr;
        progress.step(outcome.score.gospa_m.count());
      });
  return outcome;
}

// Where each confirmed track ended, where its target is, and how sure its name is.
nlohmann::ordered_json json_of_tracks(const core::HighwayScenario& scenario,
                                      const Outcome& outcome) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const tracking::Track& track : outcome.tracks_at_end) {
    if (!track.confirmed) continue;
    const tracking::PolarPlace place = polar(track.state);
    nlohmann::ordered_json one = {{"track", track.id},
                                  {"range_m", place.range_m},
                                  {"range_rate_mps", place.range_rate_mps},
                                  {"existence_probability", track.existence.probability()},
                                  {"identity_probability", track.identity_probability}};
    if (const int target = target_of(outcome.score, track.id); target >= 0) {
      const auto i = static_cast<std::size_t>(target);
      one["target"] = scenario.targets[i].id;
      one["kind"] = scenario.targets[i].kind;
      one["target_range_m"] = outcome.last.truth[i].range_m;
      one["target_range_rate_mps"] = outcome.last.truth[i].range_rate_mps;
    }
    json.push_back(one);
  }
  return json;
}

nlohmann::ordered_json json_of(const core::HighwayScenario& scenario, const Outcome& outcome) {
  const tracking::ScenarioScore& score = outcome.score;
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
  json["nees_mean"] = score.nees.mean();
  json["skipped_updates"] = outcome.skipped_updates;
  json["beyond_samples"] = outcome.beyond;
  json["crossings"] = nlohmann::ordered_json::array();
  for (const tracking::Crossing& one : outcome.crossings)
    json["crossings"].push_back({{"time_s", one.time_s},
                                 {"tracks", {one.first, one.second}},
                                 {"swap_probability", one.swap_probability}});
  json["tracks_at_end"] = json_of_tracks(scenario, outcome);
  return json;
}

void print(const core::HighwayScenario& scenario, const Outcome& outcome) {
  const tracking::ScenarioScore& score = outcome.score;
  fmt::print(
      "{:<4} {:>2} tracks of {} targets, GOSPA {:.3f} m, MOTA {:.4f}, {} switches, "
      "range {:.4g} m rms, speed {:.4g} m/s rms\n",
      scenario.id, score.tracks.size(), scenario.targets.size(), score.gospa_m.mean(),
      score.mot.mota(), score.mot.switches(), score.range_m.rms(), score.range_rate_mps.rms());
  if (outcome.beyond > 0)
    fmt::print(
        "     W-FOLDED: {} times a target in view is beyond what these samples show: farther than "
        "their range cells, or above {:g} m/s\n",
        outcome.beyond, tracking::SampledRadar::most_speed_mps());
  for (const tracking::Crossing& one : outcome.crossings)
    fmt::print("     tracks {} and {} parted at {:.2f} s, exchanged with probability {:.2g}\n",
               one.first, one.second, one.time_s, one.swap_probability);
  for (const tracking::Track& track : outcome.tracks_at_end) {
    if (!track.confirmed) continue;
    const int target = target_of(score, track.id);
    const std::string truth =
        target < 0 ? std::string("no target there")
                   : fmt::format("{} at {:.3f} m, its identity right with probability {:.6g}",
                                 scenario.targets[static_cast<std::size_t>(target)].id,
                                 outcome.last.truth[static_cast<std::size_t>(target)].range_m,
                                 track.identity_probability);
    fmt::print("     track {} ends at {:.3f} m, exists with probability {:.6g}: {}\n", track.id,
               polar(track.state).range_m, track.existence.probability(), truth);
  }
}

void write(const TrackOptions& options, const core::HighwayScenario& scenario,
           const Outcome& outcome, const fs::path& folder) {
  core::write_file_atomically(folder / "tracks.csv", outcome.tracks);
  core::write_file_atomically(folder / "measurements.csv", outcome.measurements);
  if (!options.plots) return;
  session::write_plots(outcome.history.ranges(scenario), folder / "ranges");
  session::write_plots(outcome.history.errors(scenario), folder / "errors");
}

// The file's radar, as the options change it.
core::HighwayRadar radar_of(const TrackOptions& options, core::HighwayRadar radar) {
  if (options.range_only) radar.array_elements = 1;
  if (options.noise_figure_dB) radar.noise_figure = core::power_from_dB(*options.noise_figure_dB);
  return radar;
}

}  // namespace

int track(const TrackOptions& options, const CommonOptions& common) {
  if (!is_road_scenario(options.file)) return track_own_data(options, common);
  refuse_other_options(options, TrackInput::scenarios);
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
  check_output(folder);
  const core::HighwayRadar radar = radar_of(options, file.radar);
  if (options.study) {
    std::vector<StudyScenario> studied;
    for (const core::HighwayScenario* scenario : chosen)
      studied.push_back({scenario, radar_of(options, scenario->radar)});
    return track_study(studied, radar, options.seed, folder, common);
  }
  nlohmann::ordered_json json = {{"version", session::version_text()},
                                 {"commit", session::commit_text()},
                                 {"seed", options.seed},
                                 {"run", options.run},
                                 {"association", options.association},
                                 {"from_samples", options.samples},
                                 {"acceleration_mps2", options.acceleration_mps2},
                                 {"coast_s", options.coast_s},
                                 {"detection_probability", options.detection_probability},
                                 {"false_measurements", options.false_per_frame},
                                 {"scenarios", nlohmann::ordered_json::array()}};
  nlohmann::ordered_json timing = nlohmann::ordered_json::array();
  for (const core::HighwayScenario* scenario : chosen) {
    const core::HighwayRadar own = radar_of(options, scenario->radar);
    const Outcome outcome = run_one(options, *scenario, own, common.quiet);
    write(options, *scenario, outcome, folder / scenario->id);
    if (!common.quiet) print(*scenario, outcome);
    json["scenarios"].push_back(json_of(*scenario, outcome));
    json["scenarios"].back()["waveform"] =
        options.samples ? "two-stage" : scheme_of(options, *scenario);
    json["scenarios"].back()["noise_figure"] = own.noise_figure;
    json["scenarios"].back()["range_only"] = own.array_elements < 2;
    const double frames = outcome.score.gospa_m.count();
    timing.push_back({{"id", scenario->id},
                      {"measuring_ms_per_scan", 1e3 * outcome.measuring_s / frames},
                      {"tracking_ms_per_scan", 1e3 * outcome.tracking_s / frames}});
  }
  core::write_file_atomically(folder / "run.json", json.dump(2) + "\n");
  core::write_file_atomically(folder / "timing.json", timing.dump(2) + "\n");
  if (!common.quiet)
    fmt::print("record {}\n", fs::absolute(folder / "run.json").lexically_normal().string());
  return kExitDone;
}

}  // namespace fanbeam::apps
