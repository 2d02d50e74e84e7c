#include "renderer/stages/rain_echo.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "atmosphere/attenuated_length.h"
#include "core/dispatch.h"
#include "core/parallel.h"
#include "renderer/casting/deposit.h"
#include "renderer/casting/fan_layout.h"
#include "renderer/plan/largest_echo.h"
#include "renderer/stages/range_response.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/cells.h"

namespace fanbeam::renderer {
namespace {

// Rows of a C-scope lie 0.02 deg apart: wider intervals would show as bands.
constexpr double kLargestStep_rad = 0.1 * core::kPi / 180.0;
constexpr int kCellsPerStep = 8;
// Echo and loss are evaluated this far apart in elevation and interpolated: seldom where no top or
// base lies within the beam, since they then change with range alone (and slowly with the air), often
// where one does.
constexpr double kSmoothStep_rad = 2.0 * core::kPi / 180.0;
constexpr double kLayeredStep_rad = 0.1 * core::kPi / 180.0;
// Azimuths share their profiles where the beam holds no border of any layer and its tilt changes heights
// by no more than this at the farthest range. That changes the loss by gas by under 1 % of it
// over 41 deg of azimuth, 2 % all round: 0.006 dB at 35 GHz and 3.7 km, 0.03 dB at 94 GHz.
constexpr double kSharedHeight_m = 75.0;
// The loss between these is a straight line in dB. The border of a rain cell is sharp in eta; its
// loss is off by at most half a step, 0.1 dB in a shower of 40 mm/h at 94 GHz.
constexpr int kCellsPerLoss = 4;
constexpr double kNeperPer_dB = 0.1 * 2.302585092994046;  // of power
constexpr double kUnlimited_m = std::numeric_limits<double>::infinity();

// Borders of the elevation intervals, increasing, over the whole elevation pattern.
std::vector<double> elevation_borders(const sensors::Sensor& sensor, double height_m) {
  const sensors::Antenna& antenna = sensor.antenna;
  const double reach_rad = sensors::reach_rad(antenna.elevation);
  const double low_rad = std::max(antenna.boresight_elevation_rad - reach_rad, -core::kPi / 2);
  const double high_rad = std::min(antenna.boresight_elevation_rad + reach_rad, core::kPi / 2);
  std::vector<double> wanted = {low_rad, high_rad};
  if (height_m > 0.0)
    for (int step = 0; step * kCellsPerStep < sensor.range.cells + kCellsPerStep; ++step) {
      const double range_m =
          sensors::range_edge_m(sensor.range, std::min(step * kCellsPerStep, sensor.range.cells));
      if (range_m <= height_m) continue;
      const double elevation_rad = -std::asin(height_m / range_m);
      if (elevation_rad > low_rad && elevation_rad < high_rad) wanted.push_back(elevation_rad);
    }
  std::sort(wanted.begin(), wanted.end());
  std::vector<double> borders = {low_rad};
  for (const double end_rad : wanted) {
    const double begin_rad = borders.back();
    const int parts = static_cast<int>(std::ceil((end_rad - begin_rad) / kLargestStep_rad));
    for (int part = 1; part <= parts; ++part)
      borders.push_back(begin_rad + (end_rad - begin_rad) * part / parts);
  }
  return borders;
}

// Along one direction, as if the air were free.
struct Profile {
  std::vector<double> power_W;  // of every range cell
  // Sums of power times R^3 of all cells before each one, and of all.
  std::vector<double> before_W_m3;

