// The four scenarios of the highway file as plain data (y to the right), and runs of the tracker.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/highway.h"
#include "tracking/simulation/road_families.h"
#include "tracking/simulation/scenario_run.h"
#include "tracking/tracker/track_geometry.h"

namespace fanbeam::tests {

inline core::HighwayRadar highway_radar() {
  core::HighwayRadar radar;
  radar.transmit_gain = 1584.893192461114;  // 32 dB
  radar.receive_gain = 501.1872336272722;   // 27 dB
  radar.noise_figure = 2.818382931264454;   // 4.5 dB
  return radar;
}

inline core::HighwayTarget car(const char* id, double x_m, double y_m, double vx_mps,
                               double section_m2 = 10.0, double vy_mps = 0.0) {
  core::HighwayTarget target = tracking::road_car(id, x_m, y_m, vx_mps);
  target.cross_section_m2 = section_m2;
  target.velocity_mps[1] = vy_mps;
  return target;
}

using tracking::kRoadSpeed_mps;
inline core::HighwayScenario scene(double duration_s, double radar_speed_mps,
                                   std::vector<core::HighwayTarget> targets) {
  return tracking::road_scene(duration_s, radar_speed_mps, std::move(targets));
}

inline core::HighwayScenario one_stopped_car() {
  return scene(3.0, kRoadSpeed_mps, {car("A", 150.0, 0.0, 0.0)});
}
// A is not measured from 0.475 s to 0.975 s, in frames 10 to 19; B always is.
inline core::HighwayScenario one_hidden_for_half_a_second() {
  core::HighwayTarget hidden = car("A", 60.0, 0.0, kRoadSpeed_mps + 2.0);
  hidden.suppressed = {{0.475, 0.975}};
  return scene(3.0, kRoadSpeed_mps, {hidden, car("B", 100.0, 0.0, kRoadSpeed_mps - 3.0)});
}
// How often the target of that number is measured in the frame, to a metre and a metre per second.
inline std::ptrdiff_t times_measured(const core::HighwayScenario& scenario, std::size_t target,
                                     int frame,
                                     const std::vector<tracking::RadarMeasurement>& seen) {
  const core::HighwayTruth truth = core::truth_at(
      scenario.targets[target], scenario.radar_speed_mps, highway_radar(), frame * 0.05);
  return std::count_if(seen.begin(), seen.end(), [&](const auto& one) {
    return std::abs(one.range_m - truth.range_m) <= 1.0 &&
           std::abs(one.range_rate_mps - truth.range_rate_mps) <= 1.0;
  });
}
inline core::HighwayScenario six_vehicles() {
  return scene(
      6.0, kRoadSpeed_mps,
      {car("A", 35.0, 0.0, 26.0), car("B", 62.0, 3.7, 22.5, 100.0), car("C", 58.0, -3.7, 33.0, 1.5),
       car("D", 95.0, 0.0, 29.5), car("E", 190.0, -11.1, -30.0), car("F", 128.0, -3.7, 36.0, 8.0)});
}
inline core::HighwayScenario slow_crossing() {
  return scene(12.0, kRoadSpeed_mps,
               {car("A", 65.0, 0.0, 98.5 / 3.6), car("B", 60.0, -3.7, 101.5 / 3.6)});
}
inline core::HighwayScenario beaming() {
  core::HighwayTarget ring;
  ring.id = "A";
  ring.cross_section_m2 = 10.0;
  ring.motion = core::HighwayMotion::circular;
  ring.radius_m = 50.0;
  ring.azimuth_rad = 0.69;
  ring.angular_rate_rad_per_s = -0.3;
  return scene(4.6, 0.0,
               {ring, car("B", 80.0, 57.5, 0.0, 10.0, -25.0),
                car("C", 49.279238345478035, -8.459117453349801, 0.0, 5.0)});
}

inline tracking::TrackerSettings settings_for(double radar_speed_mps = kRoadSpeed_mps) {
  return tracking::road_tracker(highway_radar(), radar_speed_mps);
}

inline const tracking::Track* track_of(const tracking::Tracker& tracker, int id) {
  for (const tracking::Track& one : tracker.tracks())
    if (one.id == id) return &one;
  return nullptr;
}

using Frame = tracking::ScenarioFrame;

inline void track_scene(const core::HighwayScenario& scenario,
                        const tracking::SimulationSettings& simulation,
                        const tracking::TrackerSettings& settings, int run,
                        const std::function<void(const Frame&)>& each) {
  run_scenario(scenario, highway_radar(), simulation, settings, 20251121,
               static_cast<std::uint32_t>(run), each);
}

}  // namespace fanbeam::tests
