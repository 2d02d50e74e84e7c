// Road scenarios as plain data: a radar that drives straight on, targets with simple laws of
// motion, and what the radar should see of them.
//
// Frame: x forward along the road, y to the right, origin at the radar at time 0; the radar moves
// along +x at `radar_speed_mps`. Velocities are over ground. Azimuth is positive to the right.
// Laws, t counted from 0:
//   piecewise    velocity v0, plus the accelerations of segments, each constant between its two
//                times; lane changes add lateral/2 (1 - cos(pi (t - t0)/(t1 - t0))) between their
//                times and the whole of it afterwards
//   circular     about the radar's place at time 0: (r cos a, r sin a), a = a0 + w t
// Range, range rate and azimuth are those of the exact geometry: R = |p|, (p . v)/R, atan2(py, px)
// with p and v relative to the radar. Accuracy: rounding.
// Neglected: turns and height of the road.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/swerling.h"

namespace fanbeam::core {

enum class HighwayMotion { piecewise, circular };

struct AccelerationSegment {
  double start_s = 0.0, end_s = 0.0;
  std::array<double, 2> acceleration_mps2{};
};

struct LaneChange {
  double start_s = 0.0, end_s = 0.0;
  double lateral_m = 0.0;  // to the right
};

// From its beginning until before its end.
struct TimeSpan {
  double from_s = 0.0, to_s = 0.0;
};

struct HighwayTarget {
  std::string id, kind;
  double cross_section_m2 = 1.0;
  Swerling fluctuation = Swerling::steady;
  bool clutter = false;  // really there, but need not be tracked
  HighwayMotion motion = HighwayMotion::piecewise;
  std::array<double, 2> position_m{};
  std::array<double, 2> velocity_mps{};
  std::vector<AccelerationSegment> accelerations;
  std::vector<LaneChange> lane_changes;
  double radius_m = 0.0;
  double azimuth_rad = 0.0;  // a0
  double angular_rate_rad_per_s = 0.0;
  std::vector<TimeSpan> suppressed;  // really there, and not measured: behind a lorry, say
};
bool is_suppressed(const HighwayTarget& target, double time_s);

// What a scenario states about one target at one time.
struct HighwayTruth {
  double time_s = 0.0;
  double range_m = 0.0, range_rate_mps = 0.0, azimuth_rad = 0.0;
  bool in_view = true;
};

// Timing of the waveforms that a scenario can be measured with.
struct HighwayWaveforms {
  double triangle_ramp_s = 2e-3, triangle_rate_Hz = 500e3;
  std::array<double, 2> two_slopes_ramp_s{2e-3, 3e-3};
  // Two stages: a chirp sequence, then a triangle.
  int coarse_chirps = 256;
  double coarse_chirp_s = 20e-6, coarse_rate_Hz = 20e6;
  double fine_ramp_s = 2e-3, fine_rate_Hz = 500e3;
  // A flat stretch that hops between two tones, between the ramps of a triangle.
  double coded_ramp_s = 2e-3, flat_s = 2e-3, hop_Hz = 700e3;

  // How long each takes, all its ramps one after the other.
  double triangle_s() const { return 2.0 * triangle_ramp_s; }
  double two_slopes_s() const { return 2.0 * (two_slopes_ramp_s[0] + two_slopes_ramp_s[1]); }
  double two_stage_s() const { return coarse_chirps * coarse_chirp_s + 2.0 * fine_ramp_s; }
  double coded_s() const { return 2.0 * coded_ramp_s + flat_s; }
};

struct HighwayRadar {
  double centre_frequency_Hz = 76e9;
  double bandwidth_Hz = 250e6;
  double transmitted_W = 4e-3;
  double transmit_gain = 1.0, receive_gain = 1.0;  // power ratios, as are the next two
  double noise_figure = 1.0;
  double loss = 1.0;
  double most_range_m = 200.0;
  double most_azimuth_rad = 1.0471975511965976;  // 60 degrees
  int array_elements = 12;                       // virtual, in a line
  double array_pitch_wavelengths = 0.5;
  double frame_s = 0.05;
  HighwayWaveforms waveforms;
  double ramp_s = 2e-3;  // of the triangle whose beats are told: whoever measures puts its own
};

struct HighwayScenario {
  std::string id, title;
  double duration_s = 0.0;
  double radar_speed_mps = 0.0;
  HighwayRadar radar;  // the file's, with what the scenario says otherwise
  // "triangle", "triangle-pair", "two-stage", "up-flat-down", as the scenario names them first.
  std::vector<std::string> waveform_types;
  std::vector<HighwayTarget> targets;
  std::vector<std::vector<HighwayTruth>> truth;  // of each target
};

// Relative to the radar.
struct RelativeMotion {
  std::array<double, 2> position_m{};
  std::array<double, 2> velocity_mps{};
};
RelativeMotion relative_motion(const HighwayTarget& target, double radar_speed_mps, double time_s);

// `in_view`: 0 < range <= most_range_m and |azimuth| <= most_azimuth_rad. A target at the radar's
// own place has range, rate and azimuth 0 and is out of view.
HighwayTruth truth_at(const HighwayTarget& target, double radar_speed_mps,
                      const HighwayRadar& radar, double time_s);

}  // namespace fanbeam::core
