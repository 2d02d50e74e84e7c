// Is a recorded flight one that an aircraft could have flown? Finds rows with a wrong position,
// height, time or attitude, and blames them alone.
//
// Positions. A row's velocity is the median of the nine steps around it, so that four wrong ones do
// not change it. Where a step strays from these medians by more than its tolerance
//   sideways or along   noise + 12 m/s2 dt^2
//   in height           noise + the smaller of 10 m/s2 dt^2 and 60 m/s dt
// the rows on one side of it are wrong. The fewest rows are blamed without which every step is
// within its tolerance (over blamed rows: the sum of those of their steps). So a row, or two or
// three in a run, are blamed themselves and their good neighbours are not; of a row with a wrong
// time the position is off.
//   12 m/s2 is a turn with 51 deg of bank, twice what airliners may use, held throughout the step;
//   10 m/s2 is a pull of two g or a push to none, 60 m/s three times an airliner's best climb.
//   The noise is 50 times the recording's median stray (transponders' rows come late or filled in:
//   on an airliner's and four calibration flights, 5 to 30 s apart, the worst stray is 34 times the
//   median), at most 1000 m and 250 m, and in height at least 4 times the median step, since
//   heights are rounded. It is never less than three times what the smoothing of a path without
//   attitude takes for noise, 120 m and 15 m. With attitude, where the path is flown as it stands,
//   that floor is 2 m, and along the ground the way of 0.1 s more, for clocks that stutter.
// Speed and climb are held against 1000 m/s and 400 m/s besides (fastest jet: 981 m/s; steepest
// climbs of fighters: about 300 m/s).
//
// Attitude. A step between two rows may turn the aircraft by 10 deg + 400 deg/s dt (the fastest
// rolls of aerobatics), its heading and pitch by 10 deg + 60 deg/s dt, below 40 m/s its heading by
// 10 deg + 120 deg/s dt (a hovering helicopter); above 40 m/s never by more than 100 deg; and by 15
// times the recording's median in any case. Beyond 60 deg of pitch heading is not looked at. Rows
// are blamed as above; a change that stays is nobody's fault.
//
// Repeated rows. Rows that repeat the latitude and longitude of the row before, while the flight
// goes on by more than 15 m/s, are stale. They are an error where more than the tolerance above is
// missed, else a warning.
//
// Odd, but possible; over 2 s or more, beyond what the tolerance explains: more than 350 m/s over
// the ground, 50 m/s of climb, 20 m/s2, a turn of 30 deg/s, a pitch of 45 deg (recorded, or of the
// path where it must be derived), half a step's tolerance. An acceleration of more than 120 m/s2
// (12 g) is an error. With attitude recorded, a gap of more than ten times the median step, at
// least 5 s and at most 60 s, is odd.
//
// Fewer than five rows are held against speed and climb only. A flight of which more than a quarter
// of the rows would be blamed is refused as a whole, to be mended by hand under
// OutlierPolicy::reject too: its columns or units are wrong, or it is two flights.
// Cost: O(n log n).
#pragma once

#include "core/errors.h"
#include "core/units.h"
#include "scenes/trajectory/trajectory_attitude.h"
#include "scenes/trajectory/trajectory_csv.h"

namespace fanbeam::scenes {

inline constexpr double kFastest_mps = 1000.0;
inline constexpr double kFastestClimb_mps = 400.0;
inline constexpr double kHardestTurn_mps2 = 12.0;
inline constexpr double kHardestPull_mps2 = 10.0;
inline constexpr double kLargestClimbChange_mps = 60.0;
inline constexpr double kHardestAcceleration_mps2 = 120.0;
inline constexpr double kMedianStrays = 50.0;
inline constexpr double kMedianHeightSteps = 4.0;
inline constexpr double kMostNoise_m = 1000.0;
inline constexpr double kMostHeightNoise_m = 250.0;
inline constexpr double kSmoothedDeviations = 3.0;  // of AttitudeAssumptions::smoothing
inline constexpr double kRecordedTolerance_m = 2.0;
inline constexpr double kRecordedDelay_s = 0.1;
inline constexpr double kStaleSpeed_mps = 15.0;
inline constexpr std::size_t kFewestRows = 5;
inline constexpr double kLargestBlamedShare = 0.25;

// Heights may count from anything. Adds to `problems`, with file and line of the row:
//   E-RANGE    rows that no aircraft could have flown; with OutlierPolicy::reject they and the
//              stale ones are left out of the track instead
//   W-OUTLIER  how many were left out, those of read_track_csv included
//   W-STALE, W-SPEED, W-CLIMB, W-ACCELERATION, W-TURN, W-PITCH, W-STRAY, W-GAP
//              what is odd: how often, the worst row and its value
// With OutlierPolicy::keep nothing is looked at.
void check_track(RawTrack& track, const TrajectoryColumns& columns, const PathSmoothing& smoothing,
                 core::ProblemList& problems);

}  // namespace fanbeam::scenes
