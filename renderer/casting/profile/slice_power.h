// The power that visible pieces of a slice send back, per radian of azimuth, in range cells and
// elevation rows.
//
// A straight piece lies at the perpendicular distance p from the sensor inside the half-plane, from
// s1 to s2 along its own line; R^2 = p^2 + s^2 and the elevation turns by de = p ds / R^2. With q
// the sensor's distance from the facet's plane the grazing angle is sin(psi) = q / R, and
//     dP/daz = K integral g_el^2 [sigma0 / sin(psi)] L de / R^2
//            = K g_el^2 [sigma0 / sin(psi)] L  integral p ds / (p^2 + s^2)^2 ,
// the same power as in ray_caster.h. The integral is taken between the borders of range cells
// (s^2 = R^2 - p^2). It is evaluated as
//     2 h p / Rm^4 [1 + C2 x/3 + C4 x^2/5] ,  x = (h / Rm)^2 ,
// around the middle m of a cut of half-length h, with the Gegenbauer polynomials C_2k^(2)(s_m/R_m)
// (Abramowitz & Stegun, Handbook of Mathematical Functions, 1964, 22.9.3): relative error 12 x^3,
// 3e-10 for a cell of 6.67 m at 200 m. Pattern, NRCS and loss are those at the middle of the cut.
// Elevation rows: the power of a cut times its middle R^3, spread evenly over the elevations
// between its ends.
//
// A piece that passes one border between cells is integrated on both sides of it with the pattern,
// NRCS and loss of its own middle; longer ones are cut into pieces of their own.
//
// A wall that stands obliquely in the slice's wedge spreads evenly over the ranges it takes there.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/casting/path_loss_table.h"
#include "renderer/casting/profile/slice.h"
#include "renderer/world.h"
#include "sensors/antenna/antenna_frame.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::renderer {

// What all slices of a sequence share.
class PowerTables {
 public:
  explicit PowerTables(const World& world);

  // sigma0 / sin(psi) of material m at index m * kNrcsStride.
  static constexpr int kNrcsSteps = 4096;
  static constexpr int kFineSteps = 2048;  // below kFineBelow; steps and border as in NrcsTable
  static constexpr double kFineBelow = 1.0 / 32.0;
  static constexpr int kFirstFine = kNrcsSteps + 2;
  static constexpr int kNrcsStride = kFirstFine + kFineSteps + 1;
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

// Where the power of one slice goes: [sub-column][bin], from the sub-column whose left edge is at
// `first_azimuth_rad`. With a single sub-column there are sinks for what lies outside: one more
// range cell behind the last, one more elevation row before the first and behind the last.
struct SliceBins {
  double* range_W_per_rad = nullptr;
  double* elevation_W_m3_per_rad = nullptr;  // null without a C-scope
  double weight = 1.0;                       // wedge over sub-column
  // A level antenna sees a slice in one sub-column. A tilted one, or a cone scan, sees each of its
  // points at another azimuth: the power then goes where it belongs.
  bool across = false;
  double first_azimuth_rad = 0.0;
  double step_rad = 0.0;
  int sub_columns = 1;
};

// What the vector loops find of each piece.
struct PiecePowers {
  template <class T>
  using Column = VisiblePieces::Column<T>;
  enum Kind : std::int32_t { plain, many_cells, wedge, many_rows };
  alignas(64) Column<std::int32_t> kind;
  alignas(64) Column<double> near_range_m, far_range_m;
  // The parts before and behind a border of range cells; the sink takes what is outside the gate
  // and what is not plain.
  alignas(64) Column<std::int32_t> first_cell, second_cell;
  alignas(64) Column<double> first, second;                  // integrals, then W/rad
  alignas(64) Column<double> distance_m, height_m, range_m;  // of the middle
  // Elevation rows, counted from 1: powers times R^3 in this row and the next; row 0 is a sink.
  alignas(64) Column<double> first_row, last_row;
  alignas(64) Column<std::int32_t> row;
  alignas(64) Column<double> row_share, row_power;
  int count = 0;
};

class SlicePower {
 public:
  SlicePower(const World& world, const sensors::AntennaFrame& antenna, const PowerTables& tables,
             const PathLossTable& path_loss);

  // Adds the pieces' power to `bins` and empties them.
  void add(const Slice& slice, VisiblePieces& pieces, const SliceBins& bins);

  std::uint64_t blanked() const { return blanked_; }

 private:
  void evaluate(const Slice& slice, const VisiblePieces& pieces, const SliceBins& bins);
  void lose_in_rain_cells(const Slice& slice);
  void cut_at_cells(const VisiblePieces& pieces, int i, const Slice& slice, const SliceBins& bins);
  void finish_rest(const Slice& slice, const SliceBins& bins);
  void deposit_in_column(const VisiblePieces& pieces, const SliceBins& bins);
  void deposit_special(const VisiblePieces& pieces, int i, const SliceBins& bins);
  double cone_row(const Slice& slice, double distance_m, double height_m) const;
  void deposit_across(const VisiblePieces& pieces, const Slice& slice, const SliceBins& bins);

  const World& world_;
  const sensors::AntennaFrame& antenna_;
  const PowerTables& tables_;
  const PathLossTable& path_loss_;
  double radar_constant_W_m2_;
  VisiblePieces rest_;  // parts of pieces over many cells
  VisiblePieces::Column<std::int32_t> rest_cell_;
  PiecePowers powers_;
  std::uint64_t blanked_ = 0;
};

}  // namespace fanbeam::renderer
