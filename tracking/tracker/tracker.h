// Tracks of several targets from the measurements of one radar after another.
//
// Each frame: all tracks are predicted; pairs that the radar cannot resolve are set aside and
// coast; the other confirmed tracks and the measurements inside their gates are associated, by the
// best assignment or by joint probabilities; then tracks not yet confirmed, whose gates are wide,
// and what is left, always by the best assignment; measurements that belong to none start new
// tracks.
//   measured      range, range rate and azimuth with planar models; range and range rate alone with
//                 models of one axis (a radar without an array)
//   gate          chi-square of what is measured
//   assignment    cost -ln(Pd g / lambda), of a miss -ln(1 - Pd)
//   confirmation  when the ratio of likelihoods, of a target over false measurements, the product
//                 over the frames after the first of Pd g / lambda for a measurement and 1 - Pd for
//                 none, reaches `confirm_ratio`; a track that does not within `confirm_window`
//                 frames is gone. Of starts from false measurements at most one in `confirm_ratio`
//                 gets there (J. Ville, 1939; A. Wald, "Sequential Analysis", 1947), as long as
//                 they are independent and as dense as lambda. Two measurements usually do, three
//                 near by, where the angle tells little in so short a time
//   coasting      up to `most_coasted` frames without a measurement, and no more than twice those with one,
//                 then a track ends: ghosts live by chance, and rarely for long; so does one predicted
//                 outside the field of view. Where frames themselves are missing it ends after
//                 `longest_gap_s`, an unresolved one too, before the next frame is looked at
//   unresolved    two confirmed tracks predicted closer than the resolution on all axes, of which the
//                 radar sees but one: no two measurements, one inside each gate, that fit no other
//                 confirmed track better, but for one that began between the two. They are not
//                 updated until both can be given a measurement of their own again; then the
//                 likelier of the two ways is taken and its probability
//                 (tracking/association/crossing.h) goes into both tracks. Without azimuth the
//                 prediction alone decides, and both have to be measured apart as well: what merged
//                 beats leave of two ranges looks like two. Frames in which nothing is measured of
//                 either are coasted as by any other track (with azimuth: without, merged beats may
//                 leave nothing). After
//                 `most_unresolved_s` they are given up: both take part again, as likely exchanged as
//                 not, are not set aside with each other before they have been apart, and the one
//                 without measurements ends
//   start         position and closing speed as measured, nothing known of the tangential speed;
//                 closer than the resolution to a confirmed track, where biased pairs of merged
//                 beats lie, only with an azimuth, outside of that track's gate, and if it has a
//                 measurement of its own in the same frame: then there are two
//   existence     of a confirmed track, by what is measured of it and what is not (existence.h)
// The measurement noise is that stated, plus what the source states to be wrong besides
// (observation.h), plus floors, 0 by default, for what a point target leaves out: the echo of a car
// wanders over metres of it. What the linearised model leaves out is in observation.h.
// Source: S. Blackman, R. Popoli, "Design and Analysis of Modern Tracking Systems", 1999, ch. 6;
// Y. Bar-Shalom, P. K. Willett, X. Tian, "Tracking and Data Fusion", 2011.
// Neglected: groups of three and more unresolved targets are taken pair by pair.
// Inputs: times that do not go back (E-TIME; the tracks are then unchanged), at most kMostMeasurements
// a frame (E-LIMIT, unchanged as well), measurements as of observation.h. Measurements that would make
// an innovation singular are counted, not used.
// Cost: six targets take 0.09 ms a frame on one core, a hundred 2.3 ms; with the cube from there: a thousand
// take 0.5 s, two thousand 3.4 s and 0.2 GB; of clutter alone, where most measurements start a track, two thousand
// take half a second.
#pragma once

#include <cstdint>
#include <vector>

#include "tracking/association/joint_probabilities.h"
#include "tracking/tracker/track.h"
#include "tracking/tracker/track_geometry.h"

namespace fanbeam::tracking {

inline constexpr std::size_t kMostMeasurements = 2000;

enum class Association { nearest, joint };

struct TrackerSettings {
  ImmModel motion = {{MotionModel{}}, 2.0};
  Association association = Association::nearest;
  double range_floor_m = 0.0, range_rate_floor_mps = 0.0, azimuth_floor_rad = 0.0;
  // Of both associations; the density is per m, m/s and rad, or per m and m/s on one axis.
  JointSettings detection = {0.98, 0.9999, 1e-4};
  double confirm_ratio = 1e6;
  int confirm_window = 4;
  int most_coasted = 10;
  double longest_gap_s = 1e300;
  double believed_s = 1.0;  // existence.h
  double start_tangential_sigma_mps = 20.0;
  Resolution resolution;
  double most_unresolved_s = 6.0;
  double most_range_m = 200.0, most_azimuth_rad = 1.0471975511965976;
};

class Tracker {
 public:
  explicit Tracker(TrackerSettings settings);

  void update(double time_s, const std::vector<RadarMeasurement>& measurements);

  const std::vector<Track>& tracks() const { return tracks_; }
  // So far, in the order of time.
  const std::vector<Crossing>& crossings() const { return crossings_; }
  int skipped_updates() const { return skipped_; }
  // Of joint probabilities, whose sums were exact where this is 0 (joint_probabilities.h).
  std::int64_t left_out() const { return left_out_; }

 private:
  struct Frame;
  struct PairPlaces;

  bool has_azimuth() const { return settings_.motion.axes() == 2; }
  void claim(Frame& frame) const;
  std::vector<double> log_likelihoods(const Track& one, const Track& other, Frame& frame) const;
  bool is_measured(const Track& one, const Track& other, Frame& frame) const;
  void coast_unresolved(double step_s, Frame& frame);
  void release(Track& track);
  void give_up(double step_s, Frame& frame);
  void find_unresolved(double step_s, Frame& frame);
  std::optional<std::pair<std::size_t, std::size_t>> seen_apart(const Track& a, const Track& b,
                                                                Frame& frame) const;
  std::vector<PairPlaces> pairs_aside() const;
  void part(Frame& frame);
  void part(Track& a, Track& b, Frame& frame);
  void associate(Frame& frame);
  void update_nearest(const std::vector<std::size_t>& which, Frame& frame);
  void update_joint(const std::vector<std::size_t>& which, Frame& frame);
  template <typename Found>
  void inside_gates(const std::vector<std::size_t>& which, const Frame& frame,
                    const Found& found) const;
  void end_and_confirm();
  void start(const Frame& frame);
  bool second_of_confirmed(const RadarMeasurement& one,
                           const std::vector<PolarPlace>& places) const;
  void hit(Track& track, const RadarMeasurement& measurement);

  TrackerSettings settings_;
  Measured measured_;
  double gate_;
  std::vector<Track> tracks_;
  std::vector<Crossing> crossings_;
  std::optional<double> time_s_;
  int next_id_ = 1, skipped_ = 0;
  std::int64_t left_out_ = 0;
};

}  // namespace fanbeam::tracking
