// What the slices of a sequence share: reflectivity over grazing angle, pattern and C-scope rows over
// elevation, as arrays for vector loops.
#pragma once

#include <vector>

#include "renderer/surfaces/nrcs_table.h"
#include "renderer/world.h"

namespace fanbeam::renderer {

class PowerTables {
 public:
  explicit PowerTables(const World& world);

  // sigma0 / sin(psi): NrcsTable's values for material m, from index m * NrcsTable::kEntries on.
  const double* nrcs() const { return nrcs_.data(); }

  // By the sine of the elevation: the two-way gain, and the elevation in rows from the top of the
  // C-scope. 8192 steps over the pattern: for HiVision 1e-5 of the peak; a beam narrower than a
  // hundredth of its side lobes' reach is followed less well than by sensors::TwoWayTable.
  static constexpr int kSineSteps = 8192;
  double lowest_sine() const { return lowest_sine_; }
  double steps_per_sine() const { return steps_per_sine_; }
  const double* gain() const { return gain_.data(); }
  const double* row() const { return row_.data(); }
  const double* even_gain() const { return even_gain_.data(); }  // 1 everywhere
  // Single look-ups of the same; outside the pattern the gain is 0.
  double gain_at(double sine) const { return look_up(gain_, sine); }
  double row_at(double sine) const { return look_up(row_, sine); }
  double top_rad() const { return top_rad_; }
  double rows_per_rad() const { return rows_per_rad_; }
  // The pattern ends at sines smaller than this, either way.
  bool near_horizon(double sine) const { return lowest_sine_ > -sine && highest_sine_ < sine; }

 private:
  double look_up(const std::vector<double>& table, double sine) const;

  std::vector<double> nrcs_, gain_, even_gain_, row_;
  double lowest_sine_ = 0.0, highest_sine_ = 0.0, steps_per_sine_ = 0.0;
  double top_rad_ = 0.0, rows_per_rad_ = 0.0;
};

}  // namespace fanbeam::renderer
