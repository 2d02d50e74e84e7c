// The power that visible pieces of a slice send back, per radian of azimuth, in range cells and
// elevation rows.
//
// A straight piece lies at the perpendicular distance p from the sensor inside the half-plane, from
// s1 to s2 along its own line; R^2 = p^2 + s^2 and the elevation turns by de = p ds / R^2. With q
// the sensor's distance from the facet's plane the grazing angle is sin(psi) = q / R, and
//     dP/daz = K integral g_el^2 [sigma0 / sin(psi)] L de / R^2
//            = K g_el^2 [sigma0 / sin(psi)] L  integral p ds / (p^2 + s^2)^2 ,
// the same power as in ray_caster.h. Pieces are cut where they pass from one range cell into the
// next (s^2 = R^2 - p^2) and where the line is nearest to the sensor. The integral is evaluated as
//     2 h p / Rm^4 [1 + C2 x/3 + C4 x^2/5 + C6 x^3/7] ,  x = (h / Rm)^2 ,
// around the middle m of a cut of half-length h, with the Gegenbauer polynomials C_2k^(2)(s_m/R_m)
// (Abramowitz & Stegun, Handbook of Mathematical Functions, 1964, 22.9.3): relative error below
// 1e-12 for cuts shorter than R/30. Pattern, NRCS and loss are those at the middle of the cut.
// Elevation rows: the power of a cut times its middle R^3, spread evenly over the elevations
// between its ends.
//
// A wall that stands obliquely in the slice's wedge spreads evenly over the ranges it takes there.
#pragma once

#include <array>
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
  // C-scope.
  static constexpr int kSineSteps = 8192;
  double lowest_sine() const { return lowest_sine_; }
  double steps_per_sine() const { return steps_per_sine_; }
  const double* gain() const { return gain_.data(); }
  const double* row() const { return row_.data(); }

 private:
  std::vector<double> nrcs_, gain_, row_;
  double lowest_sine_ = 0.0, steps_per_sine_ = 0.0;
};

// Where the power of one slice goes: [sub-column][bin], from the sub-column whose left edge is at
// `first_azimuth_rad`.
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

// Cuts of pieces, each inside one range cell but for walls, side by side.
struct PieceCuts {
  static constexpr int kCapacity = 512;
  template <class T>
  using Column = std::array<T, kCapacity>;
  alignas(64) Column<double> near_distance_m, near_height_m, far_distance_m, far_height_m;
  alignas(64) Column<double> in_plane_m, facet_m;
  alignas(64) Column<double> from_cell, to_cell;
  alignas(64) Column<std::int32_t> material;
  // Results
  alignas(64) Column<double> middle_distance_m, middle_height_m, range_m, power_W_per_rad;
  alignas(64) Column<double> first_row, last_row;
  int count = 0;
};

class SlicePower {
 public:
  SlicePower(const World& world, const sensors::AntennaFrame& antenna, const PowerTables& tables,
             const PathLossTable& path_loss);

  // Adds the pieces' power to `bins` and empties them.
  void add(const Slice& slice, VisiblePieces& pieces, PieceCuts& cuts, const SliceBins& bins);

  std::uint64_t blanked() const { return blanked_; }

 private:
  void flush(PieceCuts& cuts, const Slice& slice, const SliceBins& bins);
  void lose_on_path(const Slice& slice, PieceCuts& cuts) const;
  void deposit_in_column(const PieceCuts& cuts, const SliceBins& bins) const;
  void deposit_across(const PieceCuts& cuts, const Slice& slice, const SliceBins& bins) const;

  const World& world_;
  const sensors::AntennaFrame& antenna_;
  const PowerTables& tables_;
  const PathLossTable& path_loss_;
  double radar_constant_W_m2_;
  std::uint64_t blanked_ = 0;
};

}  // namespace fanbeam::renderer
