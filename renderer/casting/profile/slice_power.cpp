#include "renderer/casting/profile/slice_power.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/dispatch.h"
#include "renderer/casting/deposit.h"
#include "renderer/casting/nrcs_table.h"

namespace fanbeam::renderer {
namespace {

using Real = VisiblePieces::Column<double>;

struct PieceRoots {
  alignas(64) Real near_range_m, far_range_m, in_plane_m, facet_m;
};

// Plain loops over whole arrays: the compiler makes vector code of them.
FANBEAM_HOT void take_roots(const VisiblePieces& pieces, PieceRoots& roots) {
  for (int i = 0; i < pieces.count; ++i) {
    roots.near_range_m[i] = std::sqrt(pieces.near_distance_m[i] * pieces.near_distance_m[i] +
                                      pieces.near_height_m[i] * pieces.near_height_m[i]);
    roots.far_range_m[i] = std::sqrt(pieces.far_distance_m[i] * pieces.far_distance_m[i] +
                                     pieces.far_height_m[i] * pieces.far_height_m[i]);
    roots.in_plane_m[i] = pieces.in_plane_n_m[i] / std::sqrt(pieces.in_plane_d2[i]);
    roots.facet_m[i] = pieces.facet_n_m[i] / std::sqrt(pieces.facet_d2[i]);
  }
}

// Sine of the antenna's elevation of a point of the slice is (along d + up z) / R.
struct SineWeights {
  double along, up;
};

struct LookUps {
  const double* nrcs;
  const double* gain;
  const double* row;
  double lowest_sine, steps_per_sine;
};

FANBEAM_HOT void evaluate(const LookUps& tables, const SineWeights& weights, double constant,
                          PieceCuts& cuts) {
  constexpr double kLastStep = PowerTables::kSineSteps - 1e-6;
  for (int i = 0; i < cuts.count; ++i) {
    const double d1 = cuts.near_distance_m[i], z1 = cuts.near_height_m[i];
    const double d2 = cuts.far_distance_m[i], z2 = cuts.far_height_m[i];
    const double square1 = d1 * d1 + z1 * z1, square2 = d2 * d2 + z2 * z2;
    const double length2 = (d2 - d1) * (d2 - d1) + (z2 - z1) * (z2 - z1);
    const double p = cuts.in_plane_m[i];
    const double d = (d1 + d2) / 2, z = (z1 + z2) / 2;
    const double middle2 = d * d + z * z;
    const double inverse2 = 1.0 / middle2;
    const double range = std::sqrt(middle2);
    const double along = (square2 - square1) / 2;  // s_m times the length
    const double cosine2 = along * along * inverse2 / length2;
    const double x = length2 / 4 * inverse2;
    const double c2 = 12.0 * cosine2 - 2.0;
    const double c4 = (80.0 * cosine2 - 48.0) * cosine2 + 3.0;
    const double c6 = ((448.0 * cosine2 - 480.0) * cosine2 + 120.0) * cosine2 - 4.0;
    const double series = 1.0 + x * (c2 / 3 + x * (c4 / 5 + x * (c6 / 7)));
    const double integral = std::sqrt(length2) * p * inverse2 * inverse2 * series;

    const double sine = std::min(cuts.facet_m[i] / range, 1.0);
    const bool fine = sine < PowerTables::kFineBelow;
    const double position = sine * (fine ? PowerTables::kFineSteps / PowerTables::kFineBelow
                                         : PowerTables::kNrcsSteps);
    const int index = static_cast<int>(position);
    const int entry = cuts.material[i] * PowerTables::kNrcsStride + index +
                      (fine ? PowerTables::kFirstFine : 0);
    const double share = position - index;
    const double nrcs =
        tables.nrcs[entry] + share * (tables.nrcs[entry + 1] - tables.nrcs[entry]);

    const auto step_of = [&](double elevation_sine) {
      return std::min(
          std::max((elevation_sine - tables.lowest_sine) * tables.steps_per_sine, 0.0), kLastStep);
    };
    const double step = step_of((weights.along * d + weights.up * z) / range);
    const int s = static_cast<int>(step);
    const double gain = tables.gain[s] + (step - s) * (tables.gain[s + 1] - tables.gain[s]);
    const double step1 = step_of((weights.along * d1 + weights.up * z1) / std::sqrt(square1));
    const int s1 = static_cast<int>(step1);
    const double row1 = tables.row[s1] + (step1 - s1) * (tables.row[s1 + 1] - tables.row[s1]);
    const double step2 = step_of((weights.along * d2 + weights.up * z2) / std::sqrt(square2));
    const int s2 = static_cast<int>(step2);
    const double row2 = tables.row[s2] + (step2 - s2) * (tables.row[s2 + 1] - tables.row[s2]);

    cuts.middle_distance_m[i] = d;
    cuts.middle_height_m[i] = z;
    cuts.range_m[i] = range;
    cuts.power_W_per_rad[i] = constant * gain * nrcs * integral;
    cuts.first_row[i] = std::min(row1, row2);
    cuts.last_row[i] = std::max(row1, row2);
  }
}

}  // namespace

PowerTables::PowerTables(const World& world) {
  for (const materials::NrcsCurve& curve : world.nrcs) {
    const NrcsTable table(curve);
    const std::size_t first = nrcs_.size();
    nrcs_.resize(first + kNrcsStride);
    constexpr double kTiny = 1e-12;  // the table holds its value below the first step
    for (int i = 0; i <= kNrcsSteps + 1; ++i)
      nrcs_[first + static_cast<std::size_t>(i)] = table.sigma0_over_sine(
          std::clamp(static_cast<double>(i) / kNrcsSteps, kTiny, 1.0));
    for (int i = 0; i <= kFineSteps; ++i)
      nrcs_[first + static_cast<std::size_t>(kFirstFine + i)] =
          table.sigma0_over_sine(std::max(kFineBelow * i / kFineSteps, kTiny));
  }
  const sensors::Antenna& antenna = world.sensor.antenna;
  const sensors::Display& display = world.sensor.display;
  const sensors::TwoWayTable gain(antenna.elevation);
  const double reach_rad = sensors::reach_rad(antenna.elevation);
  const double lowest_rad = std::max(antenna.boresight_elevation_rad - reach_rad, -core::kPi / 2);
  const double highest_rad = std::min(antenna.boresight_elevation_rad + reach_rad, core::kPi / 2);
  lowest_sine_ = std::sin(lowest_rad);
  steps_per_sine_ = kSineSteps / (std::sin(highest_rad) - lowest_sine_);
  for (int i = 0; i <= kSineSteps + 1; ++i) {
    const double sine =
        std::clamp(lowest_sine_ + std::min(i, kSineSteps) / steps_per_sine_, -1.0, 1.0);
    const double elevation_rad = std::asin(sine);
    // Nothing beyond the pattern: what lies there is held to the first and last entry.
    const bool edge = i == 0 || i >= kSineSteps;
    gain_.push_back(edge ? 0.0 : gain(elevation_rad - antenna.boresight_elevation_rad));
    row_.push_back((display.cscope_top_rad - elevation_rad) * display.cscope_rows /
                   display.cscope_span_rad);
  }
}

SlicePower::SlicePower(const World& world, const sensors::AntennaFrame& antenna,
                       const PowerTables& tables, const PathLossTable& path_loss)
    : world_(world),
      antenna_(antenna),
      tables_(tables),
      path_loss_(path_loss),
      radar_constant_W_m2_(world.sensor.radar_constant_W_m2()) {}

void SlicePower::add(const Slice& slice, VisiblePieces& pieces, PieceCuts& cuts,
                     const SliceBins& bins) {
  PieceRoots roots;
  take_roots(pieces, roots);
  const sensors::RangeGate& gate = world_.sensor.range;
  const double per_m = 1.0 / gate.cell_m;
  for (int i = 0; i < pieces.count; ++i) {
    double d1 = pieces.near_distance_m[i], z1 = pieces.near_height_m[i];
    const double d2 = pieces.far_distance_m[i], z2 = pieces.far_height_m[i];
    const double p = roots.in_plane_m[i];
    if (!(p > 0.0)) continue;
    const double k1 = (roots.near_range_m[i] - gate.minimum_m) * per_m;
    const double k2 = (roots.far_range_m[i] - gate.minimum_m) * per_m;
    const auto put = [&](double from_d, double from_z, double to_d, double to_z, double from_cell,
                         double to_cell) {
      if (from_d == to_d && from_z == to_z) return;
      const int n = cuts.count++;
      cuts.near_distance_m[n] = from_d;
      cuts.near_height_m[n] = from_z;
      cuts.far_distance_m[n] = to_d;
      cuts.far_height_m[n] = to_z;
      cuts.in_plane_m[n] = p;
      cuts.facet_m[n] = roots.facet_m[i];
      cuts.from_cell[n] = from_cell;
      cuts.to_cell[n] = to_cell;
      cuts.material[n] = pieces.material[i];
      if (cuts.count == PieceCuts::kCapacity) flush(cuts, slice, bins);
    };
    if (std::min(k1, k2) < 0.0) ++blanked_;
    if (pieces.farther_m[i] - pieces.nearer_m[i] > 0.0) {
      const double low = std::min(k1, k2) + pieces.nearer_m[i] * per_m;
      const double high = std::max(k1, k2) + pieces.farther_m[i] * per_m;
      if (high >= 0.0 && low < gate.cells) put(d1, z1, d2, z2, low, high);
      continue;
    }
    const double step_d = d2 - d1, step_z = z2 - z1;
    const double length2 = step_d * step_d + step_z * step_z;
    // Along the line from its nearest point: s, in units of the piece's length.
    const double s1 = (d1 * step_d + z1 * step_z) / length2;
    const bool foot_inside = s1 < 0.0 && s1 > -1.0;
    if (!foot_inside && std::floor(k1) == std::floor(k2)) {
      if (k1 >= 0.0 && k1 < gate.cells) put(d1, z1, d2, z2, k1, k2);
      continue;
    }
    // Cut at the borders of cells, nearest point first where the piece holds it.
    double at = 0.0;
    const auto cut_until = [&](double end, double k_from, double k_to, double sign) {
      const int first = static_cast<int>(std::floor(k_from));
      const int last = static_cast<int>(std::floor(k_to));
      const int direction = last > first ? 1 : -1;
      for (int cell = first;; cell += direction) {
        double next = end;
        if (cell != last) {
          const double border_m = gate.minimum_m + gate.cell_m * (direction > 0 ? cell + 1 : cell);
          const double s2 = (border_m * border_m - p * p) / length2;
          next = std::clamp(sign * std::sqrt(std::max(s2, 0.0)) - s1, at, end);
        }
        if (next > at && cell >= 0 && cell < gate.cells)
          put(d1 + at * step_d, z1 + at * step_z, d1 + next * step_d, z1 + next * step_z,
              cell + 0.5, cell + 0.5);
        at = next;
        if (cell == last) return;
      }
    };
    if (foot_inside) {
      const double k0 = (p - gate.minimum_m) * per_m;
      cut_until(-s1, k1, k0, -1.0);
      cut_until(1.0, k0, k2, 1.0);
    } else {
      cut_until(1.0, k1, k2, s1 < 0.0 ? -1.0 : 1.0);
    }
  }
  pieces.count = 0;
  flush(cuts, slice, bins);
}

void SlicePower::flush(PieceCuts& cuts, const Slice& slice, const SliceBins& bins) {
  const SineWeights weights{
      slice.along.x * antenna_.up.x + slice.along.y * antenna_.up.y, antenna_.up.z};
  evaluate({tables_.nrcs(), tables_.gain(), tables_.row(), tables_.lowest_sine(),
            tables_.steps_per_sine()},
           weights, radar_constant_W_m2_ * bins.weight, cuts);
  lose_on_path(slice, cuts);
  if (bins.across)
    deposit_across(cuts, slice, bins);
  else
    deposit_in_column(cuts, bins);
  cuts.count = 0;
}

void SlicePower::lose_on_path(const Slice& slice, PieceCuts& cuts) const {
  if (!path_loss_.clear()) {
    const double sensor_m = antenna_.position_m.z;
    for (int i = 0; i < cuts.count; ++i)
      cuts.power_W_per_rad[i] *=
          path_loss_.two_way_factor(cuts.middle_height_m[i] + sensor_m, cuts.range_m[i]);
  }
  if (!world_.rain_cells) return;
  for (int i = 0; i < cuts.count; ++i)
    cuts.power_W_per_rad[i] *= world_.rain_cells->two_way_power_factor(
        antenna_.position_m,
        antenna_.position_m + glm::dvec3(slice.along * cuts.middle_distance_m[i],
                                         cuts.middle_height_m[i]));
}

void SlicePower::deposit_in_column(const PieceCuts& cuts, const SliceBins& bins) const {
  const int cells = world_.sensor.range.cells;
  const int rows = world_.sensor.display.cscope_rows;
  for (int i = 0; i < cuts.count; ++i)
    deposit(cuts.from_cell[i], cuts.to_cell[i], cuts.power_W_per_rad[i], bins.range_W_per_rad,
            cells);
  if (bins.elevation_W_m3_per_rad == nullptr) return;
  for (int i = 0; i < cuts.count; ++i) {
    const double range_m = cuts.range_m[i];
    deposit(cuts.first_row[i], cuts.last_row[i],
            cuts.power_W_per_rad[i] * range_m * range_m * range_m, bins.elevation_W_m3_per_rad,
            rows);
  }
}

// Where the wedge at this point lies in the antenna's azimuth, from its middle and its derivative
// by heading; the solid angle in the antenna's coordinates as in ray_caster.h.
void SlicePower::deposit_across(const PieceCuts& cuts, const Slice& slice,
                                const SliceBins& bins) const {
  const bool cone = world_.sensor.scan.surface == sensors::ScanSurface::cone;
  const int cells = world_.sensor.range.cells;
  const int rows = world_.sensor.display.cscope_rows;
  const glm::dvec3 along(slice.along, 0.0);
  const glm::dvec3 clockwise(slice.along.y, -slice.along.x, 0.0);
  for (int i = 0; i < cuts.count; ++i) {
    const double distance_m = cuts.middle_distance_m[i], range_m = cuts.range_m[i];
    const glm::dvec3 point = along * distance_m + glm::dvec3(0.0, 0.0, cuts.middle_height_m[i]);
    const double f = glm::dot(point, antenna_.forward), r = glm::dot(point, antenna_.right);
    const double u = glm::dot(point, antenna_.up);
    if (f <= 0.0) continue;
    const double turn_f = distance_m * glm::dot(clockwise, antenna_.forward);
    const double turn_r = distance_m * glm::dot(clockwise, antenna_.right);
    const double lateral_m = std::sqrt(f * f + u * u);
    const double level2 = f * f + r * r;
    const double azimuth_rad = cone ? std::asin(r / range_m) : std::atan2(r, f);
    const double turn = cone ? turn_r / lateral_m : (f * turn_r - r * turn_f) / level2;
    const double solid_angle =
        distance_m / range_m / (cone ? 1.0 : std::sqrt(level2) / range_m);
    const double power = cuts.power_W_per_rad[i] * solid_angle;
    const double half_rad = std::abs(turn) * slice.width_rad / 2;
    const double from = (azimuth_rad - half_rad - bins.first_azimuth_rad) / bins.step_rad;
    const double to = (azimuth_rad + half_rad - bins.first_azimuth_rad) / bins.step_rad;
    const int first = std::max(static_cast<int>(std::floor(from)), 0);
    const int last = std::min(static_cast<int>(std::floor(to)), bins.sub_columns - 1);
    for (int sub = first; sub <= last; ++sub) {
      const double share =
          (std::min(to, sub + 1.0) - std::max(from, static_cast<double>(sub))) / (to - from);
      const auto s = static_cast<std::size_t>(sub);
      deposit(cuts.from_cell[i], cuts.to_cell[i], power * share,
              bins.range_W_per_rad + s * static_cast<std::size_t>(cells), cells);
      if (bins.elevation_W_m3_per_rad == nullptr) continue;
      deposit(cuts.first_row[i], cuts.last_row[i], power * share * range_m * range_m * range_m,
              bins.elevation_W_m3_per_rad + s * static_cast<std::size_t>(rows), rows);
    }
  }
}

}  // namespace fanbeam::renderer
