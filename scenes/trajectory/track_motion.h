// Private to the check of recorded flights: how fast the aircraft moves at each row, in a way that
// a few wrong rows do not change, and how hard it would be to fly from one row to another.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "scenes/trajectory/trajectory_attitude.h"
#include "scenes/trajectory/trajectory_csv.h"

namespace fanbeam::scenes {

// How far a step may stray from the flight around it before no aircraft could have flown it.
struct TrackTolerance {
  double position_m = 0.0;
  double height_m = 0.0;
};

enum class Misfit { position, speed, height, climb };

// Of the kind that is worst; beyond 1 no aircraft could.
struct StepMisfit {
  Misfit kind = Misfit::position;
  double ratio = 0.0;
  double found = 0.0;    // m, or m/s for speed and climb
  double allowed = 0.0;  // likewise
};

class TrackMotion {
 public:
  // Of these rows of the track, at least two.
  TrackMotion(const RawTrack& track, std::vector<std::size_t> rows, const PathSmoothing& smoothing);

  std::size_t size() const { return rows_.size(); }
  std::size_t row(std::size_t i) const { return rows_[i]; }

  // From row i to a later one.
  StepMisfit misfit(std::size_t from, std::size_t to) const;
  // By speeds alone: what no recording noise and no manoeuvre explains.
  StepMisfit absolute_misfit(std::size_t from, std::size_t to) const;

  // Over the ground: the median of the steps around row i, componentwise.
  double speed_mps(std::size_t i) const;
  double median_speed_mps() const;

  // Foot points on the ellipsoid, Earth-fixed, and heights.
  const glm::dvec3& foot_m(std::size_t i) const { return foot_m_[i]; }
  double height_m(std::size_t i) const { return track_.rows[rows_[i]].position.height_m; }
  double time_s(std::size_t i) const { return track_.rows[rows_[i]].time_s; }
  const TrackTolerance& tolerance() const { return tolerance_; }

 private:
  struct Velocity {
    glm::dvec3 foot_mps{0.0};
    double climb_mps = 0.0;
  };
  struct Strays {
    double foot_m = 0.0, height_m = 0.0;
  };

  void find_velocities();
  void find_tolerance(const PathSmoothing& smoothing);
  Velocity step_velocity(std::size_t step) const;
  Strays strays(std::size_t from, std::size_t to) const;

  const RawTrack& track_;
  std::vector<std::size_t> rows_;
  std::vector<glm::dvec3> foot_m_;
  std::vector<Velocity> velocities_;
  // Sums over the steps before each row of what a manoeuvre adds to their tolerance.
  std::vector<TrackTolerance> manoeuvred_;
  TrackTolerance tolerance_;
};

}  // namespace fanbeam::scenes
