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
// Elevation rows: the power of a cut times its middle R^3, over the elevations between its ends: evenly
// over two rows at most, else rising or falling evenly from what one end sends to what the other does.
//
// A piece that passes one border between cells is integrated on both sides of it with the pattern,
// NRCS and loss of its own middle; longer ones are cut into pieces of their own.
//
// A wall that stands obliquely in the slice's wedge spreads evenly over the ranges that it takes there
// at each of its heights.
#pragma once

#include <cstdint>

#include "renderer/casting/path_loss_table.h"
#include "renderer/casting/profile/piece_powers.h"
#include "renderer/casting/profile/power_tables.h"
#include "renderer/casting/profile/slice.h"
#include "renderer/casting/profile/slice_deposit.h"
#include "renderer/world.h"
#include "sensors/antenna/antenna_frame.h"

namespace fanbeam::renderer {

class SlicePower {
 public:
  SlicePower(const World& world, const sensors::AntennaFrame& antenna, const PowerTables& tables,
             const PathLossTable& path_loss);

  // Adds the pieces' power to `bins` and empties them.
  void add(const Slice& slice, VisiblePieces& pieces, const SliceBins& bins);

  std::uint64_t blanked() const { return blanked_; }

 private:
  struct Part;
  void finish(const Slice& slice, const VisiblePieces& pieces, PiecePowers& powers,
              const SliceBins& bins);
  void finish_parts(const Slice& slice, const SliceBins& bins);
  void lose_in_rain_cells(const Slice& slice, PiecePowers& powers) const;
  void cut(const Slice& slice, const VisiblePieces& pieces, const SliceBins& bins);
  void cut_at_cells(const Slice& slice, const VisiblePieces& pieces, int i, const SliceBins& bins);
  void put(const Slice& slice, const Part& part, const SliceBins& bins);

  const World& world_;
  const sensors::AntennaFrame& antenna_;
  const PowerTables& tables_;
  const PathLossTable& path_loss_;
  SliceDeposit deposit_;
  double radar_constant_W_m2_;
  double most_rad_;  // most_elevation_rad()
  PiecePowers powers_;
  // Parts of pieces over many cells, each in one cell, whatever rounding makes of its ends.
  VisiblePieces parts_;
  VisiblePieces::Column<std::int32_t> part_cell_;
  PiecePowers part_powers_;
  std::uint64_t blanked_ = 0;
};

}  // namespace fanbeam::renderer
