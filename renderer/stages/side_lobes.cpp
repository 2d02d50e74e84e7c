#include "renderer/stages/side_lobes.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "renderer/plan/display_floor.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/cells.h"

namespace fanbeam::renderer {
namespace {

// Sums of all sub-columns left of each edge, [sub-column edge][bin].
std::vector<double> running_sums(const std::vector<double>& sums, std::size_t bins,
                                 std::size_t sub_columns) {
  std::vector<double> left_of((sub_columns + 1) * bins, 0.0);
  for (std::size_t s = 0; s < sub_columns; ++s)
    for (std::size_t bin = 0; bin < bins; ++bin)
      left_of[(s + 1) * bins + bin] = left_of[s * bins + bin] + sums[s * bins + bin];
  return left_of;
}

// A place between sub-column edges, for interpolation in a running sum.
struct FanPlace {
  std::size_t edge = 0;
  double share = 0.0;
};

FanPlace place_in(const FanSums& fan, double azimuth_rad) {
  const double position = std::clamp((azimuth_rad - fan.first_azimuth_rad) / fan.step_rad, 0.0,
                                     static_cast<double>(fan.sub_columns));
  const auto edge =
      std::min(static_cast<std::size_t>(position), static_cast<std::size_t>(fan.sub_columns - 1));
  return {edge, position - static_cast<double>(edge)};
}

double lobe_width_rad(const sensors::Sensor& sensor) {
  const sensors::BeamCut& azimuth = sensor.antenna.azimuth;
  if (!(azimuth.side_lobe_gain > 0.0)) return 0.0;
  const double fan_rad = sensor.scan.field_of_view_rad + 2.0 * azimuth.cut_rad;
  return std::min(2.0 * (azimuth.side_lobe_extent_rad - azimuth.cut_rad), fan_rad);
}

// Two-way power that the azimuth's side lobes collect over that of its main beam.
double azimuth_lobes(const sensors::Sensor& sensor) {
  const sensors::BeamCut& azimuth = sensor.antenna.azimuth;
  const double main_rad = sensors::two_way_width(sensors::main_beam(azimuth));
  const double level = azimuth.side_lobe_gain * azimuth.side_lobe_gain;
  return (level * lobe_width_rad(sensor) + sensors::two_way_width(azimuth) - main_rad) / main_rad;
}

// The largest two-way gain outside the elevation's main beam.
double elevation_lobes(const sensors::BeamCut& elevation) {
  constexpr int kSteps = 4096;
  const double null_rad = sensors::main_beam(elevation).cut_rad;
  double most = elevation.side_lobe_gain * elevation.side_lobe_gain;
  for (int i = 1; i <= kSteps && null_rad < elevation.cut_rad; ++i)
    most = std::max(most, sensors::two_way_gain(
                              elevation, null_rad + (elevation.cut_rad - null_rad) * i / kSteps));
  return most;
}

}  // namespace

void add_azimuth_side_lobes(const std::vector<double>& sums, int bins, const FanSums& fan,
                            const sensors::Sensor& sensor, std::vector<double>& image) {
  const sensors::BeamCut& azimuth = sensor.antenna.azimuth;
  const double level = azimuth.side_lobe_gain * azimuth.side_lobe_gain;
  if (!(level > 0.0)) return;
  const auto bin_count = static_cast<std::size_t>(bins);
  const auto columns = static_cast<std::size_t>(sensor.scan.columns);
  const std::vector<double> left_of =
      running_sums(sums, bin_count, static_cast<std::size_t>(fan.sub_columns));
  const auto between = [&](const FanPlace& from, const FanPlace& to, std::size_t bin) {
    const auto at = [&](const FanPlace& place) {
      const double low = left_of[place.edge * bin_count + bin];
      return low + place.share * (left_of[(place.edge + 1) * bin_count + bin] - low);
    };
    return std::max(at(to) - at(from), 0.0);
  };
  core::parallel_for(columns, [&](std::size_t column) {
    const double centre_rad = sensors::column_middle_rad(sensor.scan, static_cast<int>(column));
    const FanPlace left_end = place_in(fan, centre_rad - azimuth.side_lobe_extent_rad);
    const FanPlace left_cut = place_in(fan, centre_rad - azimuth.cut_rad);
    const FanPlace right_cut = place_in(fan, centre_rad + azimuth.cut_rad);
    const FanPlace right_end = place_in(fan, centre_rad + azimuth.side_lobe_extent_rad);
    for (std::size_t bin = 0; bin < bin_count; ++bin)
      image[bin * columns + column] +=
          level * fan.step_rad *
          (between(left_end, left_cut, bin) + between(right_cut, right_end, bin));
  });
}

bool has_side_lobes(const SceneFacts& facts) {
  for (const sensors::BeamCut* cut :
       {&facts.sensor.antenna.azimuth, &facts.sensor.antenna.elevation})
    if (sensors::reach_rad(*cut) > sensors::main_beam(*cut).cut_rad) return true;
  return false;
}

double side_lobe_bound_dB(const SceneFacts& facts) {
  const sensors::Display& display = facts.sensor.display;
  const double window_dB = display.high_dB - display.low_dB;
  const double azimuth = azimuth_lobes(facts.sensor);
  const double lobes = azimuth + elevation_lobes(facts.sensor.antenna.elevation) * (1.0 + azimuth);
  return std::min(window_dB, 10.0 * std::log10(1.0 + lobes * brightest_over_floor(facts.sensor)));
}

sensors::Sensor without_side_lobes(const sensors::Sensor& sensor) {
  sensors::Sensor cut = sensor;
  cut.antenna.azimuth = sensors::main_beam(sensor.antenna.azimuth);
  cut.antenna.elevation = sensors::main_beam(sensor.antenna.elevation);
  return cut;
}

}  // namespace fanbeam::renderer
