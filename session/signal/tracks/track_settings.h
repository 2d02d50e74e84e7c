// How measurements become tracks, in the words of `fanbeam track`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/highway.h"
#include "tracking/simulation/measurement_simulator.h"
#include "tracking/simulation/scenario_run.h"

namespace fanbeam::session {

struct TrackSettings {
  std::string association = "nearest";  // or "joint"
  double acceleration_mps2 = tracking::kSteady_mps2;
  double coast_s = tracking::kCoast_s;
  std::uint64_t seed = 0;
  // Of road scenarios alone.
  std::string scheme;  // as --waveform; empty: two-stage, unless the scenario names others alone
  double detection_probability = 1.0;
  double false_per_frame = 0.0;
  bool samples = false;                     // measured from beat samples
  int run = 0;                              // another draw of the same seed
  std::optional<double> noise_figure_dB{};  // instead of the file's
  bool range_only = false;                  // one receiver without azimuth
  int family_draws = 100;                   // of a study
};

// Of road scenarios: the radar of the file as the settings change it.
core::HighwayRadar radar_under(const TrackSettings& settings, core::HighwayRadar radar);

// Whether all ramps of the waveform end within a frame.
bool fits(tracking::Scheme scheme, const core::HighwayRadar& radar);

// Of road scenarios: how a radar measures them by one waveform, and the tracker that goes with it.
tracking::SimulationSettings simulation_settings(const TrackSettings& settings,
                                                 tracking::Scheme scheme);
tracking::TrackerSettings tracker_settings(const TrackSettings& settings,
                                           const tracking::SimulationSettings& simulation,
                                           const core::HighwayRadar& radar, double radar_speed_mps);

}  // namespace fanbeam::session