  void sum(const sensors::RangeGate& gate) {
    before_W_m3.resize(power_W.size() + 1);
    double sum_W_m3 = 0.0;
    for (std::size_t k = 0; k < power_W.size(); ++k) {
      before_W_m3[k] = sum_W_m3;
      const double range_m = sensors::range_middle_m(gate, static_cast<int>(k));
      sum_W_m3 += power_W[k] * range_m * range_m * range_m;
    }
    before_W_m3.back() = sum_W_m3;
  }
};

FANBEAM_HOT(void, add_mixed,
            (const double* lower_W, double lower, const double* upper_W, double upper, int count,
             double* sums_W),
            (lower_W, lower, upper_W, upper, count, sums_W)) {
  for (int k = 0; k < count; ++k) sums_W[k] += lower * lower_W[k] + upper * upper_W[k];
}

class Echo {
 public:
  Echo(const World& world, const sensors::AntennaFrame& antenna, int sub_columns_per_column,
       FanSums& sums)
      : world_(world),
        sensor_(world.sensor),
        antenna_(antenna),
        subs_(sub_columns_per_column),
        sums_(sums),
        directions_(rain_directions(world, antenna)),
        borders_(elevation_borders(sensor_, height_above_ground_m())) {
    const sensors::BeamCut& cut = sensor_.antenna.elevation;
    const double boresight_rad = sensor_.antenna.boresight_elevation_rad;
    for (std::size_t i = 0; i + 1 < borders_.size(); ++i) {
      const double from_rad = borders_[i] - boresight_rad;
      const double to_rad = borders_[i + 1] - boresight_rad;
      const double middle_rad = (from_rad + to_rad) / 2.0;
      gain_rad_.push_back(std::abs(middle_rad) <= cut.cut_rad
                              ? sensors::two_way_integral(cut, from_rad, to_rad)
                              : sensors::two_way_gain_with_side_lobes(cut, middle_rad) *
                                    (to_rad - from_rad));
    }
    const double span_rad = borders_.back() - borders_.front();
    nodes_ = 1 + static_cast<int>(std::ceil(span_rad / directions_.step_rad));
    node_step_rad_ = span_rad / (nodes_ - 1);
  }

  void run() {
    const int blocks = (sums_.sub_columns + subs_ - 1) / subs_;
    for (int block = 0; block < blocks && beside_cells_.empty(); ++block)
      if (directions_.shared && !cells_in(azimuth_rad(block))) profiles(0.0, false, beside_cells_);
    free_m_.resize(static_cast<std::size_t>(blocks) + 1);
    core::parallel_for(free_m_.size(), [&](std::size_t border) {
      free_distances_m(fan_azimuth_rad(first_of(static_cast<int>(border))), free_m_[border]);
    });
    core::parallel_for(static_cast<std::size_t>(blocks),
                       [&](std::size_t block) { add_block(static_cast<int>(block)); });
  }

 private:
  double height_above_ground_m() const {
    return world_.surfaces().terrain() == nullptr
               ? 0.0
               : world_.surfaces().height_above_ground_m(antenna_.position_m);
  }

  bool cells_in(double azimuth_rad) const {
    const glm::dvec2 from_m(antenna_.position_m);
    const glm::dvec2 along(sensors::direction(antenna_, azimuth_rad, 0.0, sensor_.scan.surface));
    return world_.volume_echo->cells_between(from_m, from_m + along * sensor_.range.maximum_m());
  }

  // One way, from the antenna to the near edge of a cell.
  double loss_dB(const glm::dvec3& along, bool rain_cells, int cell) const {
    const double range_m = sensors::range_edge_m(sensor_.range, cell);
    const glm::dvec3 place_m = antenna_.position_m + along * range_m;
    const double cells_dB = rain_cells && world_.rain_cells
                                ? world_.rain_cells->one_way_dB(antenna_.position_m, place_m)
                                : 0.0;
    return cells_dB + world_.attenuation.one_way_dB(antenna_.position_m.z, place_m.z, range_m);
  }

