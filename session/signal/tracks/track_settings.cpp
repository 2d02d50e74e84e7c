#include "session/signal/tracks/track_settings.h"

#include <algorithm>

#include "core/decibel.h"

namespace fanbeam::session {

core::HighwayRadar radar_under(const TrackSettings& settings, core::HighwayRadar radar) {
  if (settings.range_only) radar.array_elements = 1;
  if (settings.noise_figure_dB) radar.noise_figure = core::power_from_dB(*settings.noise_figure_dB);
  return radar;
}

bool fits(tracking::Scheme scheme, const core::HighwayRadar& radar) {
  return length_of(scheme, radar.waveforms) <= radar.frame_s;
}

tracking::SimulationSettings simulation_settings(const TrackSettings& settings,
                                                 tracking::Scheme scheme) {
  tracking::SimulationSettings simulation;
  simulation.scheme = scheme;
  simulation.detection_probability = settings.detection_probability;
  simulation.false_per_frame = settings.false_per_frame;
  return simulation;
}

tracking::TrackerSettings tracker_settings(const TrackSettings& settings,
                                           const tracking::SimulationSettings& simulation,
                                           const core::HighwayRadar& radar,
                                           double radar_speed_mps) {
  tracking::TrackerSettings tracker =
      tracking::road_tracker(radar, radar_speed_mps, settings.acceleration_mps2, settings.coast_s);
  if (settings.association == "joint") tracker.association = tracking::Association::joint;
  tracker.resolution =
      tracking::road_resolution(radar, ramp_of(simulation.scheme, radar.waveforms));
  // Never certain, so that a miss does not cost infinitely much.
  tracker.detection.detection_probability = std::clamp(settings.detection_probability, 0.05, 0.98);
  const double angles = tracker.motion.axes() == 1 ? 1.0 : 2.0 * radar.most_azimuth_rad;
  const double space = radar.most_range_m * 2.0 * simulation.most_speed_mps * angles;
  tracker.detection.clutter_density =
      std::max(tracker.detection.clutter_density, settings.false_per_frame / space);
  return tracker;
}

}  // namespace fanbeam::session
