// A tracker on a road scenario, frame after frame, with the truth beside it, and its score.
//
// Score over all frames: mean GOSPA and OSPA (p 2, c 5 m, alpha 2), CLEAR-MOT within 3 m, errors of
// range and range rate of matched tracks. Without azimuth, places are ranges. Targets that are marked as clutter need not be tracked:
// they are no targets, and a track within 3 m of one that matches no target is left out of all of it.
#pragma once

#include <functional>
#include <set>

#include "tracking/metrics/clear_mot.h"
#include "tracking/metrics/error_statistics.h"
#include "tracking/simulation/measurement_simulator.h"
#include "tracking/tracker/tracker.h"

namespace fanbeam::tracking {

inline constexpr double kMatch_m = 3.0;

// Straight on with an unknown acceleration of standard deviation `acceleration_mps2` in each step, a smooth
// turn with 0.06 m/s2 along its way, steered at 3.4 deg/s (standard deviations) for a second beside a bend that
// lasts, or a manoeuvre: an acceleration of any size that changes by 45 m/s2 in a second along the road, 4.5
// across it; each left after 45 s on average. Speeds
// are measured to millimetres per second, so that a target that brakes leaves the smooth models at once,
// and comes back to it when it drives on; the larger `acceleration_mps2`, the less is known of who is who
// after a crossing. Tracks coast for `coast_s` without a measurement. A radar of one element tells no
// azimuth: then range alone is tracked, at constant speed with the same acceleration, which loses what
// passes close by. Field of view of the radar.
// Resolution of the two-stage waveform.
inline constexpr double kSteady_mps2 = 0.5;
inline constexpr double kCoast_s = 1.0;
TrackerSettings road_tracker(const core::HighwayRadar& radar, double radar_speed_mps,
                             double acceleration_mps2 = kSteady_mps2, double coast_s = kCoast_s);

// Two targets are within it nearer than 2.2 c / 2B in range, as far as merged beats are biased, 1.2 bins of
// a ramp in speed, and the array's beam in azimuth. `ramp_s`: of the triangle whose beats are told
// (ramp_of).
Resolution road_resolution(const core::HighwayRadar& radar, double ramp_s);

struct ScenarioFrame {
  double time_s = 0.0;
  std::vector<core::HighwayTruth> truth;  // of every target
  std::vector<core::RelativeMotion> motion;
  std::vector<RadarMeasurement> measurements;
  const Tracker* tracker = nullptr;
  int axes = 2;  // that are tracked
  // How long it took, on this machine.
  double measuring_s = 0.0, tracking_s = 0.0;

  // In view, named by their place in the scenario.
  std::vector<NamedPlace> targets(const core::HighwayScenario& scenario) const;
  std::vector<NamedPlace> confirmed() const;
  // Of these tracks the ids of those within 3 m of clutter.
  std::set<int> at_clutter(const core::HighwayScenario& scenario,
                           const std::vector<NamedPlace>& tracks) const;
};

// Of a track that follows this target; infinite where its covariance is none.
double nees_of(const Track& track, const core::RelativeMotion& motion);

struct ScenarioScore {
  ClearMot mot{kMatch_m};
  MeanSquare gospa_m, ospa_m;
  MeanSquare range_m, range_rate_mps;
  MeanSquare
      nees;  // of position and velocity of matched tracks: 4 on average where they are honest, 2 on one axis
  std::set<int> tracks;  // ever confirmed, and not left out as clutter's

  void add(const core::HighwayScenario& scenario, const ScenarioFrame& frame);
};

// From time 0 to the duration. Throws InputError E-LIMIT for more than a million.
int frames_of(const core::HighwayScenario& scenario, const core::HighwayRadar& radar);

using MeasureFrame = std::function<std::vector<RadarMeasurement>(int frame)>;

// Calls `each` after every frame. Errors as of frames_of, `measure` and Tracker.
void run_scenario(const core::HighwayScenario& scenario, const core::HighwayRadar& radar,
                  const TrackerSettings& settings, const MeasureFrame& measure,
                  const std::function<void(const ScenarioFrame&)>& each);

// With measurements of simulated_frame.
void run_scenario(const core::HighwayScenario& scenario, const core::HighwayRadar& radar,
                  const SimulationSettings& simulation, const TrackerSettings& settings,
                  std::uint64_t seed, std::uint32_t run,
                  const std::function<void(const ScenarioFrame&)>& each);

}  // namespace fanbeam::tracking