  // Echo power per unit of two-way elevation gain and radian of azimuth in every range cell, as if
  // the air were free; without `rain_cells` as it is where none stands.
  void profile(double elevation_rad, double azimuth_rad, bool rain_cells, Profile& profile) const {
    const glm::dvec3 along =
        sensors::direction(antenna_, azimuth_rad, elevation_rad, sensor_.scan.surface);
    // J of ray_caster.h.
    const double jacobian = sensor_.scan.surface == sensors::ScanSurface::cone
                                ? std::max(std::cos(azimuth_rad), 0.0)
                                : 1.0;
    const double constant = sensor_.radar_constant_W_m2() * jacobian;
    const int cells = sensor_.range.cells;
    const double cell_m = sensor_.range.cell_m;
    std::vector<double>& power_W = profile.power_W;
    power_W.assign(static_cast<std::size_t>(cells), 0.0);
    double near_dB = loss_dB(along, rain_cells, 0);
    for (int first = 0; first < cells; first += kCellsPerLoss) {
      const int last = std::min(first + kCellsPerLoss, cells);
      const double far_dB = loss_dB(along, rain_cells, last);
      const double extinction_per_m =
          std::max(far_dB - near_dB, 0.0) / ((last - first) * cell_m) * kNeperPer_dB;
      const double per_cell = std::exp(-2.0 * extinction_per_m * cell_m);
      double length_m = atmosphere::attenuated_length_m(extinction_per_m, cell_m) *
                        std::exp(-2.0 * kNeperPer_dB * near_dB);
      for (int cell = first; cell < last; ++cell, length_m *= per_cell) {
        const double from_m = sensors::range_edge_m(sensor_.range, cell);
        const glm::dvec3 middle_m = antenna_.position_m + along * (from_m + cell_m / 2.0);
        const double eta = rain_cells ? world_.volume_echo->eta_m2_per_m3(middle_m)
                                      : world_.volume_echo->layered_eta_m2_per_m3(middle_m.z);
        if (from_m > 0.0)
          power_W[static_cast<std::size_t>(cell)] =
              constant * eta * length_m / (from_m * (from_m + cell_m));
      }
      near_dB = far_dB;
    }
    profile.sum(sensor_.range);
  }

  void profiles(double azimuth_rad, bool rain_cells, std::vector<Profile>& nodes) const {
    nodes.resize(static_cast<std::size_t>(nodes_));
    for (int node = 0; node < nodes_; ++node)
      profile(borders_.front() + node * node_step_rad_, azimuth_rad, rain_cells,
              nodes[static_cast<std::size_t>(node)]);
  }

  // How many cells have their middle at most that far away.
  int cells_within(double range_m) const {
    const sensors::RangeGate& gate = sensor_.range;
    return static_cast<int>(std::clamp(std::floor((range_m - gate.minimum_m) / gate.cell_m + 0.5),
                                       0.0, gate.cells * 1.0));
  }

  double free_m(double azimuth_rad, double elevation_rad) const {
    const glm::dvec3 along =
        sensors::direction(antenna_, azimuth_rad, elevation_rad, sensor_.scan.surface);
    const auto hit =
        world_.surfaces().intersect(antenna_.position_m, along, sensor_.range.maximum_m());
    return hit ? hit->distance_m : kUnlimited_m;
  }

  // How far the air is free along every border. Where two borders a few intervals apart both see
  // the sky, or both end before the first range cell, so does what lies between: things narrower
  // than half a degree above the horizon are missed.
  void free_distances_m(double azimuth_rad, std::vector<double>& free) const {
    constexpr std::size_t kStride = 5;
    const auto unseen = [&](double free_m) {
      return free_m == kUnlimited_m || free_m < sensor_.range.minimum_m;
    };
    free.resize(borders_.size());
    free[0] = free_m(azimuth_rad, borders_[0]);
    for (std::size_t from = 0; from + 1 < borders_.size();) {
      const std::size_t to = std::min(from + kStride, borders_.size() - 1);
      free[to] = free_m(azimuth_rad, borders_[to]);
      const bool between = !unseen(free[from]) || !unseen(free[to]) ||
                           std::isinf(free[from]) != std::isinf(free[to]);
      for (std::size_t i = from + 1; i < to; ++i)
        free[i] = between ? free_m(azimuth_rad, borders_[i]) : free[from];
      from = to;
    }
  }

