#include "session/signal/tracks/scenario_tracks.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/errors.h"
#include "core/files.h"
#include "session/signal/tracks/track_table.h"
#include "tracking/simulation/sampled_frame.h"
#include "tracking/tracker/track_geometry.h"

namespace fanbeam::session {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// The option, or two stages, or what the scenario names first where it does not name those.
std::string scheme_of(const TrackSettings& settings, const core::HighwayScenario& scenario) {
  if (settings.samples) return "two-stage";
  if (!settings.scheme.empty()) return settings.scheme;
  const auto& types = scenario.waveform_types;
  if (types.empty() || std::find(types.begin(), types.end(), "two-stage") != types.end())
    return "two-stage";
  return types[0] == "triangle-pair" ? "two-slopes" : types[0] == "triangle" ? "triangle" : "coded";
}

tracking::Scheme scheme_named(const std::string& name) {
  if (name == "triangle") return tracking::Scheme::triangle;
  if (name == "sorted-triangle") return tracking::Scheme::sorted_triangle;
  if (name == "two-slopes") return tracking::Scheme::two_slopes;
  return name == "coded" ? tracking::Scheme::coded : tracking::Scheme::two_stage;
}

void add_rows(const core::HighwayScenario& scenario, const tracking::ScenarioFrame& frame,
              ScenarioTracks& tracks) {
  for (const tracking::RadarMeasurement& one : frame.measurements)
    tracks.measurements += measurement_row(frame.time_s, one);
  for (const tracking::Track& track : frame.tracker->tracks()) {
    const int target = target_of(tracks.score, track.id);
    tracks.tracks += fmt::format(
        "{},{},{:.6g},{}{}\n", track_cells(frame.time_s, track, {scenario.radar_speed_mps, 0.0}),
        target < 0 ? std::string() : scenario.targets[static_cast<std::size_t>(target)].id,
        track.existence.probability(),
        target < 0
            ? std::string()
            : fmt::format("{:.6g}", nees_of(track, frame.motion[static_cast<std::size_t>(target)])),
        covariance_cells(combined(track.state)));
  }
}

int beyond(const tracking::SampledRadar& radar, const tracking::ScenarioFrame& frame) {
  return static_cast<int>(std::count_if(
      frame.truth.begin(), frame.truth.end(),
      [&](const core::HighwayTruth& one) { return one.in_view && !radar.shows(one); }));
}

// Where each confirmed track ended, where its target is, and how sure its name is.
Json json_of_tracks(const core::HighwayScenario& scenario, const ScenarioTracks& tracks) {
  Json json = Json::array();
  for (const tracking::Track& track : tracks.tracks_at_end) {
    if (!track.confirmed) continue;
    const tracking::PolarPlace place = polar(track.state);
    Json one = {{"track", track.id},
                {"range_m", place.range_m},
                {"range_rate_mps", place.range_rate_mps},
                {"existence_probability", track.existence.probability()},
                {"identity_probability", track.identity_probability}};
    if (const int target = target_of(tracks.score, track.id); target >= 0) {
      const auto i = static_cast<std::size_t>(target);
      one["target"] = scenario.targets[i].id;
      one["kind"] = scenario.targets[i].kind;
      one["target_range_m"] = tracks.last.truth[i].range_m;
      one["target_range_rate_mps"] = tracks.last.truth[i].range_rate_mps;
    }
    json.push_back(one);
  }
  return json;
}

// Of nothing there is no mean.
Json figure_or_null(int count, double value) { return count > 0 ? Json(value) : Json(); }

}  // namespace

// The reader knows which waveforms a file has, not which one is used.
void check_waveform(const core::HighwayScenario& scenario, const TrackSettings& settings,
                    core::ProblemList& problems) {
  const core::HighwayRadar& radar = scenario.radar;
  const std::string name = scheme_of(settings, scenario);
  if (!fits(scheme_named(name), radar))
    problems.error(
        core::ErrorClass::range, {}, "scenario " + scenario.id + " waveform " + name,
        core::number_text(length_of(scheme_named(name), radar.waveforms)) + " s of ramps",
        "no more than the frame period of " + core::number_text(radar.frame_s) + " s");
}

int target_of(const tracking::ScenarioScore& score, int track) {
  for (const auto& [index, id] : score.mot.current_match())
    if (id == track) return index;
  return -1;
}

