// Reflectivity from a table of grazing angles, such as a measurement.
//
// Between two rows sigma0 in dB is a straight line over the logarithm of the grazing angle, which
// is a power law: the shape of every land and sea model here at low angles. Where a row is exactly
// zero, sigma0 is linear in the angle instead. Outside the rows the nearest one is held: no slope
// is made up. A table with one row is a constant. Neglected: frequency (a table holds at those it
// was measured at). Accuracy: exact at the rows.
#pragma once

#include <vector>

namespace fanbeam::materials {

struct NrcsSample {
  double grazing_rad = 0.0;
  double sigma0 = 0.0;
};

class TabulatedNrcs {
 public:
  // Throws InputError with all problems: E-PARSE for an empty table, E-NONFINITE, E-RANGE for
  // angles outside 0 (excluded) to pi/2 or not increasing and for sigma0 outside 0 to 1e6.
  explicit TabulatedNrcs(std::vector<NrcsSample> rows);

  // Zero at grazing angles of zero and below.
  double sigma0(double grazing_rad) const;

  const std::vector<NrcsSample>& rows() const { return rows_; }

 private:
  std::vector<NrcsSample> rows_;
};

}  // namespace fanbeam::materials