  // Sub-columns from the fan's left.
  double fan_azimuth_rad(double place) const {
    return sums_.first_azimuth_rad + place * sums_.step_rad;
  }
  int first_of(int block) const { return std::min(block * subs_, sums_.sub_columns); }
  // Of the block's middle.
  double azimuth_rad(int block) const {
    return fan_azimuth_rad((first_of(block) + first_of(block + 1)) / 2.0);
  }
  // Whether air that is free so far at both sides of a block is so within; else a silhouette is.
  bool alike(double left_m, double right_m) const {
    if (std::isinf(left_m) || std::isinf(right_m)) return left_m == right_m;
    return std::abs(left_m - right_m) <=
           4.0 * sensor_.range.cell_m + 0.05 * std::min(left_m, right_m);
  }
  void add_block(int block);
  void add_interval(std::size_t i, const std::vector<Profile>& nodes, double free_low_m,
                    double free_high_m, std::vector<double>& range_W,
                    std::vector<double>& row_W_m3) const;

  const World& world_;
  const sensors::Sensor& sensor_;
  const sensors::AntennaFrame& antenna_;
  int subs_;
  FanSums& sums_;
  RainDirections directions_;
  std::vector<double> borders_;
  std::vector<double> gain_rad_;  // per interval
  int nodes_ = 0;
  double node_step_rad_ = 0.0;
  std::vector<std::vector<double>> free_m_;  // [border between blocks][border of elevations]
  std::vector<Profile> beside_cells_;        // of every azimuth without one, where they share
};

// Adds one interval: free up to the nearer of the two distances, half way between them by half.
void Echo::add_interval(std::size_t i, const std::vector<Profile>& nodes, double free_low_m,
                        double free_high_m, std::vector<double>& range_W,
                        std::vector<double>& row_W_m3) const {
  const double position =
      std::clamp(((borders_[i] + borders_[i + 1]) / 2.0 - borders_.front()) / node_step_rad_, 0.0,
                 nodes_ - 1.0 - 1e-9);
  const auto node = static_cast<std::size_t>(position);
  const double upper = gain_rad_[i] * (position - static_cast<double>(node));
  const double lower = gain_rad_[i] - upper;
  const double nearer_m = std::min(free_low_m, free_high_m);
  const double farther_m = std::max(free_low_m, free_high_m);
  if (farther_m <= sensor_.range.minimum_m) return;
  const Profile& below = nodes[node];
  const Profile& above = nodes[node + 1];
  const int whole = cells_within(nearer_m);
  add_mixed(below.power_W.data(), lower, above.power_W.data(), upper, whole, range_W.data());
  double sum_W_m3 = lower * below.before_W_m3[static_cast<std::size_t>(whole)] +
                    upper * above.before_W_m3[static_cast<std::size_t>(whole)];
  for (int cell = whole; cell < sensor_.range.cells; ++cell) {
    const double range_m = sensors::range_middle_m(sensor_.range, cell);
    if (range_m >= farther_m) break;
    const double share =
        farther_m == kUnlimited_m ? 0.5 : (farther_m - range_m) / (farther_m - nearer_m);
    const auto k = static_cast<std::size_t>(cell);
    const double added_W = share * (lower * below.power_W[k] + upper * above.power_W[k]);
    range_W[k] += added_W;
    sum_W_m3 += added_W * range_m * range_m * range_m;
  }
  if (row_W_m3.empty()) return;
  const sensors::Display& display = sensor_.display;
  const double rows_per_rad = display.cscope_rows / display.cscope_span_rad;
  deposit((display.cscope_top_rad - borders_[i + 1]) * rows_per_rad,
          (display.cscope_top_rad - borders_[i]) * rows_per_rad, sum_W_m3, row_W_m3.data(),
          sums_.rows);
}

// What both sides of a block agree on is of all its sub-columns, a silhouette is of each.
void Echo::add_block(int block) {
  const int first = first_of(block), last = first_of(block + 1);
  const double middle_rad = azimuth_rad(block);
  const std::vector<double>& left_m = free_m_[static_cast<std::size_t>(block)];
  const std::vector<double>& right_m = free_m_[static_cast<std::size_t>(block) + 1];
  // Kept by the thread from block to block.
  thread_local std::vector<double> range_W, row_W_m3, own_range_W, own_row_W_m3, free;
  thread_local std::vector<Profile> own;
  thread_local std::vector<std::size_t> borders, intervals;  // that a silhouette cuts
  range_W.assign(static_cast<std::size_t>(sums_.cells), 0.0);
  row_W_m3.assign(static_cast<std::size_t>(sums_.rows), 0.0);
  const bool common = directions_.shared && !cells_in(middle_rad);
  if (!common) profiles(middle_rad, true, own);
  const std::vector<Profile>& nodes = common ? beside_cells_ : own;
  borders.clear();
  intervals.clear();
  free.resize(left_m.size());
  for (std::size_t i = 0; i < free.size(); ++i) {
    free[i] = (left_m[i] + right_m[i]) / 2.0;
    const bool cut = !alike(left_m[i], right_m[i]);
    const bool cut_before = !borders.empty() && borders.back() + 1 == i;
    if (cut) borders.push_back(i);
    if (i == 0) continue;
    if (cut || cut_before)
      intervals.push_back(i - 1);
    else
      add_interval(i - 1, nodes, free[i - 1], free[i], range_W, row_W_m3);
  }
  const auto add = [](const std::vector<double>& from, double* to) {
    for (std::size_t k = 0; k < from.size(); ++k) to[k] += from[k];
  };
  for (auto sub = static_cast<std::size_t>(first); sub < static_cast<std::size_t>(last); ++sub) {
    if (!intervals.empty()) {
      own_range_W.assign(range_W.size(), 0.0);
      own_row_W_m3.assign(row_W_m3.size(), 0.0);
      const double sub_rad = fan_azimuth_rad(static_cast<double>(sub) + 0.5);
      for (const std::size_t i : borders) free[i] = free_m(sub_rad, borders_[i]);
      for (const std::size_t i : intervals)
        add_interval(i, nodes, free[i], free[i + 1], own_range_W, own_row_W_m3);
    }
    double* const range_sums = &sums_.range_W_per_rad[sub * range_W.size()];
    add(range_W, range_sums);
    if (!intervals.empty()) add(own_range_W, range_sums);
    if (row_W_m3.empty()) continue;
    double* const row_sums = &sums_.elevation_W_m3_per_rad[sub * row_W_m3.size()];
    add(row_W_m3, row_sums);
    if (!intervals.empty()) add(own_row_W_m3, row_sums);
  }
}

}  // namespace

RainDirections rain_directions(const World& world, const sensors::AntennaFrame& antenna) {
  const sensors::Sensor& sensor = world.sensor;
  const sensors::HeightSpan beam = sensors::heights_in_beam(antenna, sensor);
  const bool one_layer = world.volume_echo->same_at_all_heights(beam.lowest_m, beam.highest_m);
  // Rain cells are looked for in vertical half-planes, which azimuths of one that leans are not quite.
  const double leans_m = std::hypot(antenna.up.x, antenna.up.y) * sensor.range.maximum_m();
  const bool leans_little = sensor.scan.surface == sensors::ScanSurface::plane &&
                            antenna.up.z > 0.0 && leans_m <= kSharedHeight_m &&
                            !world.volume_echo->has_cells();
  return {one_layer ? kSmoothStep_rad : kLayeredStep_rad,
          azimuths_are_upright(antenna, sensor.scan.surface) ||
              (one_layer && leans_little &&
               world.attenuation.same_layer(beam.lowest_m, beam.highest_m))};
}

void add_rain_echo(const World& world, const sensors::AntennaFrame& antenna,
                   int sub_columns_per_column, FanSums& sums) {
  Echo(world, antenna, sub_columns_per_column, sums).run();
}

double rain_echo_bound_dB(const SceneFacts& facts) {
  AddedPower added = largest_echo({.eta_m2_per_m3 = facts.largest_eta_m2_per_m3},
                                  whole_beam(facts.sensor), facts.sensor);
  added.cell_W = largest_spread(facts.sensor, added.cell_W);
  return largest_change_dB(added, facts);
}

}  // namespace fanbeam::renderer
