#include "renderer/stages/side_lobes.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "renderer/plan/largest_echo.h"
#include "renderer/stages/range_response.h"
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

// The largest two-way gain outside the main beam.
double largest_lobe(const sensors::BeamCut& cut) {
  constexpr int kSteps = 4096;
  const double null_rad = sensors::main_beam(cut).cut_rad;
  double most = cut.side_lobe_gain * cut.side_lobe_gain;
  for (int i = 1; i <= kSteps && null_rad < cut.cut_rad; ++i)
    most = std::max(most,
                    sensors::two_way_gain(cut, null_rad + (cut.cut_rad - null_rad) * i / kSteps));
  return most;
}

// Displays of mapping stc, and seed without a width of its own, count in beam widths, and lobes inside
// the cut are part of the beam.
double scale_change_dB(const sensors::Sensor& sensor) {
  using Mapping = sensors::Display::Mapping;
  const Mapping mapping = sensor.display.mapping;
  if (mapping == Mapping::log || (mapping == Mapping::seed && sensor.seed.active)) return 0.0;
  const sensors::BeamCut& azimuth = sensor.antenna.azimuth;
  return 10.0 * std::log10(sensors::two_way_width(azimuth) /
                           sensors::two_way_width(sensors::main_beam(azimuth)));
}

// What the whole beam has beyond the main beams.
BeamPart side_lobes(const sensors::Sensor& sensor) {
  // A faint level would drown in the difference of whole and main beam.
  const auto beyond_null_rad = [](const sensors::BeamCut& cut) {
    return sensors::two_way_width(cut) - sensors::two_way_width(sensors::main_beam(cut));
  };
  const sensors::Antenna& antenna = sensor.antenna;
  const double main_azimuth_rad = sensors::two_way_width(sensors::main_beam(antenna.azimuth));
  const double azimuth_lobes_rad = beyond_null_rad(antenna.azimuth) + azimuth_level_rad(sensor);
  const double elevation_lobes_rad =
      beyond_null_rad(antenna.elevation) + elevation_level_rad(sensor);
  const double largest_elevation = largest_lobe(antenna.elevation);
  return {
      azimuth_lobes_rad * elevation_width_rad(sensor) + main_azimuth_rad * elevation_lobes_rad,
      (azimuth_lobes_rad + main_azimuth_rad * largest_elevation) * cscope_row_rad(sensor.display),
      std::max(largest_lobe(antenna.azimuth), largest_elevation)};
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
  // Lobes in elevation change how the two paths to a target cancel; of corners: see the header.
  const sensors::BeamCut& elevation = facts.sensor.antenna.elevation;
  const bool elevation_lobes =
      sensors::reach_rad(elevation) > sensors::main_beam(elevation).cut_rad;
  if (corners_possible(facts) || (elevation_lobes && mirrored_targets_possible(facts)))
    return window_dB(facts.sensor);
  AddedPower added = largest_echo(all_sources(facts), side_lobes(facts.sensor), facts.sensor);
  added.cell_W = largest_spread(facts.sensor, added.cell_W);
  return std::max(largest_change_dB(added, facts), scale_change_dB(facts.sensor));
}

sensors::Sensor without_side_lobes(const sensors::Sensor& sensor) {
  sensors::Sensor cut = sensor;
  cut.antenna.azimuth = sensors::main_beam(sensor.antenna.azimuth);
  cut.antenna.elevation = sensors::main_beam(sensor.antenna.elevation);
  return cut;
}

}  // namespace fanbeam::renderer
