#include "apps/track/own_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/progress.h"
#include "apps/track/own_plots.h"
#include "apps/track/track_table.h"
#include "core/constants.h"
#include "core/files.h"
#include "session/version.h"
#include "tracking/simulation/scenario_run.h"
#include "tracking/tracker/track_geometry.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

tracking::TrackerSettings tracker_of(const TrackOptions& options, const OwnSource& source) {
  core::HighwayRadar radar;
  radar.frame_s = source.frame_s;
  radar.most_range_m = source.most_range_m;
  radar.most_azimuth_rad = core::kPi;
  tracking::TrackerSettings settings = tracking::road_tracker(
      radar, source.radar_speed_mps, options.acceleration_mps2, options.coast_s);
  if (options.association == "joint") settings.association = tracking::Association::joint;
  if (source.resolution) settings.resolution = *source.resolution;
  return settings;
}

// A target counts as followed where a confirmed track is this near.
constexpr double kNear_m = 4.0, kNear_mps = 2.0;

// Moving: in most of the frames.
struct Seen {
  int frames = 0, moving = 0;
};

// Of every scatterer of a name, in every frame.
struct Followed {
  int seen = 0, followed = 0;
};

struct Outcome {
  std::string tracks = std::string(kTrackColumns) + ",existence," + kCovarianceColumns + "\n";
  std::string measurements = kMeasurementColumns;
  std::map<std::string, Followed> targets;
  std::map<int, Seen> confirmed;  // ever
  std::size_t detections = 0, measured = 0;
  int frames = 0;
  double measuring_s = 0.0, tracking_s = 0.0;
  OwnHistory history;
};

bool follows(const tracking::Track& track, const OwnTarget& target) {
  if (!track.confirmed) return false;
  const tracking::PolarPlace place = polar(track.state);
  const double across_m =
      2.0 * std::sin(0.5 * (place.azimuth_rad - target.azimuth_rad)) * target.range_m;
  return std::hypot(place.range_m - target.range_m, across_m) < kNear_m &&
         std::abs(place.range_rate_mps - target.range_rate_mps) < kNear_mps;
}

void add(const OwnFrame& frame, const tracking::Tracker& tracker, double radar_speed_mps,
         Outcome& outcome) {
  for (const tracking::RadarMeasurement& one : frame.measurements)
    outcome.measurements += measurement_row(frame.time_s, one);
  for (const tracking::Track& track : tracker.tracks()) {
    outcome.tracks +=
        fmt::format("{},{:.6g}{}\n", track_cells(frame.time_s, track, radar_speed_mps),
                    track.existence.probability(), covariance_cells(combined(track.state)));
    if (!track.confirmed) continue;
    Seen& seen = outcome.confirmed[track.id];
    ++seen.frames;
    seen.moving += is_moving(track, {radar_speed_mps, 0.0}) ? 1 : 0;
  }
  for (const OwnTarget& target : frame.targets) {
    Followed& one = outcome.targets[target.name];
    ++one.seen;
    one.followed += std::any_of(tracker.tracks().begin(), tracker.tracks().end(),
                                [&](const auto& track) { return follows(track, target); })
                        ? 1
                        : 0;
  }
  outcome.detections += frame.detections;
  outcome.measured += frame.measurements.size();
  ++outcome.frames;
  outcome.history.add(frame, tracker, radar_speed_mps);
}

Outcome run(const TrackOptions& options, OwnSource& source, bool quiet) {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
  };
  Outcome outcome;
  Progress progress(source.name, source.frames(), quiet);
  tracking::Tracker tracker(tracker_of(options, source));
  for (int i = 0; i < source.frames(); ++i) {
    const auto start = Clock::now();
    const OwnFrame frame = source.frame(i);
    const auto measured = Clock::now();
    tracker.update(frame.time_s, frame.measurements);
    outcome.measuring_s += seconds(start, measured);
    outcome.tracking_s += seconds(measured, Clock::now());
    add(frame, tracker, source.radar_speed_mps, outcome);
    progress.step(i + 1);
  }
  return outcome;
}

std::size_t moving(const Outcome& outcome) {
  return static_cast<std::size_t>(std::count_if(
      outcome.confirmed.begin(), outcome.confirmed.end(),
      [](const auto& track) { return 2 * track.second.moving > track.second.frames; }));
}

Json json_of(const TrackOptions& options, const OwnSource& source, const Outcome& outcome) {
  Json targets = Json::array();
  for (const auto& [name, one] : outcome.targets)
    targets.push_back({{"name", name}, {"seen", one.seen}, {"followed", one.followed}});
  Json json = {{"version", session::version_text()},
               {"commit", session::commit_text()},
               {"input", source.name},
               {"kind", source.kind},
               {"seed", options.seed},
               {"radar_speed_mps", source.radar_speed_mps},
               {"frame_s", source.frame_s},
               {"association", options.association},
               {"acceleration_mps2", options.acceleration_mps2},
               {"coast_s", options.coast_s},
               {"errors",
                {{"range_m", options.errors[0]},
                 {"range_rate_mps", options.errors[1]},
                 {"azimuth_deg", options.errors[2]}}},
               {"frames", outcome.frames},
               {"detections", outcome.detections},
               {"measurements", outcome.measured},
               {"confirmed_tracks", outcome.confirmed.size()},
               {"moving_tracks", moving(outcome)}};
  if (source.resolution)
    json["resolution"] = {{"range_m", source.resolution->range_m},
                          {"range_rate_mps", source.resolution->range_rate_mps},
                          {"azimuth_rad", source.resolution->azimuth_rad}};
  json["targets"] = targets;
  return json;
}

void print(const OwnSource& source, const Outcome& outcome) {
  fmt::print("{}: {} frames of {}, {:.1f} detections and {:.1f} measurements a frame\n",
             source.name, outcome.frames, source.kind,
             static_cast<double>(outcome.detections) / outcome.frames,
             static_cast<double>(outcome.measured) / outcome.frames);
  fmt::print("{} tracks confirmed, {} of them of something that moves\n", outcome.confirmed.size(),
             moving(outcome));
  for (const auto& [name, one] : outcome.targets)
    fmt::print("     {:<32} followed {:>3} of {} times that it is seen\n", name, one.followed,
               one.seen);
}

}  // namespace

int track_own_data(const TrackOptions& options, const CommonOptions& common) {
  const std::unique_ptr<OwnSource> source = own_source(options);
  const fs::path folder = options.output.empty() ? fs::path("out") / (source->name + "-tracks")
                                                 : fs::path(options.output);
  check_output(folder);
  const Outcome outcome = run(options, *source, common.quiet);
  core::write_file_atomically(folder / "tracks.csv", outcome.tracks);
  core::write_file_atomically(folder / "measurements.csv", outcome.measurements);
  core::write_file_atomically(folder / "run.json",
                              json_of(options, *source, outcome).dump(2) + "\n");
  const Json timing = {{"measuring_ms_per_scan", 1e3 * outcome.measuring_s / outcome.frames},
                       {"tracking_ms_per_scan", 1e3 * outcome.tracking_s / outcome.frames}};
  core::write_file_atomically(folder / "timing.json", timing.dump(2) + "\n");
  if (options.plots && outcome.measured > 0) {
    session::write_plots(outcome.history.ranges(source->name), folder / "ranges");
    session::write_plots(outcome.history.plan(source->name), folder / "plan");
  }
  if (common.quiet) return kExitDone;
  print_problems(source->warnings);
  print(*source, outcome);
  fmt::print("record {}\n", fs::absolute(folder / "run.json").lexically_normal().string());
  return kExitDone;
}

}  // namespace fanbeam::apps
