#include "renderer/plan/largest_echo.h"

#include <algorithm>

#include "core/constants.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/cells.h"

namespace fanbeam::renderer {
namespace {

// Behind every floor, and still a number after a sum over all cells.
constexpr double kUnlimited = 1e200;

double lobe_level_integral_rad(const sensors::BeamCut& cut, double most_rad) {
  const double level = cut.side_lobe_gain * cut.side_lobe_gain;
  if (!(level > 0.0)) return 0.0;
  return level * std::clamp(2.0 * (cut.side_lobe_extent_rad - cut.cut_rad), 0.0, most_rad);
}

// Two paths, both ways.
constexpr double kMirrored = 16.0;

double over(double value, double divisor) {
  if (value == 0.0) return 0.0;
  return divisor > 0.0 ? std::min(value / divisor, kUnlimited) : kUnlimited;
}

// The largest r^3 over the square of the product of two paths whose mean is r.
double mirrored_per_m(const sensors::RangeGate& gate) {
  const auto at = [&](double range_m) {
    const double paths_m2 = gate.minimum_m * (2.0 * range_m - gate.minimum_m);
    return over(range_m * range_m * range_m, paths_m2 * paths_m2);
  };
  // It falls, then rises.
  return std::max(at(gate.minimum_m), at(gate.maximum_m()));
}

}  // namespace

bool corners_possible(const SceneFacts& facts) { return facts.mirrored_rays_end && facts.reflects; }

bool mirrored_targets_possible(const SceneFacts& facts) {
  return facts.has_point_targets && facts.ground_reflects;
}

EchoSources all_sources(const SceneFacts& facts) {
  const bool mirrored = mirrored_targets_possible(facts);
  return {facts.largest_sigma0_over_sine, facts.largest_eta_m2_per_m3,
          mirrored ? 0.0 : facts.rcs_sum_m2, mirrored ? facts.rcs_sum_m2 : 0.0};
}

double azimuth_level_rad(const sensors::Sensor& sensor) {
  const sensors::BeamCut& cut = sensor.antenna.azimuth;
  return lobe_level_integral_rad(cut, sensor.scan.field_of_view_rad + 2.0 * cut.cut_rad);
}

double elevation_level_rad(const sensors::Sensor& sensor) {
  return lobe_level_integral_rad(sensor.antenna.elevation, core::kPi);
}

double azimuth_width_rad(const sensors::Sensor& sensor) {
  return sensors::two_way_width(sensor.antenna.azimuth) + azimuth_level_rad(sensor);
}

double elevation_width_rad(const sensors::Sensor& sensor) {
  return sensors::two_way_width(sensor.antenna.elevation) + elevation_level_rad(sensor);
}

double cscope_row_rad(const sensors::Display& display) {
  return display.cscope_span_rad / display.cscope_rows;
}

BeamPart whole_beam(const sensors::Sensor& sensor) {
  const double azimuth_rad = azimuth_width_rad(sensor);
  return {azimuth_rad * elevation_width_rad(sensor), azimuth_rad * cscope_row_rad(sensor.display),
          1.0};
}

AddedPower largest_echo(const EchoSources& sources, const BeamPart& part,
                        const sensors::Sensor& sensor) {
  const sensors::RangeGate& gate = sensor.range;
  const double constant_W_m2 = sensor.radar_constant_W_m2();
  AddedPower added;
  double air_m = 0.0;
  for (int cell = 0; cell < gate.cells; ++cell) {
    const double near_m = sensors::range_edge_m(gate, cell);
    const double far_m = sensors::range_edge_m(gate, cell + 1);
    const double middle_m = sensors::range_middle_m(gate, cell);
    const double before_m = near_m - kSpreadCells * gate.cell_m;
    const double surfaces =
        before_m > 0.0 ? over(sources.sigma0_over_sine * part.solid_rad2, before_m * before_m)
                       : over(sources.sigma0_over_sine, 0.0);
    // The stage leaves a cell that begins at the antenna empty.
    const double air_per_m = near_m > 0.0 ? gate.cell_m / (near_m * far_m) : 0.0;
    const double paths_m2 = gate.minimum_m * (2.0 * near_m - gate.minimum_m);
    const double targets =
        over(sources.rcs_m2 * part.gain, near_m * near_m * near_m * near_m) +
        over(kMirrored * sources.mirrored_rcs_m2 * part.gain, paths_m2 * paths_m2);
    added.cell_W.push_back(
        constant_W_m2 * (surfaces + sources.eta_m2_per_m3 * part.solid_rad2 * air_per_m + targets));
    air_m += air_per_m * middle_m * middle_m * middle_m;
  }
  added.row_W_m3 =
      constant_W_m2 * (part.row_solid_rad2 * (sources.sigma0_over_sine * gate.maximum_m() +
                                              sources.eta_m2_per_m3 * air_m) +
                       over(sources.rcs_m2 * part.gain, gate.minimum_m) +
                       kMirrored * sources.mirrored_rcs_m2 * part.gain * mirrored_per_m(gate));
  return added;
}

}  // namespace fanbeam::renderer
