#include "session/signal/tracks/own_tracks.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/constants.h"
#include "core/files.h"
#include "core/units.h"
#include "session/signal/tracks/track_plots.h"
#include "session/signal/tracks/track_table.h"
#include "session/version.h"
#include "tracking/tracker/track_geometry.h"

namespace fanbeam::session {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

tracking::TrackerSettings own_tracker(const TrackSettings& settings, const MeasuredSource& source) {
  core::HighwayRadar radar;
  radar.frame_s = source.frame_s;
  radar.most_range_m = source.most_range_m;
  radar.most_azimuth_rad = core::kPi;
  if (!source.tells_azimuth) radar.array_elements = 1;
  tracking::TrackerSettings tracker = tracking::road_tracker(
      radar, source.radar_velocity_mps[0], settings.acceleration_mps2, settings.coast_s);
  for (tracking::MotionModel& model : tracker.motion.motions)
    model.radar_velocity_mps = source.radar_velocity_mps;
  if (settings.association == "joint") tracker.association = tracking::Association::joint;
  if (source.resolution) tracker.resolution = *source.resolution;
  return tracker;
}

// A target counts as followed where a confirmed track is this near.
constexpr double kNear_m = 4.0, kNear_mps = 2.0;

bool follows(const tracking::Track& track, const SeenTarget& target) {
  if (!track.confirmed) return false;
  const tracking::PolarPlace place = polar(track.state);
  const double turn_rad = track.state.axes == 1 ? 0.0 : place.azimuth_rad - target.azimuth_rad;
  const double across_m = 2.0 * std::sin(0.5 * turn_rad) * target.range_m;
  return std::hypot(place.range_m - target.range_m, across_m) < kNear_m &&
         std::abs(place.range_rate_mps - target.range_rate_mps) < kNear_mps;
}

void add(const MeasuredFrame& frame, const tracking::Tracker& tracker, OwnTracks& tracks) {
  for (const tracking::RadarMeasurement& one : frame.measurements)
    tracks.measurements += measurement_row(frame.time_s, one);
  for (const tracking::Track& track : tracker.tracks()) {
    tracks.tracks +=
        fmt::format("{},{:.6g}{}\n", track_cells(frame.time_s, track, frame.radar_velocity_mps),
                    track.existence.probability(), covariance_cells(combined(track.state)));
    if (!track.confirmed) continue;
    OwnTracks::Seen& seen = tracks.confirmed[track.id];
    ++seen.frames;
    seen.moving += is_moving(track, frame.radar_velocity_mps) ? 1 : 0;
  }
  for (const SeenTarget& target : frame.targets) {
    OwnTracks::Followed& one = tracks.targets[target.name];
    ++one.seen;
    one.followed += std::any_of(tracker.tracks().begin(), tracker.tracks().end(),
                                [&](const auto& track) { return follows(track, target); })
                        ? 1
                        : 0;
  }
  tracks.detections += frame.detections;
  tracks.measured += frame.measurements.size();
  ++tracks.frames;
  tracks.history.add(frame, tracker);
}

Json json_of(const TrackSettings& settings, const MeasuredSource& source, const BodyErrors& errors,
             const OwnTracks& tracks, const TrackPlots& plots) {
  Json targets = Json::array();
  for (const auto& [name, one] : tracks.targets)
    targets.push_back({{"name", name}, {"seen", one.seen}, {"followed", one.followed}});
  const RadarVelocity_mps& velocity_mps = source.radar_velocity_mps;
  Json json = {{"version", version_text()},
               {"commit", commit_text()},
               {"input", source.name},
               {"kind", source.kind},
               {"seed", settings.seed},
               {"radar_speed_mps",
                std::copysign(std::hypot(velocity_mps[0], velocity_mps[1]), velocity_mps[0])},
               {"radar_velocity_mps", velocity_mps},
               {"frame_s", source.frame_s},
               {"range_only", !source.tells_azimuth},
               {"association", settings.association},
               {"acceleration_mps2", settings.acceleration_mps2},
               {"coast_s", settings.coast_s},
               {"errors",
                {{"range_m", errors.range_m},
                 {"range_rate_mps", errors.range_rate_mps},
                 {"azimuth_deg", std::round(1e9 * core::degrees(errors.azimuth_rad)) / 1e9}}},
               {"frames", tracks.frames},
               {"detections", tracks.detections},
               {"measurements", tracks.measured},
               {"confirmed_tracks", tracks.confirmed.size()},
               {"moving_tracks", tracks.moving()},
               {"left_out_of_joint", tracks.left_out}};
  // Two targets nearer than this may be one measurement.
  const tracking::Resolution resolution = own_tracker(settings, source).resolution;
  json["resolution"] = {{"of", source.resolution ? "the radar" : "no radar: assumed"},
                        {"range_m", resolution.range_m},
                        {"range_rate_mps", resolution.range_rate_mps},
                        {"azimuth_rad", resolution.azimuth_rad}};
  json["targets"] = targets;
  json["plots"] = plots.files();
  return json;
}

}  // namespace

int OwnTracks::moving() const {
  return static_cast<int>(std::count_if(confirmed.begin(), confirmed.end(), [](const auto& track) {
    return 2 * track.second.moving > track.second.frames;
  }));
}

OwnTracks track_source(MeasuredSource& source, const TrackSettings& settings,
                       const std::function<void(int done)>& progress) {
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
  };
  OwnTracks tracks;
  tracks.tracks = std::string(kTrackColumns) + ",existence," + kCovarianceColumns + "\n";
  tracks.measurements = kMeasurementColumns;
  tracking::Tracker tracker(own_tracker(settings, source));
  for (int i = 0; i < source.frames(); ++i) {
    const auto start = Clock::now();
    const MeasuredFrame frame = source.frame(i);
    const auto measured = Clock::now();
    tracker.update(frame.time_s, frame.measurements);
    tracks.measuring_s += seconds(start, measured);
    tracks.tracking_s += seconds(measured, Clock::now());
    add(frame, tracker, tracks);
    progress(i + 1);
  }
  tracks.left_out = tracker.left_out();
  return tracks;
}

void write_own_tracks(const OwnTracks& tracks, const MeasuredSource& source,
                      const TrackSettings& settings, const BodyErrors& errors, bool draw,
                      const fs::path& folder) {
  TrackPlots plots(folder);
  for (const char* name : {"ranges", "plan"}) plots.remove_earlier(name);
  const auto write_record = [&] {
    core::write_file_atomically(folder / "run.json",
                                json_of(settings, source, errors, tracks, plots).dump(2) + "\n");
  };
  core::write_file_atomically(folder / "tracks.csv", tracks.tracks);
  core::write_file_atomically(folder / "measurements.csv", tracks.measurements);
  write_record();
  const Json timing = {{"measuring_ms_per_scan", 1e3 * tracks.measuring_s / tracks.frames},
                       {"tracking_ms_per_scan", 1e3 * tracks.tracking_s / tracks.frames}};
  core::write_file_atomically(folder / "timing.json", timing.dump(2) + "\n");
  if (!draw || tracks.measured == 0) return;
  plots.draw(tracks.history.ranges(source.name), "ranges");
  if (source.tells_azimuth) plots.draw(tracks.history.plan(source.name), "plan");
  write_record();  // lists no plot before it is there
}

}  // namespace fanbeam::session
