// The B-scope as the search for shadows wants it: ground of strength 1, noise taken away.
//
//   q = (P - N) / C(R)
// P is received power with its noise, N the sensor's known mean noise power per range cell, C the
// clutter of a range: the mode of the histogram of levels (half a dB per bin, five bins smoothed)
// of all cells within 16 rows, averaged in dB over 40 rows on either side. The histogram parts
// noise and shadow from clutter: where its mode is less than 1 dB above the noise no ground is
// seen, and no shadow can be. The mode, unlike the mean, does not follow the bright things.
//
// The fluctuation of one cell comes from the picture as well: the median of |ln(P1 / P2)| of range
// neighbours over that of two exponential powers, ln 3. 1 means one look of speckle, 0.02 a
// picture of mean powers.
//
// Input: B-scope power in W, 0 or more and finite; row 0 is the nearest.
// Neglected: two kinds of ground side by side; the more frequent one is the clutter. C then errs
// by their contrast, which the search meets by comparing a shadow with the ground around it too.
// Cost: 2.5 ms for 164 x 524 cells.
#pragma once

#include <span>
#include <vector>

#include "sensors/sensor.h"

namespace fanbeam::sensors {

struct ShadowGround {
  int columns = 0;
  int rows_end = 0;           // rows from here on show no ground
  double fluctuation = 0.0;   // relative standard deviation of one cell of even ground
  std::vector<double> q;      // [row][column]
  std::vector<double> noise;  // N / C by row

  double at(int row, int column) const {
    return q[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
             static_cast<std::size_t>(column)];
  }
};

ShadowGround shadow_ground(const Sensor& sensor, std::span<const double> power_W);

}  // namespace fanbeam::sensors
