// Tracks of several targets from the measurements of one radar after another.
//
// Each frame: all tracks are predicted; pairs that the radar cannot resolve are set aside and
// coast; the other confirmed tracks and the measurements inside their gates are associated, by the
// best assignment or by joint probabilities; then tracks not yet confirmed, whose gates are wide,
// and what is left, always by the best assignment; measurements that belong to none start new
// tracks.
//   gate          chi-square of range, range rate and azimuth
//   assignment    cost -ln(Pd g / lambda), of a miss -ln(1 - Pd)
//   confirmation  `confirm_hits` measurements in the first `confirm_window` frames, or it is gone
//   coasting      up to `most_coasted` frames without a measurement, then a track ends; so does one
//                 predicted outside the field of view
//   unresolved    two confirmed tracks predicted closer than the resolution on all three axes. They
//                 are not updated, for up to `most_unresolved_s`, until both can be given a
//                 measurement of their own again; then the likelier of the two ways is taken and
//                 its probability (tracking/association/crossing.h) goes into both tracks
//   start         position and closing speed as measured, nothing known of the tangential speed;
//                 not closer than the resolution to a confirmed track, where biased pairs of merged
//                 beats lie
// The measurement noise is that stated, plus floors for what a point target and a linearised model
// leave out: an uncertainty u across the line of sight bends the range by u^2 / 2R.
// Source: S. Blackman, R. Popoli, "Design and Analysis of Modern Tracking Systems", 1999, ch. 6;
// Y. Bar-Shalom, P. K. Willett, X. Tian, "Tracking and Data Fusion", 2011.
// Neglected: groups of three and more unresolved targets are taken pair by pair.
// Inputs: times that do not go back (E-TIME; the tracks are then unchanged), measurements as of
// observation.h. Measurements that would make an innovation singular are counted, not used.
#pragma once

#include <optional>

#include "tracking/association/joint_probabilities.h"
#include "tracking/filters/imm.h"

namespace fanbeam::tracking {

enum class Association { nearest, joint };

struct TrackerSettings {
  ImmModel motion = {{MotionModel{}}, 2.0};
  Association association = Association::nearest;
  double range_floor_m = 0.005, range_rate_floor_mps = 0.005, azimuth_floor_rad = 5e-4;
  double gate_probability = 0.9999;
  JointSettings joint = {0.98, 0.9999, 1e-4};  // density per m, m/s and rad
  int confirm_hits = 3, confirm_window = 4;
  int most_coasted = 10;
  double start_tangential_sigma_mps = 20.0;
  double resolution_m = 1.3, resolution_mps = 1.2, resolution_rad = 0.15;
  double most_unresolved_s = 6.0;
  double most_range_m = 200.0, most_azimuth_rad = 1.0471975511965976;
};

struct Track {
  int id = 0;
  bool confirmed = false;
  ImmState state;
  int hits = 0, frames = 0, coasted = 0;
  std::optional<int> unresolved_with;  // id of the other one
  double unresolved_s = 0.0;           // so far
  double existence = 0.5;              // since it was confirmed, with Association::joint
  // That the target is still the one the track started with.
  double identity_probability = 1.0;
};

// Speed over ground is above `least_mps` by two standard deviations of its own uncertainty:
// a target that beams has no range rate, but its angle moves.
bool is_moving(const Track& track, const std::array<double, 2>& radar_velocity_mps,
               double least_mps = 1.0);

class Tracker {
 public:
  explicit Tracker(TrackerSettings settings);

  void update(double time_s, const std::vector<RadarMeasurement>& measurements);

  const std::vector<Track>& tracks() const { return tracks_; }
  int skipped_updates() const { return skipped_; }

 private:
  void find_unresolved(double step_s);
  void associate(const std::vector<RadarMeasurement>& measurements, std::vector<bool>& used);
  void update_nearest(const std::vector<std::size_t>& which,
                      const std::vector<RadarMeasurement>& measurements, std::vector<bool>& used);
  void update_joint(const std::vector<std::size_t>& which,
                    const std::vector<RadarMeasurement>& measurements, std::vector<bool>& used);
  void part(const std::vector<RadarMeasurement>& measurements, std::vector<bool>& used);
  void end_and_confirm();
  void start(const std::vector<RadarMeasurement>& measurements, const std::vector<bool>& used);
  bool near_confirmed(const RadarMeasurement& measurement) const;
  void hit(Track& track, const RadarMeasurement& measurement);

  TrackerSettings settings_;
  double gate_;
  std::vector<Track> tracks_;
  std::optional<double> time_s_;
  int next_id_ = 1, skipped_ = 0;
};

}  // namespace fanbeam::tracking
