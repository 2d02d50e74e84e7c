// Makes a trajectory of a recorded track and supplies the attitude where the recording has none.
//
// Fully recorded attitude: one pose per row, just as recorded; velocity is the slope of the
// position over a second.
//
// Otherwise the path is smoothed first (positions of transponders come 1 to 30 s apart, late or
// repeated, heights in steps of 25 ft = 7.62 m), and the angles not recorded follow from it:
//   heading  track over ground. Crab is neglected: 5 deg at 12 kt of cross wind and 140 kt.
//            Below `slowest_mps` the last heading is kept.
//   pitch    path angle over ground plus an assumed angle of attack
//   roll     coordinated turn, tan(roll) = lateral acceleration / g
// Measured on an airliner's approach to Denver (ADS-B, rows 8 s apart) over the last 20 km: path
// angle -3.1 deg in the mean, 0.3 deg standard deviation, roll below 5 deg, on a 3 deg glide path.
#pragma once

#include "core/errors.h"
#include "core/units.h"
#include "scenes/trajectory/trajectory.h"
#include "scenes/trajectory/trajectory_csv.h"

namespace fanbeam::scenes {

// How much of a recorded path is taken as noise. Position and height are treated as values with
// white third derivative seen through white noise (scenes/trajectory/trajectory_smoothing.h): the defaults
// keep manoeuvres slower than about 5 s at rows 5 s apart.
struct PathSmoothing {
  double position_noise_m = 40.0;                  // 0.01 to 1000; half a second's delay at 80 m/s
  double height_noise_m = 5.0;                     // 0.01 to 1000
  double horizontal_jerk_density_m2_per_s5 = 0.5;  // 1e-6 to 1e3; a standard turn begun in 5 s
  double vertical_jerk_density_m2_per_s5 = 0.02;   // 1e-6 to 1e3
};

struct AttitudeAssumptions {
  double angle_of_attack_rad = core::radians(4.0);  // -10 to 20 deg; assumed
  double slowest_mps = 2.0;                         // 0.1 to 50
  double step_s = 0.1;                              // 0.01 to 1; poses of a derived path
  PathSmoothing smoothing;
};

// The track's heights must already count from the ellipsoid (or be the scene's own). A track of one
// row is a fixed pose, level and facing north in the angles it lacks.
// Throws InputError: E-RANGE or E-NONFINITE for an assumption, E-LIMIT for more than kMostTrackRows
// derived poses and for gaps of more than a minute that last six hours together, E-TIME and as Trajectory does. Adds to `problems`:
//   W-GAP       rows more than a minute apart, bridged by a smooth curve that nobody flew
//   W-ATTITUDE  a fixed pose without attitude
Trajectory trajectory_from(const RawTrack& track, const AttitudeAssumptions& assumptions,
                           core::ProblemList& problems);

}  // namespace fanbeam::scenes
