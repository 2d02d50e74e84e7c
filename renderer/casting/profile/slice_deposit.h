// Sums the powers of a slice's pieces in range cells and elevation rows.
#pragma once

#include <cstdint>

#include "renderer/casting/profile/piece_powers.h"
#include "renderer/casting/profile/slice.h"
#include "renderer/world.h"
#include "sensors/antenna/antenna_frame.h"

namespace fanbeam::renderer {

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
  std::uint8_t* reached = nullptr;  // by sub-column: set to 1 where power goes
};

class SliceDeposit {
 public:
  SliceDeposit(const World& world, const sensors::AntennaFrame& antenna, const PowerTables& tables)
      : world_(world), antenna_(antenna), tables_(tables) {}

  void add(const VisiblePieces& pieces, const Slice& slice, const SineWeights& weights,
           PiecePowers& powers, const SliceBins& bins) const;

 private:
  void add_in_column(const VisiblePieces& pieces, const SineWeights& weights, PiecePowers& powers,
                     const SliceBins& bins) const;
  void add_special(const VisiblePieces& pieces, const SineWeights& weights,
                   const PiecePowers& powers, int i, const SliceBins& bins) const;
  // From and to in sub-columns.
  struct Sweep {
    double from = 0.0, to = 0.0;
    // Of the antenna's to the slice's coordinates, times a cone's gain; 0 behind the antenna.
    double solid_angle_ratio = 0.0;
  };
  // In rows of the picture.
  struct Rows {
    double high, low;
    double tilt = 0.0;  // of deposit()
  };
  // Of the antenna's elevation of a piece's ends.
  struct EndSines {
    double near, far;
  };
  EndSines plane_sines(const VisiblePieces& pieces, const SineWeights& weights,
                       const PiecePowers& powers, int i) const;
  EndSines cone_sines(const VisiblePieces& pieces, const Slice& slice, int i) const;
  double tilt_of(const VisiblePieces& pieces, const PiecePowers& powers, int i, const Rows& rows,
                 const EndSines& sines) const;
  void add_across(const VisiblePieces& pieces, const Slice& slice, const SineWeights& weights,
                  const PiecePowers& powers, const SliceBins& bins) const;
  void add_to_sub_column(const VisiblePieces& pieces, const PiecePowers& powers, int i,
                         const Rows& rows, double share, int sub, const SliceBins& bins) const;
  Sweep sweep_of(const Slice& slice, const PiecePowers& powers, int i, const SliceBins& bins) const;

  const World& world_;
  const sensors::AntennaFrame& antenna_;
  const PowerTables& tables_;
};

}  // namespace fanbeam::renderer
