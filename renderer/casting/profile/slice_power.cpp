#include "renderer/casting/profile/slice_power.h"

#include <algorithm>
#include <cmath>

namespace fanbeam::renderer {

// What lies between two shares of the way along piece `piece`, all of it in one cell.
struct SlicePower::Part {
  const VisiblePieces& pieces;
  int piece;
  double from, to;
  int cell;
};

SlicePower::SlicePower(const World& world, const sensors::AntennaFrame& antenna,
                       const PowerTables& tables, const PathLossTable& path_loss)
    : world_(world),
      antenna_(antenna),
      tables_(tables),
      path_loss_(path_loss),
      deposit_(world, antenna, tables),
      radar_constant_W_m2_(world.sensor.radar_constant_W_m2()),
      most_rad_(most_elevation_rad(world.sensor.antenna.elevation.half_power_width_rad)) {}

void SlicePower::add(const Slice& slice, VisiblePieces& pieces, const SliceBins& bins) {
  integrate(world_.sensor.range, most_rad_, pieces, powers_);
  cut(slice, pieces, bins);
  finish(slice, pieces, powers_, bins);
  pieces.count = 0;
  if (parts_.count > 0) finish_parts(slice, bins);
}

void SlicePower::finish_parts(const Slice& slice, const SliceBins& bins) {
  integrate(world_.sensor.range, most_rad_, parts_, part_powers_);
  std::fill_n(part_powers_.kind.begin(), parts_.count, PiecePowers::plain);
  std::copy_n(part_cell_.begin(), parts_.count, part_powers_.before_cell.begin());
  std::copy_n(part_cell_.begin(), parts_.count, part_powers_.behind_cell.begin());
  finish(slice, parts_, part_powers_, bins);
  parts_.count = 0;
}

// All but the integrals, which decide what is cut.
void SlicePower::finish(const Slice& slice, const VisiblePieces& pieces, PiecePowers& powers,
                        const SliceBins& bins) {
  const SineWeights weights{slice.along.x * antenna_.up.x + slice.along.y * antenna_.up.y,
                            antenna_.up.z};
  // A cone's elevation is no matter of the slice alone: SliceDeposit finds it.
  const bool cone = world_.sensor.scan.surface == sensors::ScanSurface::cone;
  weigh(tables_, cone ? tables_.even_gain() : tables_.gain(), weights,
        radar_constant_W_m2_ * bins.weight, pieces, powers);
  if (!path_loss_.clear()) lose_on_path(path_loss_, antenna_.position_m.z, powers);
  if (world_.rain_cells) lose_in_rain_cells(slice, powers);
  if (bins.elevation_W_m3_per_rad != nullptr) place_in_rows(tables_, weights, pieces, powers);
  deposit_.add(pieces, slice, weights, powers, bins);
}

void SlicePower::lose_in_rain_cells(const Slice& slice, PiecePowers& powers) const {
  const glm::dvec2 from_m(antenna_.position_m);
  if (!world_.rain_cells->stand_between(from_m,
                                        from_m + slice.along * world_.sensor.range.maximum_m()))
    return;
  for (int i = 0; i < powers.count; ++i) {
    const double factor = world_.rain_cells->two_way_power_factor(
        antenna_.position_m,
        antenna_.position_m + glm::dvec3(slice.along * powers.distance_m[i], powers.height_m[i]));
    powers.before_W_per_rad[i] *= factor;
    powers.behind_W_per_rad[i] *= factor;
  }
}

void SlicePower::cut(const Slice& slice, const VisiblePieces& pieces, const SliceBins& bins) {
  const sensors::RangeGate& gate = world_.sensor.range;
  std::uint64_t blanked = 0;
  for (int i = 0; i < pieces.count; ++i) {
    const bool too_near = powers_.near_range_m[i] < gate.minimum_m;
    blanked += too_near && powers_.far_range_m[i] < gate.minimum_m ? 1 : 0;
    if (powers_.kind[i] == PiecePowers::two_cells) {
      const double border = powers_.border_share[i];
      put(slice, {pieces, i, 0.0, border, powers_.before_cell[i]}, bins);
      put(slice, {pieces, i, border, 1.0, powers_.behind_cell[i]}, bins);
      powers_.before_cell[i] = powers_.behind_cell[i] = gate.cells;
    } else if (powers_.kind[i] == PiecePowers::many_cells) {
      cut_at_cells(slice, pieces, i, bins);
    }
  }
  blanked_ += blanked;
}

void SlicePower::put(const Slice& slice, const Part& part, const SliceBins& bins) {
  const VisiblePieces& pieces = part.pieces;
  const int i = part.piece;
  const double near_m = pieces.near_distance_m[i], near_height_m = pieces.near_height_m[i];
  const double step_m = pieces.far_distance_m[i] - near_m;
  const double rise_m = pieces.far_height_m[i] - near_height_m;
  // A sliver that rounding leaves no length is none.
  const bool some = near_m + part.from * step_m != near_m + part.to * step_m ||
                    near_height_m + part.from * rise_m != near_height_m + part.to * rise_m;
  if (!(part.to > part.from) || !some) return;
  const sensors::RangeGate& gate = world_.sensor.range;
  const double cell_from_m = gate.minimum_m + gate.cell_m * part.cell;
  const int count =
      parts_of(pieces.cross_m2[i] * (part.to - part.from), cell_from_m * cell_from_m, most_rad_);
  const double share = (part.to - part.from) / count;
  for (int k = 0; k < count; ++k) {
    const double from = part.from + share * k;
    const double to = k + 1 == count ? part.to : part.from + share * (k + 1);
    const int n = parts_.count++;
    parts_.near_distance_m[n] = near_m + from * step_m;
    parts_.near_height_m[n] = near_height_m + from * rise_m;
    parts_.far_distance_m[n] = near_m + to * step_m;
    parts_.far_height_m[n] = near_height_m + to * rise_m;
    parts_.cross_m2[n] = pieces.cross_m2[i] * (to - from);
    parts_.facet_m[n] = pieces.facet_m[i];
    parts_.facet_d2[n] = pieces.facet_d2[i];
    parts_.material[n] = pieces.material[i];
    parts_.nearer_m[n] = parts_.farther_m[n] = 0.0;
    parts_.share[n] = pieces.share[i];
    part_cell_[n] = part.cell;
    if (parts_.full()) finish_parts(slice, bins);
  }
}

void SlicePower::cut_at_cells(const Slice& slice, const VisiblePieces& pieces, int i,
                              const SliceBins& bins) {
  const sensors::RangeGate& gate = world_.sensor.range;
  const double near_m = pieces.near_distance_m[i], near_height_m = pieces.near_height_m[i];
  const double step_m = pieces.far_distance_m[i] - near_m;
  const double rise_m = pieces.far_height_m[i] - near_height_m;
  const double length2_m2 = step_m * step_m + rise_m * rise_m;
  const double p_m = pieces.cross_m2[i] / std::sqrt(length2_m2);
  if (!(p_m > 0.0)) return;
  // In lengths of the piece: its near end from the foot, and how far it is cut.
  const double start = (near_m * step_m + near_height_m * rise_m) / length2_m2;
  double at = 0.0;
  const auto put_until = [&](double next, int cell) {
    if (cell >= 0 && cell < gate.cells) put(slice, {pieces, i, at, next, cell}, bins);
    at = next;
  };
  const auto cut_until = [&](double end, int first, int last, double sign) {
    const int direction = last > first ? 1 : -1;
    for (int cell = first; cell != last; cell += direction) {
      const double border_m = gate.minimum_m + gate.cell_m * (direction > 0 ? cell + 1 : cell);
      const double from_foot2 = std::max((border_m * border_m - p_m * p_m) / length2_m2, 0.0);
      put_until(std::clamp(sign * std::sqrt(from_foot2) - start, at, end), cell);
    }
    put_until(end, last);
  };
  const auto cell_at = [&](double range_m) {
    const double place = (range_m - gate.minimum_m) / gate.cell_m;
    return static_cast<int>(std::floor(std::clamp(place, -1.0, static_cast<double>(gate.cells))));
  };
  const int first = cell_at(powers_.near_range_m[i]), last = cell_at(powers_.far_range_m[i]);
  if (start < 0.0 && start > -1.0) {
    const int foot = cell_at(p_m);
    cut_until(-start, first, foot, -1.0);
    cut_until(1.0, foot, last, 1.0);
  } else {
    cut_until(1.0, first, last, start < 0.0 ? -1.0 : 1.0);
  }
}

}  // namespace fanbeam::renderer
