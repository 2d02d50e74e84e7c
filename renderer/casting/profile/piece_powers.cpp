#include "renderer/casting/profile/piece_powers.h"

#include <cmath>

#include "core/dispatch.h"
#include "core/series.h"
#include "renderer/casting/profile/piece_loops.h"

namespace fanbeam::renderer {
namespace {

constexpr double kLeast_m2 = 1e-12;
constexpr double kNoLength_m2 = 1e-30;  // a piece of no length then sends nothing back, not NaN
// Elevation below which one middle does for a piece on both sides of a cell's border.
constexpr double kSmallTurn_rad = 7e-4;

// Square of the range in the middle between two places on a piece's line. A line through the sensor
// sends nothing back, not even from its foot.
inline double middle_range2_m2(double p_m, double s1_m, double s2_m) {
  const double middle_m = (s1_m + s2_m) / 2;
  const double square_m2 = p_m * p_m + middle_m * middle_m;
  return square_m2 > kLeast_m2 ? square_m2 : kLeast_m2;
}

// integral of p ds / (p^2 + s^2)^2, slice_power.h; `inverse_per_m2` is that of middle_range2_m2.
inline double solid_integral_per_m2(double p_m, double s1_m, double s2_m, double inverse_per_m2) {
  const double middle_m = (s1_m + s2_m) / 2, length_m = s2_m - s1_m;
  const double cosine2 = middle_m * middle_m * inverse_per_m2;
  const double x = length_m * length_m / 4 * inverse_per_m2;
  const double c2 = 12.0 * cosine2 - 2.0;
  const double c4 = (80.0 * cosine2 - 48.0) * cosine2 + 3.0;
  const double series = 1.0 + x * (c2 / 3 + x * (c4 / 5));
  return length_m * p_m * inverse_per_m2 * inverse_per_m2 * series;
}

constexpr double kPlain = PiecePowers::plain, kTwoCells = PiecePowers::two_cells,
                 kManyCells = PiecePowers::many_cells, kWedge = PiecePowers::wedge;

// The cells of a piece's ends, of `cells` in the gate, and whether it passes the point nearest to the
// sensor: 2 or 0, for sums.
struct Reach {
  double near_cell, far_cell, cells, turns;
};

// PiecePowers::Kind as a real number. `spread_m`: how far a wall's ranges differ over the wedge.
inline double kind_of(const Reach& reach, double cross_m2, double nearest2_m2, double spread_m,
                      double most_rad) {
  const double c1 = reach.near_cell, c2 = reach.far_cell;
  const double least = c1 < c2 ? c1 : c2, most = c1 < c2 ? c2 : c1;
  const double apart = most - least;
  // The ends of the gate are cut off exactly.
  const double enters = least < 0.0 ? apart : 0.0, leaves = most >= reach.cells ? apart : 0.0;
  // So are pieces close by, where pattern and NRCS differ from one half to the other.
  const double small_rad = most_rad / 2 < kSmallTurn_rad ? most_rad / 2 : kSmallTurn_rad;
  const double halves = cross_m2 > small_rad * nearest2_m2 ? apart : 0.0;
  const double parts = cross_m2 > most_rad * nearest2_m2 ? 2.0 : 0.0;
  const double in_gate = most >= 0.0 && least < reach.cells ? 1.0 : 0.0;
  const double cuts = (apart + reach.turns + enters + leaves + parts) * in_gate;
  const double cut = cuts > 1.0 ? kManyCells : kTwoCells;
  const double straight = cuts + halves * in_gate > 1.0 ? cut : kPlain;
  return (spread_m > 0.0 ? apart : 0.0) > 0.0 ? kWedge : straight;
}

}  // namespace

// NOLINTNEXTLINE(readability-function-size): a loop that was measured as it stands.
FANBEAM_HOT(void, integrate,
            (const sensors::RangeGate& gate, double most_rad, const VisiblePieces& pieces,
             PiecePowers& powers),
            (gate, most_rad, pieces, powers)) {
  const In near_distance_m = pieces.near_distance_m.data();
  const In near_height_m = pieces.near_height_m.data();
  const In far_distance_m = pieces.far_distance_m.data();
  const In far_height_m = pieces.far_height_m.data();
  const In nearer_m = pieces.nearer_m.data(), farther_m = pieces.farther_m.data();
  const In cross_m2 = pieces.cross_m2.data(), share = pieces.share.data();
  const Out near_range_m = powers.near_range_m.data(), far_range_m = powers.far_range_m.data();
  const Out before_per_m2 = powers.before_W_per_rad.data();
  const Out behind_per_m2 = powers.behind_W_per_rad.data();
  const Out border_share = powers.border_share.data();
  const Out distance_m = powers.distance_m.data(), height_m = powers.height_m.data();
  std::int32_t* kind = powers.kind.data();
  std::int32_t* before_cell = powers.before_cell.data();
  std::int32_t* behind_cell = powers.behind_cell.data();
  const double minimum_m = gate.minimum_m, cell_m = gate.cell_m, per_m = 1.0 / gate.cell_m;
  const double cells = gate.cells;  // also the sink's number
  const int count = pieces.count;
  FANBEAM_INDEPENDENT
  for (int i = 0; i < count; ++i) {
    const double d1_m = near_distance_m[i], z1_m = near_height_m[i];
    const double d2_m = far_distance_m[i], z2_m = far_height_m[i];
    const double step_d_m = d2_m - d1_m, step_z_m = z2_m - z1_m;
    const double range1_m = std::sqrt(d1_m * d1_m + z1_m * z1_m);
    const double range2_m = std::sqrt(d2_m * d2_m + z2_m * z2_m);
    // With what a wall takes in the wedge beyond its ranges here.
    const double more1_m = range1_m < range2_m ? nearer_m[i] : farther_m[i];
    const double more2_m = range1_m < range2_m ? farther_m[i] : nearer_m[i];
    // Cells beyond the gate need no number of their own.
    const double f1 = std::floor((range1_m + more1_m - minimum_m) * per_m);
    const double f2 = std::floor((range2_m + more2_m - minimum_m) * per_m);
    const double h1 = f1 < cells ? f1 : cells, h2 = f2 < cells ? f2 : cells;
    const double c1 = h1 > -1.0 ? h1 : -1.0, c2 = h2 > -1.0 ? h2 : -1.0;
    const double square_m2 = step_d_m * step_d_m + step_z_m * step_z_m;
    const double length2_m2 = square_m2 > kNoLength_m2 ? square_m2 : kNoLength_m2;
    const double per_length = 1.0 / std::sqrt(length2_m2);
    const double crossed_m = cross_m2[i] * per_length;
    const double p_m = crossed_m > 0.0 ? crossed_m : 0.0;
    // Along the line from the point nearest to the sensor.
    const double s1_m = (d1_m * step_d_m + z1_m * step_z_m) * per_length;
    const double s2_m = s1_m + length2_m2 * per_length;
    const double border_m = minimum_m + cell_m * (c1 > c2 ? c1 : c2);
    const double to_border_m2 = border_m * border_m - p_m * p_m;
    // A root of both signs: the compiler takes it before it chooses.
    const double root_m = std::sqrt(std::abs(to_border_m2));
    const double to_border_m = to_border_m2 > 0.0 ? root_m : 0.0;
    const double crossing_m = s1_m + s2_m > 0.0 ? to_border_m : -to_border_m;
    const double not_behind_m = crossing_m < s2_m ? crossing_m : s2_m;
    const double between_m = not_behind_m > s1_m ? not_behind_m : s1_m;
    const double split_m = c1 == c2 ? s2_m : between_m;
    // Both inverses from one division.
    const double before_m2 = middle_range2_m2(p_m, s1_m, split_m);
    const double behind_m2 = middle_range2_m2(p_m, split_m, s2_m);
    const double inverse_per_m4 = 1.0 / (before_m2 * behind_m2);
    before_per_m2[i] =
        share[i] * solid_integral_per_m2(p_m, s1_m, split_m, inverse_per_m4 * behind_m2);
    behind_per_m2[i] =
        share[i] * solid_integral_per_m2(p_m, split_m, s2_m, inverse_per_m4 * before_m2);
    border_share[i] = (split_m - s1_m) * per_length;
    near_range_m[i] = range1_m;
    far_range_m[i] = range2_m;
    const double nearest_m = range1_m < range2_m ? range1_m : range2_m;
    const Reach reach{c1, c2, cells, s1_m * s2_m < 0.0 ? 2.0 : 0.0};
    const double found =
        kind_of(reach, cross_m2[i], nearest_m * nearest_m, farther_m[i] - nearer_m[i], most_rad);
    kind[i] = static_cast<std::int32_t>(found);
    // What is not plain goes elsewhere later; that in two cells still tells which.
    const double limit = found > kTwoCells ? 0.0 : cells;
    // Sums wait for each other less where the cell behind is another one, even for nothing.
    const double behind = c1 == c2 ? c1 + 1.0 : c2;
    const double in1 = c1 >= 0.0 ? c1 : cells, in2 = c2 >= 0.0 ? behind : cells;
    before_cell[i] = static_cast<std::int32_t>(in1 < limit ? in1 : cells);
    behind_cell[i] = static_cast<std::int32_t>(in2 < limit ? in2 : cells);
    distance_m[i] = (d1_m + d2_m) / 2;
    height_m[i] = (z1_m + z2_m) / 2;
  }
  powers.count = count;
}

FANBEAM_HOT(void, weigh,
            (const PowerTables& tables, const double* gain, const SineWeights& weights,
             double constant_W_m2, const VisiblePieces& pieces, PiecePowers& powers),
            (tables, gain, weights, constant_W_m2, pieces, powers)) {
  const In facet_m = pieces.facet_m.data(), facet_d2 = pieces.facet_d2.data();
  const std::int32_t* material = pieces.material.data();
  const In distance_m = powers.distance_m.data(), height_m = powers.height_m.data();
  const Out before = powers.before_W_per_rad.data(), behind = powers.behind_W_per_rad.data();
  const Out range_m = powers.range_m.data();
  const In nrcs = tables.nrcs();
  const double along = weights.along, up = weights.up;
  const double lowest_sine = tables.lowest_sine(), per_sine = tables.steps_per_sine();
  constexpr double kLastStep = PowerTables::kSineSteps;
  const int count = pieces.count;
  FANBEAM_INDEPENDENT
  for (int i = 0; i < count; ++i) {
    const double d_m = distance_m[i], z_m = height_m[i];
    const double range2_m2 = d_m * d_m + z_m * z_m;
    const double range = std::sqrt(range2_m2), tilt = std::sqrt(facet_d2[i]);
    const double per_both = 1.0 / (range * tilt);
    const double per_range = per_both * tilt;
    range_m[i] = range;
    const double grazing = facet_m[i] * per_both;
    double nrcs_share = 0.0;
    const int entry = material[i] * NrcsTable::kEntries +
                      NrcsTable::index_of(grazing > 0.0 ? grazing : 0.0, nrcs_share);
    const double sigma0_over_sine = nrcs[entry] + nrcs_share * (nrcs[entry + 1] - nrcs[entry]);
    const double at = ((along * d_m + up * z_m) * per_range - lowest_sine) * per_sine;
    const double above = at > 0.0 ? at : 0.0;
    const double position = above < kLastStep ? above : kLastStep;
    const int step = static_cast<int>(position);
    const double factor = constant_W_m2 * sigma0_over_sine *
                          (gain[step] + (position - step) * (gain[step + 1] - gain[step]));
    before[i] *= factor;
    behind[i] *= factor;
  }
}

FANBEAM_HOT(void, lose_on_path,
            (const PathLossTable& path_loss, double sensor_height_m, PiecePowers& powers),
            (path_loss, sensor_height_m, powers)) {
  const In height_m = powers.height_m.data(), range_m = powers.range_m.data();
  const Out before = powers.before_W_per_rad.data(), behind = powers.behind_W_per_rad.data();
  const int count = powers.count;
  FANBEAM_INDEPENDENT
  for (int i = 0; i < count; ++i) {
    const double factor = path_loss.lossy_factor(height_m[i] + sensor_height_m, range_m[i]);
    before[i] *= factor;
    behind[i] *= factor;
  }
}

}  // namespace fanbeam::renderer
