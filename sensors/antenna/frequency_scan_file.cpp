#include "sensors/antenna/frequency_scan_file.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "core/units.h"
#include "sensors/antenna/frequency_scan.h"
#include "sensors/receiver/point_response.h"

namespace fanbeam::sensors {
namespace {

using core::ErrorClass;
using core::number_text;

constexpr std::size_t kMostScanRows = 4096;
constexpr std::int64_t kHighestMode = 1000;
constexpr double kMostBinsPerCell = 100.0;
constexpr double kSweepTolerance = 0.01;

std::vector<double> increasing(core::ConfigTable& table, const char* key, core::NumberRange range) {
  std::vector<double> values = table.numbers(key, range, 2, kMostScanRows);
  if (!table.has(key)) table.error(ErrorClass::ref, key, "missing", "an array of numbers");
  const auto bad = std::adjacent_find(values.begin(), values.end(), std::greater_equal<>());
  if (bad != values.end())
    table.error(ErrorClass::range, key, number_text(*std::next(bad)), "values that increase");
  return values;
}

FrequencyScan read_frequency_scan(core::ConfigTable table) {
  FrequencyScan scan;
  scan.law = static_cast<FrequencyScan::Law>(table.choice("law", {"feed_line", "table"}, 0));
  if (scan.law == FrequencyScan::Law::feed_line) {
    scan.line_length_per_spacing = table.required_number("line_length_per_spacing", {1.0, 1000.0});
    scan.cutoff_Hz = 1e9 * table.number("cutoff_GHz", {0.0, 1000.0}, 0.0);
    scan.spacing_m = 1e-3 * table.required_number("spacing_mm", {0.1, 100.0});
    if (!table.has("mode"))
      table.error(ErrorClass::ref, "mode", "missing", "a whole number, 0 to 1000");
    scan.mode = static_cast<int>(table.integer("mode", 0, kHighestMode, 0));
    return scan;
  }
  for (const double f : increasing(table, "table_frequency_GHz", {0.0, 1000.0, true}))
    scan.table_frequency_Hz.push_back(1e9 * f);
  for (const double azimuth_deg : increasing(table, "table_azimuth_deg", {-90.0, 90.0}))
    scan.table_azimuth_rad.push_back(core::radians(azimuth_deg));
  if (scan.table_azimuth_rad.size() != scan.table_frequency_Hz.size())
    table.error(
        ErrorClass::range, "table_azimuth_deg",
        std::to_string(scan.table_azimuth_rad.size()) + " values",
        "one for each of the " + std::to_string(scan.table_frequency_Hz.size()) + " frequencies");
  return scan;
}

}  // namespace

void read_sweep(core::ConfigTable& table, Scan& scan) {
  scan.sweep = static_cast<Scan::Sweep>(table.choice("sweep", {"per-column", "whole-scan"}, 0));
  const bool by_frequency = table.choice("steering", {"mechanical", "frequency"}, 0) == 1;
  if (by_frequency) scan.frequency_scan = read_frequency_scan(table.table("frequency_scan"));
}

void check_sweep(core::ConfigTable scan, core::ConfigTable waveform, const Sensor& sensor) {
  const bool whole_scan = sensor.scan.sweep == Scan::Sweep::whole_scan;
  if (whole_scan && sensor.waveform.window != Waveform::Window::none)
    waveform.error(ErrorClass::unsupported, "window", "a window with scan.sweep = \"whole-scan\"",
                   "\"none\": the beam passing a target weights its sweep");
  if (has_point_response(sensor)) {
    const double bins = sensor.range.cell_m / PointResponse(sensor, 0).scale_m();
    if (bins > kMostBinsPerCell)
      waveform.error(ErrorClass::range, "bandwidth_MHz",
                     number_text(sensor.waveform.bandwidth_Hz / 1e6),
                     "range cells of at most 100 bins where the range response is simulated");
  }
  if (!sensor.scan.frequency_scan) return;
  const FrequencyScan& law = *sensor.scan.frequency_scan;
  const double edge_rad = sensor.scan.field_of_view_rad / 2;
  const auto low_Hz = frequency_towards_Hz(law, -edge_rad);
  const auto high_Hz = frequency_towards_Hz(law, edge_rad);
  if (!low_Hz || !high_Hz) {
    scan.error(ErrorClass::range, "field_of_view_deg",
               number_text(core::degrees(sensor.scan.field_of_view_rad)),
               "azimuths that scan.frequency_scan reaches");
    return;
  }
  const double carrier_Hz = sensor.waveform.frequency_Hz;
  if (!(carrier_Hz >= *low_Hz && carrier_Hz <= *high_Hz))
    waveform.error(
        ErrorClass::range, "frequency_GHz", number_text(carrier_Hz / 1e9),
        "inside the scan's " + number_text(*low_Hz / 1e9) + " to " + number_text(*high_Hz / 1e9));
  const double sweep_Hz = *high_Hz - *low_Hz;
  if (whole_scan && std::abs(sensor.waveform.bandwidth_Hz / sweep_Hz - 1.0) > kSweepTolerance)
    waveform.error(
        ErrorClass::range, "bandwidth_MHz", number_text(sensor.waveform.bandwidth_Hz / 1e6),
        "the sweep over the field of view, " + number_text(sweep_Hz / 1e6) + ", within 1 %");
  const double neglected_dB = neglected_steering_dB(sensor);
  scan.warning("STEERING", "steering", "\"frequency\"",
               "gain, beam width and wavelength of the picture's centre are kept; a point target "
               "in another column would differ by up to " +
                   number_text(std::round(100.0 * neglected_dB) / 100.0) + " dB");
}

}  // namespace fanbeam::sensors
