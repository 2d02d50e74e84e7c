// Where inside its sub-column of azimuth, and its step in elevation, a ray goes.
#pragma once

#include <cmath>
#include <cstdint>

namespace fanbeam::renderer {

struct SubColumn {
  double centre_rad = 0.0, cosine = 0.0, sine = 0.0, step_rad = 0.0;

  // Of `place` in [0, 1) from the middle.
  double offset_rad(double place) const { return step_rad * (place - 0.5); }
};

// A low-discrepancy place inside the sub-column for ray `index`: multiples of the golden ratio,
// shifted from sub-column to sub-column by another irrational so that neighbours do not repeat each
// other. `shift`, in parts of 2^32, moves them all.
inline double dither(std::uint32_t index, int sub_column, std::uint32_t shift) {
  // Fractions as 32-bit integers wrap round by themselves: 0.6180339887 and 0.7548776662 times
  // 2^32, the golden ratio and the first step of the R2 sequence.
  const std::uint32_t value =
      index * 2654435769U + static_cast<std::uint32_t>(sub_column) * 3242174889U + shift;
  return static_cast<double>(value) * 0x1p-32;
}

// Where the rays of a sub-column lie inside their steps in elevation, as a part of the step; that
// of sub-column 0 is `first`. The edge of a wall that faces the radar has one elevation in many
// azimuths: rays at the same elevations everywhere would get the same wrong part of it in all of
// them.
inline double elevation_place(int sub_column, double first) {
  // With the step of dither() from one sub-column to the next, the R2 sequence.
  constexpr double kStep = 0.5698402909980532;
  const double place = first + kStep * sub_column;
  return place - std::floor(place);
}

}  // namespace fanbeam::renderer
