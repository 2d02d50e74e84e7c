#include "renderer/casting/profile/slice_power.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/dispatch.h"
#include "renderer/casting/deposit.h"
#include "renderer/casting/nrcs_table.h"

namespace fanbeam::renderer {
namespace {

// Raw pointers to columns that do not overlap, and loops marked so: the compiler makes vector code of
// nothing else here.
using Out = double*;
using In = const double*;
#if defined(__clang__)
#define FANBEAM_INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
#define FANBEAM_INDEPENDENT _Pragma("GCC ivdep")
#endif

constexpr double kLeast_m2 = 1e-12;
constexpr double kNoLength_m2 = 1e-30;  // a piece of no length then sends nothing back, not NaN
// Elevation below which one middle does for a piece on both sides of a cell's border.
constexpr double kSmallTurn_rad = 7e-4;

// integral of p ds / (p^2 + s^2)^2, slice_power.h.
inline double solid_integral(double p, double s1, double s2) {
  const double middle = (s1 + s2) / 2, length = s2 - s1;
  // A line through the sensor sends nothing back, not even from its foot.
  const double square = p * p + middle * middle;
  const double inverse2 = 1.0 / (square > kLeast_m2 ? square : kLeast_m2);
  const double cosine2 = middle * middle * inverse2;
  const double x = length * length / 4 * inverse2;
  const double c2 = 12.0 * cosine2 - 2.0;
  const double c4 = (80.0 * cosine2 - 48.0) * cosine2 + 3.0;
  const double series = 1.0 + x * (c2 / 3 + x * (c4 / 5));
  return length * p * inverse2 * inverse2 * series;
}

// Cells and integrals.
FANBEAM_HOT void integrate(const sensors::RangeGate& gate, const VisiblePieces& pieces,
                           PiecePowers& powers) {
  const In near_distance = pieces.near_distance_m.data(), near_height = pieces.near_height_m.data();
  const In far_distance = pieces.far_distance_m.data(), far_height = pieces.far_height_m.data();
  const In nearer = pieces.nearer_m.data(), farther = pieces.farther_m.data();
  const In cross = pieces.cross_m2.data();
  const Out near_range = powers.near_range_m.data(), far_range = powers.far_range_m.data();
  const Out first = powers.first.data(), second = powers.second.data();
  const Out distance = powers.distance_m.data(), height = powers.height_m.data();
  std::int32_t* kind = powers.kind.data();
  std::int32_t* first_cell = powers.first_cell.data();
  std::int32_t* second_cell = powers.second_cell.data();
  const double minimum_m = gate.minimum_m, cell_m = gate.cell_m, per_m = 1.0 / gate.cell_m;
  const double cells = gate.cells;  // also the sink's number
  const int count = pieces.count;
  FANBEAM_INDEPENDENT
  for (int i = 0; i < count; ++i) {
    const double d1 = near_distance[i], z1 = near_height[i];
    const double d2 = far_distance[i], z2 = far_height[i];
    const double step_d = d2 - d1, step_z = z2 - z1;
    const double range1 = std::sqrt(d1 * d1 + z1 * z1), range2 = std::sqrt(d2 * d2 + z2 * z2);
    // With what a wall takes in the wedge beyond its ranges here.
    const double more1 = range1 < range2 ? nearer[i] : farther[i];
    const double more2 = range1 < range2 ? farther[i] : nearer[i];
    // Cells beyond the gate need no number of their own.
    const double f1 = std::floor((range1 + more1 - minimum_m) * per_m);
    const double f2 = std::floor((range2 + more2 - minimum_m) * per_m);
    const double h1 = f1 < cells ? f1 : cells, h2 = f2 < cells ? f2 : cells;
    const double c1 = h1 > -1.0 ? h1 : -1.0, c2 = h2 > -1.0 ? h2 : -1.0;
    const double square_length = step_d * step_d + step_z * step_z;
    const double length2 = square_length > kNoLength_m2 ? square_length : kNoLength_m2;
    const double per_length = 1.0 / std::sqrt(length2);
    const double crossed = cross[i] * per_length;
    const double p = crossed > 0.0 ? crossed : 0.0;
    // Along the line from the point nearest to the sensor.
    const double s1 = (d1 * step_d + z1 * step_z) * per_length, s2 = s1 + length2 * per_length;
    const double border_m = minimum_m + cell_m * (c1 > c2 ? c1 : c2);
    const double square = border_m * border_m - p * p;
    const double to_border = std::sqrt(square > 0.0 ? square : 0.0);
    const double crossing = s1 + s2 > 0.0 ? to_border : -to_border;
    const double behind = crossing < s2 ? crossing : s2;
    const double between = behind > s1 ? behind : s1;
    const double split = c1 < c2 ? between : c2 < c1 ? between : s2;
    first[i] = solid_integral(p, s1, split);
    second[i] = solid_integral(p, split, s2);
    near_range[i] = range1;
    far_range[i] = range2;
    const double apart = c1 > c2 ? c1 - c2 : c2 - c1;
    const double turns = s1 * s2 < 0.0 ? 2.0 : 0.0;
    // The ends of the gate are cut off exactly.
    const double least = c1 < c2 ? c1 : c2, most = c1 < c2 ? c2 : c1;
    const double enters = least < 0.0 ? apart : 0.0, leaves = most >= cells ? apart : 0.0;
    // So are pieces close by, where pattern and NRCS differ from one half to the other.
    const double nearest = range1 < range2 ? range1 : range2;
    const double turn_m2 = cross[i], small_m2 = kSmallTurn_rad * nearest * nearest;
    const double most_m2 = kMostElevation_rad * nearest * nearest;
    const double near_by = (turn_m2 > small_m2 ? apart : 0.0) + (turn_m2 > most_m2 ? 2.0 : 0.0);
    const double in_gate = most >= 0.0 && least < cells ? 1.0 : 0.0;
    const double long_one = (apart + turns + enters + leaves + near_by) * in_gate > 1.0 ? 1.0 : 0.0;
    const double spread = farther[i] - nearer[i] > 0.0 ? apart : 0.0;
    const double found = spread > 0.0 ? 2.0 : long_one;
    kind[i] = static_cast<std::int32_t>(found);
    // What is not plain goes elsewhere later.
    const double limit = found > 0.0 ? 0.0 : cells;
    const double in1 = c1 >= 0.0 ? c1 : cells, in2 = c2 >= 0.0 ? c2 : cells;
    first_cell[i] = static_cast<std::int32_t>(in1 < limit ? in1 : cells);
    second_cell[i] = static_cast<std::int32_t>(in2 < limit ? in2 : cells);
    distance[i] = (d1 + d2) / 2;
    height[i] = (z1 + z2) / 2;
  }
  powers.count = count;
}

// Sine of the antenna's elevation of a point of the slice is (along d + up z) / R.
struct SineWeights {
  double along, up;
};

// Pattern and NRCS.
FANBEAM_HOT void weigh(const PowerTables& tables, const double* gain_table,
                       const SineWeights& weights, double constant, const VisiblePieces& pieces,
                       PiecePowers& powers) {
  const In facet = pieces.facet_m.data(), facet_d2 = pieces.facet_d2.data();
  const std::int32_t* material = pieces.material.data();
  const In distance = powers.distance_m.data(), height = powers.height_m.data();
  const Out first = powers.first.data(), second = powers.second.data();
  const Out range = powers.range_m.data();
  const In nrcs = tables.nrcs(), gain = gain_table;
  const double along = weights.along, up = weights.up;
  const double lowest_sine = tables.lowest_sine(), per_sine = tables.steps_per_sine();
  constexpr double kLastStep = PowerTables::kSineSteps - 1e-6;
  constexpr double kFine = PowerTables::kFineSteps / PowerTables::kFineBelow;
  const int count = pieces.count;
  FANBEAM_INDEPENDENT
  for (int i = 0; i < count; ++i) {
    const double d = distance[i], z = height[i];
    const double range2 = d * d + z * z;
    const double inverse = 1.0 / std::sqrt(range2);
    range[i] = range2 * inverse;
    const double grazing = facet[i] / std::sqrt(facet_d2[i]) * inverse;
    const double positive = grazing > 0.0 ? grazing : 0.0;
    const double sine = positive < 1.0 ? positive : 1.0;
    // The entry as a whole number in a double, so that one comparison serves scale and place.
    const bool fine = sine < PowerTables::kFineBelow;
    const double position = sine * (fine ? kFine : PowerTables::kNrcsSteps);
    const double begin = fine ? PowerTables::kFirstFine : 0.0;
    const int entry = material[i] * PowerTables::kNrcsStride + static_cast<int>(position) +
                      static_cast<int>(begin);
    const double share = position - std::trunc(position);
    const double sigma0_over_sine = nrcs[entry] + share * (nrcs[entry + 1] - nrcs[entry]);
    const double at = ((along * d + up * z) * inverse - lowest_sine) * per_sine;
    const double above = at > 0.0 ? at : 0.0;
    const double step = above < kLastStep ? above : kLastStep;
    const int s = static_cast<int>(step);
    const double factor =
        constant * sigma0_over_sine * (gain[s] + (step - s) * (gain[s + 1] - gain[s]));
    first[i] *= factor;
    second[i] *= factor;
  }
}

// Which rows the ends lie in, from a table of any elevations.
FANBEAM_HOT void place_rows(const PowerTables& tables, const SineWeights& weights,
                            const VisiblePieces& pieces, PiecePowers& powers) {
  const In near_distance = pieces.near_distance_m.data(), near_height = pieces.near_height_m.data();
  const In far_distance = pieces.far_distance_m.data(), far_height = pieces.far_height_m.data();
  const In near_range = powers.near_range_m.data(), far_range = powers.far_range_m.data();
  const Out first_row = powers.first_row.data(), last_row = powers.last_row.data();
  const In row = tables.row();
  const double along = weights.along, up = weights.up;
  const double lowest_sine = tables.lowest_sine(), per_sine = tables.steps_per_sine();
  constexpr double kLastStep = PowerTables::kSineSteps - 1e-6;
  const int count = pieces.count;
  FANBEAM_INDEPENDENT
  for (int i = 0; i < count; ++i) {
    const double sine1 = (along * near_distance[i] + up * near_height[i]) / near_range[i];
    const double sine2 = (along * far_distance[i] + up * far_height[i]) / far_range[i];
    const double at1 = (sine1 - lowest_sine) * per_sine, at2 = (sine2 - lowest_sine) * per_sine;
    const double above1 = at1 > 0.0 ? at1 : 0.0, above2 = at2 > 0.0 ? at2 : 0.0;
    const double step1 = above1 < kLastStep ? above1 : kLastStep;
    const double step2 = above2 < kLastStep ? above2 : kLastStep;
    const int e1 = static_cast<int>(step1), e2 = static_cast<int>(step2);
    const double row1 = row[e1] + (step1 - e1) * (row[e1 + 1] - row[e1]);
    const double row2 = row[e2] + (step2 - e2) * (row[e2 + 1] - row[e2]);
    first_row[i] = row1 < row2 ? row1 : row2;
    last_row[i] = row1 < row2 ? row2 : row1;
  }
}

// The same near the horizon, where the arc sine is a short series: the error is below 2e-8 rad for
// sines to kNearHorizon, and no table is needed.
constexpr double kNearHorizon = 0.4;

inline double arc_sine(double x) {
  const double y = x * x;
  return x * (1.0 + y * (1.0 / 6 +
                         y * (3.0 / 40 + y * (15.0 / 336 +
                                              y * (105.0 / 3456 + y * (945.0 / 42240 +
                                                                       y * (10395.0 / 599040)))))));
}

FANBEAM_HOT void place_rows_near_horizon(const PowerTables& tables, const SineWeights& weights,
                                         const VisiblePieces& pieces, PiecePowers& powers) {
  const In near_distance = pieces.near_distance_m.data(), near_height = pieces.near_height_m.data();
  const In far_distance = pieces.far_distance_m.data(), far_height = pieces.far_height_m.data();
  const In near_range = powers.near_range_m.data(), far_range = powers.far_range_m.data();
  const Out first_row = powers.first_row.data(), last_row = powers.last_row.data();
  const double along = weights.along, up = weights.up;
  const double top_rad = tables.top_rad(), per_rad = tables.rows_per_rad();
  const int count = pieces.count;
  FANBEAM_INDEPENDENT
  for (int i = 0; i < count; ++i) {
    const double sine1 = (along * near_distance[i] + up * near_height[i]) / near_range[i];
    const double sine2 = (along * far_distance[i] + up * far_height[i]) / far_range[i];
    const double high = sine1 > sine2 ? sine1 : sine2, low = sine1 > sine2 ? sine2 : sine1;
    const double in_high = high < kNearHorizon ? high : kNearHorizon;
    const double in_low = low > -kNearHorizon ? low : -kNearHorizon;
    first_row[i] = (top_rad - arc_sine(in_high)) * per_rad;
    last_row[i] = (top_rad - arc_sine(in_low)) * per_rad;
  }
}

// How the power of plain pieces falls on two rows; those over more, or partly outside, are told.
FANBEAM_HOT void share_rows(int rows_in_picture, int cells_in_gate, PiecePowers& powers) {
  const In first_row = powers.first_row.data(), last_row = powers.last_row.data();
  const In first = powers.first.data(), second = powers.second.data();
  const In range = powers.range_m.data();
  const std::int32_t* first_cell = powers.first_cell.data();
  std::int32_t* kind = powers.kind.data();
  std::int32_t* row = powers.row.data();
  const Out row_share = powers.row_share.data(), row_power = powers.row_power.data();
  const double rows = rows_in_picture, cells = cells_in_gate;
  const int count = powers.count;
  FANBEAM_INDEPENDENT
  for (int i = 0; i < count; ++i) {
    const double from = first_row[i], to = last_row[i];
    const double f1 = std::floor(from), f2 = std::floor(to);
    const double width = to - from;
    const double two = f2 > f1 ? (f2 - from) / (width > 0.0 ? width : 1.0) : 1.0;
    const double seen = first_cell[i] < cells ? 1.0 : 0.0;
    const double power = (first[i] + second[i]) * seen;
    // 0 where two rows of the picture hold it all.
    const double odd =
        (f2 - f1 > 1.0 ? 1.0 : 0.0) + (f1 < 0.0 ? 1.0 : 0.0) + (f2 >= rows ? 1.0 : 0.0);
    kind[i] += static_cast<std::int32_t>(odd * seen > 0.0 ? 3.0 : 0.0);
    const double plain = odd > 0.0 ? 0.0 : seen;
    row[i] = static_cast<std::int32_t>(plain > 0.0 ? f1 + 1.0 : 0.0);
    row_share[i] = two;
    row_power[i] = plain * power * range[i] * range[i] * range[i];
  }
}

// exp(-x) for x >= 0, as a loop of plain arithmetic: 2^-n times the series of the rest. Relative
// error 1e-11; below exp(-690) that value.
inline double decay(double x) {
  constexpr double kLog2e = 1.4426950408889634, kLn2High = 0.693147180369123816490,
                   kLn2Low = 1.90821492927058770002e-10;
  const double held = x < 690.0 ? x : 690.0;
  const double n = std::floor(held * kLog2e + 0.5);
  const double r = (n * kLn2High - held) + n * kLn2Low;  // exp(-x) = 2^-n exp(r)
  const double series =
      1.0 +
      r * (1.0 +
           r * (1.0 / 2 +
                r * (1.0 / 6 + r * (1.0 / 24 +
                                    r * (1.0 / 120 +
                                         r * (1.0 / 720 + r * (1.0 / 5040 + r * (1.0 / 40320 +
                                                                                 r / 362880))))))));
  const auto exponent = static_cast<std::int64_t>(1023 - static_cast<std::int32_t>(n));
  return series * std::bit_cast<double>(exponent << 52);
}

FANBEAM_HOT void lose_on_path(const PathLossTable& path_loss, double sensor_m,
                              PiecePowers& powers) {
  const In nepers = path_loss.nepers_per_m(), height = powers.height_m.data();
  const In range = powers.range_m.data();
  const Out first = powers.first.data(), second = powers.second.data();
  const double above_m = sensor_m - path_loss.lowest_m(), per_m = path_loss.steps_per_m();
  constexpr double kLast = PathLossTable::kSteps - 1e-9;
  const int count = powers.count;
  FANBEAM_INDEPENDENT
  for (int i = 0; i < count; ++i) {
    const double at = (height[i] + above_m) * per_m;
    const double above = at > 0.0 ? at : 0.0;
    const double position = above < kLast ? above : kLast;
    const int entry = static_cast<int>(position);
    const double share = position - entry;
    const double factor =
        decay((nepers[entry] * (1.0 - share) + nepers[entry + 1] * share) * range[i]);
    first[i] *= factor;
    second[i] *= factor;
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
      nrcs_[first + static_cast<std::size_t>(i)] =
          table.sigma0_over_sine(std::clamp(static_cast<double>(i) / kNrcsSteps, kTiny, 1.0));
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
  highest_sine_ = std::sin(highest_rad);
  top_rad_ = display.cscope_top_rad;
  rows_per_rad_ = display.cscope_rows / display.cscope_span_rad;
  steps_per_sine_ = kSineSteps / (highest_sine_ - lowest_sine_);
  for (int i = 0; i <= kSineSteps + 1; ++i) {
    const double sine =
        std::clamp(lowest_sine_ + std::min(i, kSineSteps) / steps_per_sine_, -1.0, 1.0);
    const double elevation_rad = std::asin(sine);
    // Nothing beyond the pattern: what lies there is held to the first and last entry. A pattern
    // that reaches straight down or up has no such end.
    const bool edge =
        (i == 0 && lowest_rad > -core::kPi / 2) || (i >= kSineSteps && highest_rad < core::kPi / 2);
    even_gain_.push_back(1.0);
    gain_.push_back(edge ? 0.0 : gain(elevation_rad - antenna.boresight_elevation_rad));
    row_.push_back((display.cscope_top_rad - elevation_rad) * rows_per_rad_);
  }
}

double PowerTables::look_up(const std::vector<double>& table, double sine) const {
  const double at = std::clamp((sine - lowest_sine_) * steps_per_sine_, 0.0, kSineSteps - 1e-6);
  const auto step = static_cast<std::size_t>(at);
  return table[step] + (at - static_cast<double>(step)) * (table[step + 1] - table[step]);
}

SlicePower::SlicePower(const World& world, const sensors::AntennaFrame& antenna,
                       const PowerTables& tables, const PathLossTable& path_loss)
    : world_(world),
      antenna_(antenna),
      tables_(tables),
      path_loss_(path_loss),
      radar_constant_W_m2_(world.sensor.radar_constant_W_m2()) {}

void SlicePower::add(const Slice& slice, VisiblePieces& pieces, const SliceBins& bins) {
  evaluate(slice, pieces, bins);
  pieces.count = 0;
  if (rest_.count > 0) finish_rest(slice, bins);
}

void SlicePower::finish_rest(const Slice& slice, const SliceBins& bins) {
  evaluate(slice, rest_, bins);
  rest_.count = 0;
}

void SlicePower::evaluate(const Slice& slice, const VisiblePieces& pieces, const SliceBins& bins) {
  const sensors::RangeGate& gate = world_.sensor.range;
  integrate(gate, pieces, powers_);
  if (&pieces == &rest_) {
    // Each lies in the cell that it was cut for, whatever rounding makes of its ends.
    std::fill_n(powers_.kind.begin(), pieces.count, PiecePowers::plain);
    std::copy_n(rest_cell_.begin(), pieces.count, powers_.first_cell.begin());
    std::copy_n(rest_cell_.begin(), pieces.count, powers_.second_cell.begin());
  }
  const SineWeights weights{slice.along.x * antenna_.up.x + slice.along.y * antenna_.up.y,
                            antenna_.up.z};
  // A cone's elevation is no matter of the slice alone: deposit_across finds it.
  const bool cone = world_.sensor.scan.surface == sensors::ScanSurface::cone;
  weigh(tables_, cone ? tables_.even_gain() : tables_.gain(), weights,
        radar_constant_W_m2_ * bins.weight, pieces, powers_);
  if (!path_loss_.clear()) lose_on_path(path_loss_, antenna_.position_m.z, powers_);
  if (world_.rain_cells) lose_in_rain_cells(slice);
  if (bins.elevation_W_m3_per_rad != nullptr) {
    if (tables_.near_horizon(kNearHorizon))
      place_rows_near_horizon(tables_, weights, pieces, powers_);
    else
      place_rows(tables_, weights, pieces, powers_);
  }
  if (bins.across)
    deposit_across(pieces, slice, bins);
  else
    deposit_in_column(pieces, bins);
  if (&pieces == &rest_) return;
  // Cutting uses `powers_` again: what is needed of it is copied first.
  int many = 0;
  std::array<std::int32_t, VisiblePieces::kCapacity> indices;
  for (int i = 0; i < pieces.count; ++i) {
    blanked_ += std::max(powers_.near_range_m[i], powers_.far_range_m[i]) < gate.minimum_m ? 1 : 0;
    if (powers_.kind[i] == PiecePowers::many_cells) indices[many++] = i;
  }
  for (int m = 0; m < many; ++m) cut_at_cells(pieces, indices[m], slice, bins);
}

void SlicePower::lose_in_rain_cells(const Slice& slice) {
  for (int i = 0; i < powers_.count; ++i) {
    const double factor = world_.rain_cells->two_way_power_factor(
        antenna_.position_m,
        antenna_.position_m + glm::dvec3(slice.along * powers_.distance_m[i], powers_.height_m[i]));
    powers_.first[i] *= factor;
    powers_.second[i] *= factor;
  }
}

void SlicePower::cut_at_cells(const VisiblePieces& pieces, int i, const Slice& slice,
                              const SliceBins& bins) {
  const sensors::RangeGate& gate = world_.sensor.range;
  const double d1 = pieces.near_distance_m[i], z1 = pieces.near_height_m[i];
  const double d2 = pieces.far_distance_m[i], z2 = pieces.far_height_m[i];
  const double step_d = d2 - d1, step_z = z2 - z1;
  const double length2 = step_d * step_d + step_z * step_z;
  const double p = pieces.cross_m2[i] / std::sqrt(length2);
  if (!(p > 0.0)) return;
  const double s1 = (d1 * step_d + z1 * step_z) / length2;  // from the foot, in piece lengths
  double at = 0.0;
  const auto put_part = [&](double from, double to, int cell) {
    const int n = rest_.count++;
    rest_.near_distance_m[n] = d1 + from * step_d;
    rest_.near_height_m[n] = z1 + from * step_z;
    rest_.far_distance_m[n] = d1 + to * step_d;
    rest_.far_height_m[n] = z1 + to * step_z;
    rest_.cross_m2[n] = pieces.cross_m2[i] * (to - from);
    rest_.facet_m[n] = pieces.facet_m[i];
    rest_.facet_d2[n] = pieces.facet_d2[i];
    rest_.material[n] = pieces.material[i];
    rest_.nearer_m[n] = rest_.farther_m[n] = 0.0;
    rest_cell_[n] = cell;
    if (rest_.full()) finish_rest(slice, bins);
  };
  const auto put = [&](double next, int cell) {
    // A sliver that rounding leaves no length is none.
    const bool some =
        d1 + at * step_d != d1 + next * step_d || z1 + at * step_z != z1 + next * step_z;
    if (next > at && some && cell >= 0 && cell < gate.cells) {
      const double near_m = gate.minimum_m + gate.cell_m * cell;
      const int parts = parts_of(pieces.cross_m2[i] * (next - at), near_m * near_m);
      const double step = (next - at) / parts;
      for (int part = 0; part < parts; ++part)
        put_part(at + step * part, part + 1 == parts ? next : at + step * (part + 1), cell);
    }
    at = next;
  };
  const auto cut_until = [&](double end, int first, int last, double sign) {
    const int direction = last > first ? 1 : -1;
    for (int cell = first; cell != last; cell += direction) {
      const double border_m = gate.minimum_m + gate.cell_m * (direction > 0 ? cell + 1 : cell);
      const double s2 = std::max((border_m * border_m - p * p) / length2, 0.0);
      put(std::clamp(sign * std::sqrt(s2) - s1, at, end), cell);
    }
    put(end, last);
  };
  const auto cell_at = [&](double range_m) {
    const double place = (range_m - gate.minimum_m) / gate.cell_m;
    return static_cast<int>(std::floor(std::clamp(place, -1.0, static_cast<double>(gate.cells))));
  };
  const int first = cell_at(std::sqrt(d1 * d1 + z1 * z1));
  const int last = cell_at(std::sqrt(d2 * d2 + z2 * z2));
  if (s1 < 0.0 && s1 > -1.0) {
    const int foot = cell_at(p);
    cut_until(-s1, first, foot, -1.0);
    cut_until(1.0, foot, last, 1.0);
  } else {
    cut_until(1.0, first, last, s1 < 0.0 ? -1.0 : 1.0);
  }
}

namespace {

// Ranges in cells over which an oblique wall spreads.
struct WedgeSpan {
  double from, to;
};
WedgeSpan wedge_span(const sensors::RangeGate& gate, const VisiblePieces& pieces,
                     const PiecePowers& powers, int i) {
  const double r1_m = powers.near_range_m[i] - gate.minimum_m;
  const double r2_m = powers.far_range_m[i] - gate.minimum_m;
  return {(std::min(r1_m, r2_m) + pieces.nearer_m[i]) / gate.cell_m,
          (std::max(r1_m, r2_m) + pieces.farther_m[i]) / gate.cell_m};
}

}  // namespace

void SlicePower::deposit_in_column(const VisiblePieces& pieces, const SliceBins& bins) {
  double* range_bins = bins.range_W_per_rad;
  for (int i = 0; i < powers_.count; ++i) {
    range_bins[powers_.first_cell[i]] += powers_.first[i];
    range_bins[powers_.second_cell[i]] += powers_.second[i];
  }
  if (bins.elevation_W_m3_per_rad != nullptr) {
    share_rows(world_.sensor.display.cscope_rows, world_.sensor.range.cells, powers_);
    double* row_bins = bins.elevation_W_m3_per_rad;
    for (int i = 0; i < powers_.count; ++i) {
      const double part = powers_.row_power[i] * powers_.row_share[i];
      row_bins[powers_.row[i]] += part;
      row_bins[powers_.row[i] + 1] += powers_.row_power[i] - part;
    }
  }
  for (int i = 0; i < powers_.count; ++i)
    if (powers_.kind[i] >= PiecePowers::wedge) deposit_special(pieces, i, bins);
}

void SlicePower::deposit_special(const VisiblePieces& pieces, int i, const SliceBins& bins) {
  const sensors::RangeGate& gate = world_.sensor.range;
  const double power = powers_.first[i] + powers_.second[i];
  if (powers_.kind[i] == PiecePowers::wedge) {
    const WedgeSpan span = wedge_span(gate, pieces, powers_, i);
    if (span.to < 0.0 || span.from >= gate.cells) return;
    deposit(span.from, span.to, power, bins.range_W_per_rad, gate.cells);
  }
  if (bins.elevation_W_m3_per_rad == nullptr) return;
  const double range_m = powers_.range_m[i];
  deposit(powers_.first_row[i], powers_.last_row[i], power * range_m * range_m * range_m,
          bins.elevation_W_m3_per_rad + 1, world_.sensor.display.cscope_rows);
}

// The row of a point of the slice in a cone scan, whose elevation is atan2(up, forward).
double SlicePower::cone_row(const Slice& slice, double distance_m, double height_m) const {
  const glm::dvec3 point(slice.along * distance_m, height_m);
  const double f = glm::dot(point, antenna_.forward), u = glm::dot(point, antenna_.up);
  return tables_.row_at(u / std::sqrt(f * f + u * u));
}

// Where the wedge at this point lies in the antenna's azimuth, from its middle and its derivative
// by heading; the solid angle in the antenna's coordinates as in ray_caster.h.
void SlicePower::deposit_across(const VisiblePieces& pieces, const Slice& slice,
                                const SliceBins& bins) {
  const bool cone = world_.sensor.scan.surface == sensors::ScanSurface::cone;
  const sensors::RangeGate& gate = world_.sensor.range;
  const int rows = world_.sensor.display.cscope_rows;
  const glm::dvec3 along(slice.along, 0.0);
  const glm::dvec3 clockwise(slice.along.y, -slice.along.x, 0.0);
  for (int i = 0; i < pieces.count; ++i) {
    if (powers_.kind[i] == PiecePowers::many_cells) continue;
    const double distance_m = powers_.distance_m[i], range_m = powers_.range_m[i];
    const glm::dvec3 point = along * distance_m + glm::dvec3(0.0, 0.0, powers_.height_m[i]);
    const double f = glm::dot(point, antenna_.forward), r = glm::dot(point, antenna_.right);
    const double u = glm::dot(point, antenna_.up);
    if (f <= 0.0) continue;
    const double turn_f = distance_m * glm::dot(clockwise, antenna_.forward);
    const double turn_r = distance_m * glm::dot(clockwise, antenna_.right);
    const double level2 = f * f + r * r;
    const double azimuth_rad = cone ? std::asin(r / range_m) : std::atan2(r, f);
    const double turn =
        cone ? turn_r / std::sqrt(f * f + u * u) : (f * turn_r - r * turn_f) / level2;
    double solid_angle = distance_m / (cone ? range_m : std::sqrt(level2));
    double first_row = powers_.first_row[i], last_row = powers_.last_row[i];
    if (cone) {
      solid_angle *= tables_.gain_at(u / std::sqrt(f * f + u * u));
      const double row1 = cone_row(slice, pieces.near_distance_m[i], pieces.near_height_m[i]);
      const double row2 = cone_row(slice, pieces.far_distance_m[i], pieces.far_height_m[i]);
      first_row = std::min(row1, row2);
      last_row = std::max(row1, row2);
    }
    const double half_rad = std::abs(turn) * slice.width_rad / 2;
    const double from = (azimuth_rad - half_rad - bins.first_azimuth_rad) / bins.step_rad;
    const double to = (azimuth_rad + half_rad - bins.first_azimuth_rad) / bins.step_rad;
    const int first = std::max(static_cast<int>(std::floor(from)), 0);
    const int last = std::min(static_cast<int>(std::floor(to)), bins.sub_columns - 1);
    if (!(to > from)) continue;  // the antenna on its side: no azimuth to tell
    for (int sub = first; sub <= last; ++sub) {
      const double share = solid_angle *
                           (std::min(to, sub + 1.0) - std::max(from, static_cast<double>(sub))) /
                           (to - from);
      const auto s = static_cast<std::size_t>(sub);
      double* range_bins = bins.range_W_per_rad + s * static_cast<std::size_t>(gate.cells);
      double power = 0.0;
      if (powers_.kind[i] == PiecePowers::wedge) {
        const WedgeSpan span = wedge_span(gate, pieces, powers_, i);
        if (span.to < 0.0 || span.from >= gate.cells) continue;
        power = share * (powers_.first[i] + powers_.second[i]);
        deposit(span.from, span.to, power, range_bins, gate.cells);
      } else {
        const auto put = [&](std::int32_t cell, double part) {
          if (cell >= gate.cells) return;
          range_bins[cell] += share * part;
          power += share * part;
        };
        put(powers_.first_cell[i], powers_.first[i]);
        put(powers_.second_cell[i], powers_.second[i]);
      }
      if (bins.elevation_W_m3_per_rad == nullptr) continue;
      deposit(first_row, last_row, power * range_m * range_m * range_m,
              bins.elevation_W_m3_per_rad + s * static_cast<std::size_t>(rows), rows);
    }
  }
}

}  // namespace fanbeam::renderer
