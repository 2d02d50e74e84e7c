#include "apps/track_command.h"

#include <fmt/format.h>

#include "apps/progress.h"
#include "apps/track_inputs.h"
#include "scenes/highway_reader.h"
#include "session/signal/tracks/own_tracks.h"
#include "session/signal/tracks/scenario_record.h"
#include "tracking/simulation/sampled_frame.h"
#include "tracking/tracker/track_geometry.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;

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
        "their range cells, above {:g} m/s, of a beat over half the triangle's sample rate, or at "
        "an azimuth that elements so far apart do not tell from another\n",
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

fs::path output_of(const TrackOptions& options, const std::string& name,
                   const std::vector<std::string>& parts) {
  const fs::path folder =
      options.output.empty() ? fs::path("out") / (name + "-tracks") : fs::path(options.output);
  check_output(options.file, folder, parts);
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

int track_own_data(const TrackOptions& options, session::TrackInput input,
                   const CommonOptions& common) {
  if (!options.output.empty())
    check_output(options.file, options.output, {""});  // before all is read
  const auto source = own_source(options, input);
  const fs::path folder = output_of(options, source->name, {""});
  const session::OwnTracks tracks = tracks_of(*source, options, common.quiet);
  write_own_tracks(tracks, *source, options, body_errors(options), options.plots, folder);
  if (common.quiet) return kExitDone;
  print_problems(source->warnings);
  print(*source, tracks);
  print_record(folder / "run.json");
  return kExitDone;
}

int study(const TrackOptions& options, const scenes::HighwayFile& file,
          const std::vector<session::StudyScenario>& scenarios, const fs::path& folder,
          bool quiet) {
  session::track_study(scenarios, radar_under(options, file.radar), options, folder,
                       [&](const char* part) {
                         if (!quiet) fmt::print("{}\n", part);
                       });
  if (!quiet) print_record(folder / "study.md");
  return kExitDone;
}

// From frequencies, fewer are done in seconds: a bar would only flicker.
constexpr int kManyFrames = 50'000;

session::ScenarioTracks track_one(const TrackOptions& options, const session::StudyScenario& one,
                                  bool quiet) {
  const int frames = tracking::frames_of(*one.scenario, one.radar);
  Progress progress(one.scenario->id, frames, quiet || !(options.samples || frames > kManyFrames));
  return session::track_scenario(*one.scenario, one.radar, options,
                                 [&](int done) { progress.step(done); });
}

}  // namespace

int track(const TrackOptions& options, const CommonOptions& common) {
  const session::TrackInput input = session::track_input(options.file);
  refuse_other_options(options, input);
  if (input != session::TrackInput::scenarios) return track_own_data(options, input, common);
  const scenes::HighwayFile file = scenes::read_highway_file(options.file);
  const auto scenarios = session::chosen_scenarios(file, options.scenario, options);
  std::vector<std::string> parts;
  if (!options.study)
    for (const session::StudyScenario& one : scenarios) parts.push_back(one.scenario->id);
  const fs::path folder = output_of(options, fs::path(options.file).stem().string(), parts);
  if (options.study) return study(options, file, scenarios, folder, common.quiet);
  core::ProblemList problems;
  for (const session::StudyScenario& one : scenarios)
    session::check_waveform(*one.scenario, options, problems);
  problems.throw_if_errors();
  session::ScenarioRecord record(options);
  session::TrackPlots plots(folder);
  for (const session::StudyScenario& one : scenarios) {
    const session::ScenarioTracks tracks = track_one(options, one, common.quiet);
    write_scenario_tracks(*one.scenario, tracks, options.plots, folder, plots);
    if (!common.quiet) print(*one.scenario, tracks);
    record.add(one, tracks);
  }
  record.write(folder, plots);
  if (!common.quiet) print_record(folder / "run.json");
  return kExitDone;
}

}  // namespace fanbeam::apps
