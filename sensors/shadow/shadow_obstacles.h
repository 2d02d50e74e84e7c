// Heights of obstacles from the lengths of their radar shadows.
//
// The ray over the top of an obstacle ends where its shadow ends. On flat ground the heights of its
// points below the antenna are as their slant ranges, so without any approximation
//   height = h (1 - R / E) = h L / (R + L)
// h the antenna's height above the ground, R the slant range of the top edge that casts the shadow,
// E = R + L that of the shadow's end. One cell of shadow is worth dh = h R cell / (R + L)^2, which
// is the stated error.
// R is the middle of the brightest cell when the shadow begins in the next one (a wall), else where
// the dark begins, to a part of a cell (the far edge of a roof).
//
// Runs of neighbouring columns whose starts differ by at most four rows are one obstacle. It is
// kept when
//   edge      its leading edge stands out, 2 times the ground behind and 1.5 times that before it
//             (under speckle more, by the fluctuation of one cell), median of its columns
//   depth     its deepest column lies at least 35 % below the ground; columns of less than half
//             that depth are the beam's edge and dropped, two must be left
//   beam      it is as dark as the two-way beam lets a shadow of its width be, within 15 %, and
//             within 2 % where that is less than 2 %: dark ground still echoes
//   sides     long ones do not narrow like a strip of constant width (a runway) does, but run along
//             the rays
//   height    at least 3 m
// The outermost two columns on either side of the picture are left out.
// A height is for use only where the shadow can tell it: see shadow_certainty.h.
//
// Inputs: h in m above 0, as for flat_earth_cscope_W_m3 (what a radar altimeter reads below the
// aircraft); B-scope power in W with its noise.
// Neglected: slopes behind the obstacle and between aircraft and obstacle (ground lower by d at the
// shadow's end reads as d R / (R + L) more height), curvature (0.15 m at 3.5 km), several
// obstacles behind each other (flagged), shadows beyond the range gate (flagged).
// Accuracy: docs/physics/shadow-heights.md. Cost: 25 to 32 ms a frame of HiVision on two cores.
#pragma once

#include <span>
#include <vector>

#include "sensors/sensor.h"

namespace fanbeam::sensors {

struct ShadowObstacle {
  int first_column = 0, last_column = 0;
  double azimuth_rad = 0.0;
  double range_m = 0.0;                // slant range of the leading edge, median of the columns
  std::vector<double> column_range_m;  // of each column
  double height_m = 0.0;
  double height_error_m = 0.0;  // what one range cell of shadow is worth
  double shadow_length_m = 0.0;
  bool truncated = false;  // the shadow is cut off: uncertain, too
  bool merged = false;     // another object stands in the shadow, which may be partly its own
  // The shadow does not tell the height (shadow_certainty.h); then height_m and
  // height_error_m are not to be shown.
  bool uncertain = false;
};

// In order of column. Throws InputError E-RANGE unless height_m is above 0, E-NONFINITE when it is
// not finite.
std::vector<ShadowObstacle> shadow_obstacles(const Sensor& sensor, std::span<const double> power_W,
                                             double height_m);

}  // namespace fanbeam::sensors
