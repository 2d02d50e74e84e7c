#include "tracking/simulation/scenario_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/constants.h"
#include "core/errors.h"
#include "tracking/tracker/track_geometry.h"

namespace fanbeam::tracking {
namespace {

constexpr double kMostFrames = 1e6;

// Chosen by families of 100 random runs (tests/tracking/families_test.cpp, seed 77) and by what one triangle tells of who
// is who in S3. A manoeuvre is rare and of almost any size: at 300 m2/s5 and 10 s cars that brake have a normalised error
// squared of 4.7 and cars that change lanes 4.8 instead of 4.3 and 4.4; at 10000 and 100 s 0.77 is told instead of 0.88.
constexpr double kManoeuvreJerk_m2_per_s5 = 2000.0, kLateralJerkShare = 0.01;
constexpr double kSojourn_s = 45.0;
// Steering of 0.11 rad/s: 0.71 is told of S3. Along the way 0.2 m/s2: 0.48, as cars that are one may have changed their
// speeds; 0.03 m/s2: cars that change lanes have 4.8.
constexpr double kSteeringSigma_rad_per_s = 0.06, kSteeringTime_s = 0.32;
constexpr double kBendDensity_rad2_per_s3 = 1e-5;
constexpr double kAlongSigma_mps2 = 0.06, kAlongTime_s = 0.2, kUnknownAcceleration_mps2 = 0.25;
// While the tangential speed is not known, its curve of the range looks like an acceleration.
constexpr double kManoeuvreAtStart = 0.01;

// On the road, or along the line of sight where that is all that is tracked.
Place place_of(const core::RelativeMotion& motion, int axes) {
  const auto [x_m, y_m] = motion.position_m;
  return axes == 1 ? Place{std::hypot(x_m, y_m), 0.0} : Place{x_m, y_m};
}

std::vector<Place> places(const std::vector<NamedPlace>& named) {
  std::vector<Place> result;
  for (const NamedPlace& one : named) result.push_back(one.place);
  return result;
}

}  // namespace

Resolution road_resolution(const core::HighwayRadar& radar, double ramp_s) {
  constexpr double kBiasedCells = 2.2, kMergedBins = 1.2, kHalfPowerWidth = 0.8859;
  const double wavelength_m = core::kSpeedOfLight_mps / radar.centre_frequency_Hz;
  Resolution resolution;
  resolution.range_m = kBiasedCells * core::kSpeedOfLight_mps / (2.0 * radar.bandwidth_Hz);
  resolution.range_rate_mps = kMergedBins * wavelength_m / (2.0 * ramp_s);
  if (radar.array_elements > 1)
    resolution.azimuth_rad =
        std::min(1.0, kHalfPowerWidth / (radar.array_elements * radar.array_pitch_wavelengths));
  return resolution;
}

TrackerSettings road_tracker(const core::HighwayRadar& radar, double radar_speed_mps,
                             double acceleration_mps2, double coast_s) {
  TrackerSettings settings;
  settings.most_range_m = radar.most_range_m;
  settings.most_azimuth_rad = radar.most_azimuth_rad;
  settings.resolution = road_resolution(radar, radar.waveforms.fine_ramp_s);
  settings.most_coasted =
      static_cast<int>(std::min(std::ceil(coast_s / radar.frame_s - 1e-9), 1e9));
  settings.longest_gap_s = (settings.most_coasted + 1.5) * radar.frame_s;
  settings.believed_s = std::max(coast_s, radar.frame_s);
  if (radar.array_elements < 2) {
    MotionModel along;
    along.axes = 1;
    along.acceleration_mps2 = acceleration_mps2;
    settings.motion.motions = {along};
    settings.detection.clutter_density *= 2.0 * radar.most_azimuth_rad;
    return settings;
  }
  MotionModel straight, turn;
  straight.acceleration_mps2 = acceleration_mps2;
  turn.kind = MotionKind::smooth_turn;
  turn.steering_sigma_rad_per_s = kSteeringSigma_rad_per_s;
  turn.steering_time_s = kSteeringTime_s;
  turn.acceleration_mps2 = kUnknownAcceleration_mps2;
  turn.along_sigma_mps2 = kAlongSigma_mps2;
  turn.along_time_s = kAlongTime_s;
  turn.bend_density_rad2_per_s3 = kBendDensity_rad2_per_s3;
  turn.radar_velocity_mps = {radar_speed_mps, 0.0};
  MotionModel manoeuvre;
  manoeuvre.kind = MotionKind::constant_acceleration;
  manoeuvre.jerk_density_m2_per_s5 = kManoeuvreJerk_m2_per_s5;
  manoeuvre.lateral_jerk_share = kLateralJerkShare;
  settings.motion = {{straight, turn, manoeuvre}, kSojourn_s, {0.5, 0.5, kManoeuvreAtStart}};
  return settings;
}

std::vector<NamedPlace> ScenarioFrame::targets(const core::HighwayScenario& scenario) const {
  std::vector<NamedPlace> result;
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (truth[i].in_view && !scenario.targets[i].clutter)
      result.push_back({static_cast<int>(i), place_of(motion[i], axes)});
  return result;
}

std::vector<NamedPlace> ScenarioFrame::confirmed() const {
  std::vector<NamedPlace> result;
  for (const Track& track : tracker->tracks()) {
    if (!track.confirmed) continue;
    const Gaussian state = combined(track.state);
    result.push_back({track.id, {state.mean[0], axes == 1 ? 0.0 : state.mean[1]}});
  }
  return result;
}

std::set<int> ScenarioFrame::at_clutter(const core::HighwayScenario& scenario,
                                        const std::vector<NamedPlace>& tracks) const {
  std::set<int> ids;
  for (const NamedPlace& one : tracks)
    for (std::size_t i = 0; i < motion.size(); ++i)
      if (scenario.targets[i].clutter &&
          distance_m(one.place, place_of(motion[i], axes)) <= kMatch_m)
        ids.insert(one.id);
  return ids;
}

double nees_of(const Track& track, const core::RelativeMotion& motion) {
  const auto [x_m, y_m] = motion.position_m;
  const auto [vx_mps, vy_mps] = motion.velocity_mps;
  if (track.state.axes == 2)
    return normalised_error_squared(combined(track.state), {x_m, y_m, vx_mps, vy_mps});
  const double range_m = std::hypot(x_m, y_m);
  return normalised_error_squared(combined(track.state),
                                  {range_m, (x_m * vx_mps + y_m * vy_mps) / range_m});
}

void ScenarioScore::add(const core::HighwayScenario& scenario, const ScenarioFrame& frame) {
  const std::vector<NamedPlace> targets = frame.targets(scenario);
  std::vector<NamedPlace> confirmed = frame.confirmed();
  std::set<int> left_out = frame.at_clutter(scenario, confirmed);
  mot.add_frame(targets, confirmed, left_out);
  // A car may stop beside a post: what follows it is its track.
  for (const auto& [target, id] : mot.current_match()) left_out.erase(id);
  std::erase_if(confirmed, [&](const NamedPlace& one) { return left_out.contains(one.id); });
  gospa_m.add(gospa(places(targets), places(confirmed), {}).total_m);
  ospa_m.add(tracking::ospa_m(places(targets), places(confirmed), {}));
  for (const NamedPlace& one : confirmed) tracks.insert(one.id);
  for (const auto& [target, id] : mot.current_match())
    for (const Track& track : frame.tracker->tracks()) {
      if (track.id != id) continue;
      const PolarPlace place = polar(track.state);
      const core::HighwayTruth& truth = frame.truth[static_cast<std::size_t>(target)];
      range_m.add(place.range_m - truth.range_m);
      range_rate_mps.add(place.range_rate_mps - truth.range_rate_mps);
      nees.add(nees_of(track, frame.motion[static_cast<std::size_t>(target)]));
    }
}

int frames_of(const core::HighwayScenario& scenario, const core::HighwayRadar& radar) {
  // The last frame counts where the duration is a whole number of frames but for rounding.
  const double steps = std::floor(scenario.duration_s / radar.frame_s + 1e-9);
  if (!(steps >= 0.0 && steps <= kMostFrames))
    core::throw_input_error(core::ErrorClass::limit, "duration_s", scenario.duration_s,
                            "at most a million frames");
  return static_cast<int>(steps) + 1;
}

void run_scenario(const core::HighwayScenario& scenario, const core::HighwayRadar& radar,
                  const TrackerSettings& settings, const MeasureFrame& measure,
                  const std::function<void(const ScenarioFrame&)>& each) {
  const int frames = frames_of(scenario, radar);
  Tracker tracker(settings);
  for (int i = 0; i < frames; ++i) {
    ScenarioFrame frame;
    frame.time_s = i * radar.frame_s;
    const auto start = std::chrono::steady_clock::now();
    frame.measurements = measure(i);
    const auto measured = std::chrono::steady_clock::now();
    tracker.update(frame.time_s, frame.measurements);
    const auto tracked = std::chrono::steady_clock::now();
    frame.measuring_s = std::chrono::duration<double>(measured - start).count();
    frame.tracking_s = std::chrono::duration<double>(tracked - measured).count();
    for (const core::HighwayTarget& target : scenario.targets) {
      frame.truth.push_back(truth_at(target, scenario.radar_speed_mps, radar, frame.time_s));
      frame.motion.push_back(relative_motion(target, scenario.radar_speed_mps, frame.time_s));
    }
    frame.tracker = &tracker;
    frame.axes = settings.motion.axes();
    each(frame);
  }
}

void run_scenario(const core::HighwayScenario& scenario, const core::HighwayRadar& radar,
                  const SimulationSettings& simulation, const TrackerSettings& settings,
                  std::uint64_t seed, std::uint32_t run,
                  const std::function<void(const ScenarioFrame&)>& each) {
  run_scenario(
      scenario, radar, settings,
      [&](int frame) { return simulated_frame(scenario, radar, simulation, seed, run, frame); },
      each);
}

}  // namespace fanbeam::tracking
