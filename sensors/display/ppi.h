// Metric plan view (PPI) of a B-scope: each pixel has the value of the B-scope's cell that holds its
// middle, so there are no gaps.
//
// Slant range is drawn as distance: at height h a point at distance d appears h^2 / (2 d) too far,
// 18 m for 120 m at 400 m. Azimuth is drawn as the angle in the ground plane (exact for a
// stabilised plane scan).
// Outside the scanned sector and range the picture is grey 0.
#pragma once

#include <span>
#include <vector>

#include "sensors/display/display.h"
#include "sensors/sensor.h"

namespace fanbeam::sensors {

struct PpiView {
  enum class Up { north, track };  // track: the antenna's forward axis points up
  Up up = Up::track;
  int columns = 0;  // 1 to 8192
  int rows = 0;
  double metres_per_pixel = 0.0;  // above 0
  // Place of the antenna, in pixels from the picture's left and upper edge; may lie outside.
  double antenna_column = 0.0;
  double antenna_row = 0.0;
};

// A picture that just holds the sector that the sensor sees and the antenna; its size and scale
// are the same for every heading.
//   track  the sector's bounding box, antenna in the middle of the lower edge (of the picture's
//          middle, when the scan reaches behind): cut out of the square of `size_px` whose lower
//          edge is max(1, 2 sin(half sector)) maximum ranges long, 2 when the scan reaches behind.
//   north  a square of `size_px` around the smallest circle that holds sector and antenna, with
//          the circle in its middle: with the half sector a and the maximum range R, the radius is
//          R / (2 cos a) up to a = 45 deg, R sin a up to 90 deg, R beyond.
// Throws InputError E-RANGE for a size outside 1 to 8192, E-NONFINITE for the heading.
PpiView ppi_view(const Sensor& sensor, PpiView::Up up, int size_px, double heading_rad);

// Unrounded grey, row-major, top row first, of unrounded B-scope grey as bscope_grey gives it.
// `heading_rad` is the true heading of the antenna's forward axis; it matters for north up only.
// Throws InputError E-RANGE or E-NONFINITE for a view outside the ranges above or a heading that
// is not finite.
std::vector<double> ppi_grey(const Sensor& sensor, std::span<const double> bscope_grey,
                             double heading_rad, const PpiView& view);

Picture8 ppi_picture(const PpiView& view, std::span<const double> grey);

}  // namespace fanbeam::sensors
