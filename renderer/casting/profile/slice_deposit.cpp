#include "renderer/casting/profile/slice_deposit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/casting/deposit.h"

namespace fanbeam::renderer {
namespace {

// Ranges in cells over which an oblique wall spreads: by its height and, at each height, over the
// wedge. Both evenly, which together makes a trapezoid.
struct WallSpread {
  double from, height, wedge;

  double to() const { return from + height + wedge; }
  // Of the wall, nearer than `place`.
  double share_before(double place) const {
    const auto ramp = [](double beyond) { return beyond > 0.0 ? beyond * beyond / 2 : 0.0; };
    const double x = place - from;
    return (ramp(x) - ramp(x - height) - ramp(x - wedge) + ramp(x - height - wedge)) /
           (height * wedge);
  }
};

WallSpread spread_of(const sensors::RangeGate& gate, const VisiblePieces& pieces,
                     const PiecePowers& powers, int i) {
  const double near_m = powers.near_range_m[i] - gate.minimum_m;
  const double far_m = powers.far_range_m[i] - gate.minimum_m;
  return {(std::min(near_m, far_m) + pieces.nearer_m[i]) / gate.cell_m,
          std::abs(far_m - near_m) / gate.cell_m,
          (pieces.farther_m[i] - pieces.nearer_m[i]) / gate.cell_m};
}

void deposit_wall(const WallSpread& spread, double power_W_per_rad, double* bins, int cells) {
  // Below it the trapezoid is a box, to the same part of a cell.
  constexpr double kThin = 1e-4;
  if (std::min(spread.height, spread.wedge) < kThin) {
    deposit(spread.from, spread.to(), power_W_per_rad, bins, cells);
    return;
  }
  const int first = std::max(static_cast<int>(std::floor(spread.from)), 0);
  const int last = std::min(static_cast<int>(std::floor(spread.to())), cells - 1);
  double before = spread.from < 0.0 ? spread.share_before(0.0) : 0.0;
  for (int cell = first; cell <= last; ++cell) {
    const double share = cell + 1.0 >= spread.to() ? 1.0 : spread.share_before(cell + 1.0);
    bins[cell] += std::max(share - before, 0.0) * power_W_per_rad;
    before = share;
  }
}

}  // namespace

void SliceDeposit::add(const VisiblePieces& pieces, const Slice& slice, const SineWeights& weights,
                       PiecePowers& powers, const SliceBins& bins) const {
  if (bins.across)
    add_across(pieces, slice, weights, powers, bins);
  else
    add_in_column(pieces, weights, powers, bins);
}

SliceDeposit::EndSines SliceDeposit::plane_sines(const VisiblePieces& pieces,
                                                 const SineWeights& weights,
                                                 const PiecePowers& powers, int i) const {
  const auto sine = [&](double distance_m, double height_m, double range_m) {
    return (weights.along * distance_m + weights.up * height_m) / range_m;
  };
  return {sine(pieces.near_distance_m[i], pieces.near_height_m[i], powers.near_range_m[i]),
          sine(pieces.far_distance_m[i], pieces.far_height_m[i], powers.far_range_m[i])};
}

// A cone's elevation is atan2(up, forward).
SliceDeposit::EndSines SliceDeposit::cone_sines(const VisiblePieces& pieces, const Slice& slice,
                                                int i) const {
  const auto sine = [&](double distance_m, double height_m) {
    const glm::dvec3 point(slice.along * distance_m, height_m);
    const double f = glm::dot(point, antenna_.forward), u = glm::dot(point, antenna_.up);
    return u / std::sqrt(f * f + u * u);
  };
  return {sine(pieces.near_distance_m[i], pieces.near_height_m[i]),
          sine(pieces.far_distance_m[i], pieces.far_height_m[i])};
}

// Of the power times R^3 over the elevations of piece i, from the higher of its ends to the lower one:
// dP/de R^3 goes with g^2 [sigma0 / sin(psi)] R (slice_power.h), and evenly from end to end. The far end
// is the lower one behind an antenna that looks straight down.
double SliceDeposit::tilt_of(const VisiblePieces& pieces, const PiecePowers& powers, int i,
                             const Rows& rows, const EndSines& sines) const {
  if (rows.low - rows.high <= 1.0) return 0.0;  // over two rows at most
  const double* const nrcs = tables_.nrcs() + pieces.material[i] * NrcsTable::kEntries;
  const double q_m = pieces.facet_m[i] / std::sqrt(pieces.facet_d2[i]);
  const auto density = [&](double sine, double range_m) {
    double share = 0.0;
    const double* const value = nrcs + NrcsTable::index_of(std::max(q_m / range_m, 0.0), share);
    return tables_.gain_at(sine) * (value[0] + share * (value[1] - value[0])) * range_m;
  };
  const double near = density(sines.near, powers.near_range_m[i]);
  const double far = density(sines.far, powers.far_range_m[i]);
  const double fall = sines.near < sines.far ? near - far : far - near;
  return near + far > 0.0 ? fall / (near + far) : 0.0;
}

void SliceDeposit::add_in_column(const VisiblePieces& pieces, const SineWeights& weights,
                                 PiecePowers& powers, const SliceBins& bins) const {
  double* range_bins = bins.range_W_per_rad;
  double* row_bins = bins.elevation_W_m3_per_rad;
  if (row_bins != nullptr)
    share_rows(world_.sensor.display.cscope_rows, world_.sensor.range.cells, powers);
  std::int32_t most = 0;
  for (int i = 0; i < powers.count; ++i) {
    range_bins[powers.before_cell[i]] += powers.before_W_per_rad[i];
    range_bins[powers.behind_cell[i]] += powers.behind_W_per_rad[i];
    most = std::max(most, powers.kind[i]);
    if (row_bins == nullptr) continue;
    const double part = powers.row_W_m3_per_rad[i] * powers.row_share[i];
    row_bins[powers.row[i]] += part;
    row_bins[powers.row[i] + 1] += powers.row_W_m3_per_rad[i] - part;
  }
  if (most < PiecePowers::wedge) return;
  for (int i = 0; i < powers.count; ++i)
    if (powers.kind[i] >= PiecePowers::wedge) add_special(pieces, weights, powers, i, bins);
}

void SliceDeposit::add_special(const VisiblePieces& pieces, const SineWeights& weights,
                               const PiecePowers& powers, int i, const SliceBins& bins) const {
  const sensors::RangeGate& gate = world_.sensor.range;
  const double power_W_per_rad = powers.before_W_per_rad[i] + powers.behind_W_per_rad[i];
  if (powers.kind[i] == PiecePowers::wedge) {
    const WallSpread spread = spread_of(gate, pieces, powers, i);
    if (spread.to() < 0.0 || spread.from >= gate.cells) return;
    deposit_wall(spread, power_W_per_rad, bins.range_W_per_rad, gate.cells);
  }
  if (bins.elevation_W_m3_per_rad == nullptr) return;
  const double range_m = powers.range_m[i];
  deposit(powers.high_row[i], powers.low_row[i], power_W_per_rad * range_m * range_m * range_m,
          bins.elevation_W_m3_per_rad + 1, world_.sensor.display.cscope_rows,
          tilt_of(pieces, powers, i, {powers.high_row[i], powers.low_row[i]},
                  plane_sines(pieces, weights, powers, i)));
}

// Where the wedge at the middle of piece i lies in the antenna's azimuth, from that point and its
// derivative by heading; the solid angle in the antenna's coordinates as in ray_caster.h.
SliceDeposit::Sweep SliceDeposit::sweep_of(const Slice& slice, const PiecePowers& powers, int i,
                                           const SliceBins& bins) const {
  const bool cone = world_.sensor.scan.surface == sensors::ScanSurface::cone;
  const double distance_m = powers.distance_m[i], range_m = powers.range_m[i];
  const glm::dvec3 clockwise(slice.along.y, -slice.along.x, 0.0);
  const glm::dvec3 point(slice.along * distance_m, powers.height_m[i]);
  const double f = glm::dot(point, antenna_.forward), r = glm::dot(point, antenna_.right);
  const double u = glm::dot(point, antenna_.up);
  if (f <= 0.0) return {};
  const double turn_f = distance_m * glm::dot(clockwise, antenna_.forward);
  const double turn_r = distance_m * glm::dot(clockwise, antenna_.right);
  const double level2 = f * f + r * r, upright = std::sqrt(f * f + u * u);
  const double azimuth_rad =
      cone ? std::asin(std::clamp(r / range_m, -1.0, 1.0)) : std::atan2(r, f);
  const double turn = cone ? turn_r / upright : (f * turn_r - r * turn_f) / level2;
  const double half_rad = std::abs(turn) * slice.width_rad / 2;
  return {
      (azimuth_rad - half_rad - bins.first_azimuth_rad) / bins.step_rad,
      (azimuth_rad + half_rad - bins.first_azimuth_rad) / bins.step_rad,
      cone ? distance_m / range_m * tables_.gain_at(u / upright) : distance_m / std::sqrt(level2)};
}

void SliceDeposit::add_across(const VisiblePieces& pieces, const Slice& slice,
                              const SineWeights& weights, const PiecePowers& powers,
                              const SliceBins& bins) const {
  const bool cone = world_.sensor.scan.surface == sensors::ScanSurface::cone;
  for (int i = 0; i < powers.count; ++i) {
    if (powers.kind[i] == PiecePowers::two_cells || powers.kind[i] == PiecePowers::many_cells)
      continue;
    const Sweep sweep = sweep_of(slice, powers, i, bins);
    if (!(sweep.solid_angle_ratio > 0.0)) continue;
    const EndSines sines =
        cone ? cone_sines(pieces, slice, i) : plane_sines(pieces, weights, powers, i);
    Rows rows{powers.high_row[i], powers.low_row[i]};
    if (cone) {
      const double near_row = tables_.row_at(sines.near), far_row = tables_.row_at(sines.far);
      rows = {std::min(near_row, far_row), std::max(near_row, far_row)};
    }
    rows.tilt = tilt_of(pieces, powers, i, rows, sines);
    const int first = std::max(static_cast<int>(std::floor(sweep.from)), 0);
    const int last = std::min(static_cast<int>(std::floor(sweep.to)), bins.sub_columns - 1);
    const double width = sweep.to - sweep.from;
    for (int sub = first; sub <= last; ++sub) {
      const double inside =
          std::min(sweep.to, sub + 1.0) - std::max(sweep.from, static_cast<double>(sub));
      // Of an antenna on its side the wedge may lie in one azimuth.
      const double share =
          width > 0.0 ? sweep.solid_angle_ratio * inside / width : sweep.solid_angle_ratio;
      add_to_sub_column(pieces, powers, i, rows, share, sub, bins);
    }
  }
}

void SliceDeposit::add_to_sub_column(const VisiblePieces& pieces, const PiecePowers& powers, int i,
                                     const Rows& rows, double share, int sub,
                                     const SliceBins& bins) const {
  if (!(share * (powers.before_W_per_rad[i] + powers.behind_W_per_rad[i]) > 0.0)) return;
  const sensors::RangeGate& gate = world_.sensor.range;
  const auto column = static_cast<std::size_t>(sub);
  bins.reached[column] = 1;
  double* range_bins = bins.range_W_per_rad + column * static_cast<std::size_t>(gate.cells);
  double power_W_per_rad = 0.0;
  if (powers.kind[i] == PiecePowers::wedge) {
    const WallSpread spread = spread_of(gate, pieces, powers, i);
    if (spread.to() < 0.0 || spread.from >= gate.cells) return;
    power_W_per_rad = share * (powers.before_W_per_rad[i] + powers.behind_W_per_rad[i]);
    deposit_wall(spread, power_W_per_rad, range_bins, gate.cells);
  } else {
    const auto put = [&](std::int32_t cell, double part_W_per_rad) {
      if (cell >= gate.cells) return;
      range_bins[cell] += share * part_W_per_rad;
      power_W_per_rad += share * part_W_per_rad;
    };
    put(powers.before_cell[i], powers.before_W_per_rad[i]);
    put(powers.behind_cell[i], powers.behind_W_per_rad[i]);
  }
  if (bins.elevation_W_m3_per_rad == nullptr) return;
  const int row_count = world_.sensor.display.cscope_rows;
  const double range_m = powers.range_m[i];
  deposit(rows.high, rows.low, power_W_per_rad * range_m * range_m * range_m,
          bins.elevation_W_m3_per_rad + column * static_cast<std::size_t>(row_count), row_count,
          rows.tilt);
}

}  // namespace fanbeam::renderer
