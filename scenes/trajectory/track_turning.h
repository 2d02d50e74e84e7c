// Private to the check of recorded flights: how far recorded attitudes are from each other.
#pragma once

#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "scenes/trajectory/trajectory_csv.h"

namespace fanbeam::scenes {

// Between two rows; beyond 1 no aircraft could turn so.
struct TurnMisfit {
  const char* angle = "heading";  // the one that changes most
  double ratio = 0.0;
  double found_deg = 0.0;
  double allowed_deg = 0.0;
};

class TrackTurning {
 public:
  // Of these rows, at least one, with the aircraft's speed over the ground at each.
  TrackTurning(const RawTrack& track, std::vector<std::size_t> rows,
               std::vector<double> speeds_mps);

  std::size_t size() const { return rows_.size(); }
  std::size_t row(std::size_t i) const { return rows_[i]; }

  // From row i to a later one.
  TurnMisfit misfit(std::size_t from, std::size_t to) const;

 private:
  struct Turn {
    double rotation_rad = 0.0, heading_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;
    bool steep = false;  // too steep for a heading
  };
  Turn turn(std::size_t from, std::size_t to) const;
  const TrackRow& at(std::size_t i) const { return track_.rows[rows_[i]]; }

  const RawTrack& track_;
  std::vector<std::size_t> rows_;
  std::vector<double> speeds_mps_;
  double median_rotation_deg_ = 0.0, median_heading_deg_ = 0.0, median_pitch_deg_ = 0.0;
};

}  // namespace fanbeam::scenes