ScenarioTracks track_scenario(const core::HighwayScenario& scenario,
                              const core::HighwayRadar& radar, const TrackSettings& settings,
                              const std::function<void(int done)>& progress) {
  ScenarioTracks tracks;
  tracks.tracks =
      std::string(kTrackColumns) + ",target,existence,nees," + kCovarianceColumns + "\n";
  tracks.measurements = kMeasurementColumns;
  tracks.scheme = scheme_of(settings, scenario);
  const tracking::SimulationSettings simulation =
      simulation_settings(settings, scheme_named(tracks.scheme));
  const auto run = static_cast<std::uint32_t>(settings.run);
  std::optional<tracking::SampledRadar> sampled;
  if (settings.samples) sampled.emplace(radar);
  tracking::run_scenario(
      scenario, radar, tracker_settings(settings, simulation, radar, scenario.radar_speed_mps),
      [&](int frame) {
        return sampled ? sampled->measure(scenario, settings.seed, run, frame)
                       : simulated_frame(scenario, radar, simulation, settings.seed, run, frame);
      },
      [&](const tracking::ScenarioFrame& frame) {
        tracks.score.add(scenario, frame);
        if (sampled) tracks.beyond += beyond(*sampled, frame);
        tracks.history.add(scenario, frame, tracks.score);
        add_rows(scenario, frame, tracks);
        tracks.measuring_s += frame.measuring_s;
        tracks.tracking_s += frame.tracking_s;
        tracks.tracks_at_end = frame.tracker->tracks();
        tracks.crossings = frame.tracker->crossings();
        tracks.skipped_updates = frame.tracker->skipped_updates();
        tracks.left_out = frame.tracker->left_out();
        tracks.last = frame;
        tracks.last.tracker = nullptr;
        progress(static_cast<int>(tracks.score.gospa_m.count()));
      });
  return tracks;
}

std::string scenario_tracks_json(const core::HighwayScenario& scenario,
                                 const core::HighwayRadar& radar, const ScenarioTracks& tracks) {
  const tracking::ScenarioScore& score = tracks.score;
  Json json = {{"id", scenario.id},
               {"title", scenario.title},
               {"frames", score.gospa_m.count()},
               {"confirmed_tracks", score.tracks.size()},
               {"gospa_mean_m", score.gospa_m.mean()},
               {"ospa_mean_m", score.ospa_m.mean()},
               {"mota", figure_or_null(score.mot.instances(), score.mot.mota())}};
  const auto motp_m = score.mot.motp_m();
  json["motp_m"] = motp_m ? Json(*motp_m) : Json();
  json["missed"] = score.mot.missed();
  json["false_tracks"] = score.mot.false_tracks();
  json["switches"] = score.mot.switches();
  const tracking::MeanSquare &range_m = score.range_m, &speed_mps = score.range_rate_mps;
  json["range_rmse_m"] = figure_or_null(range_m.count(), range_m.rms());
  json["range_error_largest_m"] = figure_or_null(range_m.count(), range_m.largest());
  json["range_rate_rmse_mps"] = figure_or_null(speed_mps.count(), speed_mps.rms());
  json["nees_mean"] = figure_or_null(score.nees.count(), score.nees.mean());
  json["skipped_updates"] = tracks.skipped_updates;
  json["left_out_of_joint"] = tracks.left_out;
  json["beyond_samples"] = tracks.beyond;
  json["crossings"] = Json::array();
  for (const tracking::Crossing& one : tracks.crossings)
    json["crossings"].push_back({{"time_s", one.time_s},
                                 {"tracks", {one.first, one.second}},
                                 {"swap_probability", one.swap_probability},
                                 {"given_up", one.given_up}});
  json["tracks_at_end"] = json_of_tracks(scenario, tracks);
  json["waveform"] = tracks.scheme;
  json["noise_figure"] = radar.noise_figure;
  json["range_only"] = radar.array_elements < 2;
  return json.dump();
}

void write_scenario_tracks(const core::HighwayScenario& scenario, const ScenarioTracks& tracks,
                           bool draw, const fs::path& folder, TrackPlots& plots) {
  const std::string ranges = scenario.id + "/ranges", errors = scenario.id + "/errors";
  for (const std::string& name : {ranges, errors}) plots.remove_earlier(name);
  core::write_file_atomically(folder / scenario.id / "tracks.csv", tracks.tracks);
  core::write_file_atomically(folder / scenario.id / "measurements.csv", tracks.measurements);
  if (!draw) return;
  plots.draw(tracks.history.ranges(scenario), ranges);
  plots.draw(tracks.history.errors(scenario), errors);
}

}  // namespace fanbeam::session
