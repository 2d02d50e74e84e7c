#include "apps/track_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/progress.h"
#include "apps/track_inputs.h"
#include "core/decibel.h"
#include "core/files.h"
#include "core/text.h"
#include "scenes/highway_reader.h"
#include "session/signal/tracks/own_tracks.h"
#include "session/signal/tracks/scenario_tracks.h"
#include "session/signal/tracks/study.h"
#include "session/version.h"
#include "tracking/simulation/sampled_frame.h"
#include "tracking/tracker/track_geometry.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// The id becomes a folder.
void check_id(const std::string& id) {
  if (!core::is_safe_word(id))
    core::throw_input_error(
        core::ErrorClass::path, "scenario id", "\"" + id + "\"",
        "1 to 64 letters, digits, '.', '-' and '_', the first a letter or digit");
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
        "their range cells, above {:g} m/s, or of a beat over half the triangle's sample rate\n",
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

// The file's radar, as the options change it.
core::HighwayRadar radar_of(const TrackOptions& options, core::HighwayRadar radar) {
  if (options.range_only) radar.array_elements = 1;
  if (options.noise_figure_dB) radar.noise_figure = core::power_from_dB(*options.noise_figure_dB);
  return radar;
}

fs::path output_of(const TrackOptions& options, const std::string& name) {
  const fs::path folder =
      options.output.empty() ? fs::path("out") / (name + "-tracks") : fs::path(options.output);
  check_output(folder);
  return folder;
}

void print_record(const fs::path& file) {
  fmt::print("record {}\n", fs::absolute(file).lexically_normal().string());
}

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

int track_own_data(const TrackOptions& options, const CommonOptions& common) {
  const auto source = own_source(options);
  const fs::path folder = output_of(options, source->name);
  const session::OwnTracks tracks = tracks_of(*source, options, common.quiet);
  write_own_tracks(tracks, *source, options, body_errors(options), options.plots, folder);
  if (common.quiet) return kExitDone;
  print_problems(source->warnings);
  print(*source, tracks);
  print_record(folder / "run.json");
  return kExitDone;
}

// Those of the file that are asked for.
std::vector<const core::HighwayScenario*> chosen(const TrackOptions& options,
                                                 const scenes::HighwayFile& file) {
  std::vector<const core::HighwayScenario*> scenarios;
  std::string known;
  for (const core::HighwayScenario& scenario : file.scenarios) {
    known += (known.empty() ? "" : ", ") + scenario.id;
    if (options.scenario.empty() || options.scenario == scenario.id) scenarios.push_back(&scenario);
  }
  if (scenarios.empty())
    core::throw_input_error(core::ErrorClass::ref, "--scenario", "\"" + options.scenario + "\"",
                            "one of: " + known);
  for (const core::HighwayScenario* scenario : scenarios) check_id(scenario->id);
  return scenarios;
}

int study(const TrackOptions& options, const core::HighwayRadar& radar,
          const std::vector<const core::HighwayScenario*>& scenarios, const fs::path& folder,
          bool quiet) {
  std::vector<session::StudyScenario> studied;
  for (const core::HighwayScenario* scenario : scenarios)
    studied.push_back({scenario, radar_of(options, scenario->radar)});
  session::track_study(studied, radar, options, folder, [&](const char* part) {
    if (!quiet) fmt::print("{}\n", part);
  });
  if (!quiet) print_record(folder / "study.md");
  return kExitDone;
}

Json record_of(const TrackOptions& options) {
  return {{"version", session::version_text()},
          {"commit", session::commit_text()},
          {"seed", options.seed},
          {"run", options.run},
          {"association", options.association},
          {"from_samples", options.samples},
          {"acceleration_mps2", options.acceleration_mps2},
          {"coast_s", options.coast_s},
          {"detection_probability", options.detection_probability},
          {"false_measurements", options.false_per_frame},
          {"scenarios", Json::array()}};
}

// From frequencies, fewer are done in seconds: a bar would only flicker.
constexpr int kManyFrames = 50'000;

session::ScenarioTracks track_one(const TrackOptions& options,
                                  const core::HighwayScenario& scenario,
                                  const core::HighwayRadar& radar, bool quiet) {
  const int frames = tracking::frames_of(scenario, radar);
  Progress progress(scenario.id, frames, quiet || !(options.samples || frames > kManyFrames));
  return session::track_scenario(scenario, radar, options, [&](int done) { progress.step(done); });
}

}  // namespace

int track(const TrackOptions& options, const CommonOptions& common) {
  if (!is_road_scenario(options.file)) return track_own_data(options, common);
  refuse_other_options(options, TrackInput::scenarios);
  const scenes::HighwayFile file = scenes::read_highway_file(options.file);
  const auto scenarios = chosen(options, file);
  const fs::path folder = output_of(options, fs::path(options.file).stem().string());
  if (options.study)
    return study(options, radar_of(options, file.radar), scenarios, folder, common.quiet);
  core::ProblemList problems;
  for (const core::HighwayScenario* scenario : scenarios)
    session::check_waveform(*scenario, options, problems);
  problems.throw_if_errors();
  Json json = record_of(options), timing = Json::array();
  for (const core::HighwayScenario* scenario : scenarios) {
    const core::HighwayRadar radar = radar_of(options, scenario->radar);
    const session::ScenarioTracks tracks = track_one(options, *scenario, radar, common.quiet);
    write_scenario_tracks(*scenario, tracks, options.plots, folder / scenario->id);
    if (!common.quiet) print(*scenario, tracks);
    json["scenarios"].push_back(Json::parse(scenario_tracks_json(*scenario, radar, tracks)));
    const double frames = tracks.score.gospa_m.count();
    timing.push_back({{"id", scenario->id},
                      {"measuring_ms_per_scan", 1e3 * tracks.measuring_s / frames},
                      {"tracking_ms_per_scan", 1e3 * tracks.tracking_s / frames}});
  }
  core::write_file_atomically(folder / "run.json", json.dump(2) + "\n");
  core::write_file_atomically(folder / "timing.json", timing.dump(2) + "\n");
  if (!common.quiet) print_record(folder / "run.json");
  return kExitDone;
}

}  // namespace fanbeam::apps
