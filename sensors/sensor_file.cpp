#include "sensors/sensor_file.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/config_table.h"
#include "core/constants.h"
#include "core/decibel.h"
#include "core/units.h"
#include "sensors/antenna/antenna_reader.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/antenna/frequency_scan_file.h"
#include "sensors/display/grey_reader.h"
#include "sensors/receiver/window_file.h"

namespace fanbeam::sensors {
namespace {

using core::ConfigTable;
using core::ErrorClass;
using core::number_text;
using core::NumberRange;
using core::radians;

constexpr std::int64_t kMostColumns = 4096;
constexpr std::int64_t kMostRows = 16384;
constexpr std::int64_t kMostCells = 16777216;  // of one picture
constexpr std::int64_t kMostLooks = 1000;
constexpr double kLeastAngle_deg = 0.01;  // of a field of view and a C-scope

NumberRange above_zero(double high) { return {0.0, high, true}; }

double required_angle_rad(ConfigTable& table, std::string_view key, NumberRange range_deg) {
  return radians(table.required_number(key, range_deg));
}

double angle_rad(ConfigTable& table, std::string_view key, NumberRange range_deg) {
  return radians(table.number(key, range_deg, 0.0));
}

int whole(ConfigTable& table, std::string_view key, std::int64_t most, std::int64_t fallback) {
  return static_cast<int>(table.integer(key, 1, most, fallback));
}

int required_whole(ConfigTable& table, std::string_view key, std::int64_t most) {
  if (!table.has(key))
    table.error(ErrorClass::ref, key, "missing", "a whole number, 1 to " + std::to_string(most));
  return whole(table, key, most, 1);
}

void read_scan(ConfigTable table, Scan& scan) {
  scan.surface = static_cast<ScanSurface>(table.choice("surface", {"plane", "cone"}, 0));
  const double widest_deg = scan.surface == ScanSurface::cone ? 180.0 : 360.0;
  scan.field_of_view_rad =
      required_angle_rad(table, "field_of_view_deg", {kLeastAngle_deg, widest_deg});
  scan.columns = required_whole(table, "columns", kMostColumns);
  scan.frame_rate_Hz = table.required_number("frame_rate_Hz", {1e-3, 1000.0});
  scan.stabilised = table.boolean("stabilised", true);
  read_sweep(table, scan);
}

// As many whole cells as fit between the minimum and `maximum_m`. A last one that ends beyond it by
// the rounding of these decimal numbers fits.
int cells_up_to(ConfigTable& table, const RangeGate& gate, double maximum_m) {
  if (!(maximum_m > gate.minimum_m)) {
    table.error(ErrorClass::range, "maximum_m", number_text(maximum_m),
                "above minimum_m = " + number_text(gate.minimum_m));
    return 1;
  }
  if (!(gate.cell_m > 0.0)) return 1;  // refused already
  constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
  const double cells = std::floor((maximum_m - gate.minimum_m + kRounding * maximum_m) /
                                  gate.cell_m * (1.0 + kRounding));
  if (cells >= 1.0 && cells <= static_cast<double>(kMostRows)) return static_cast<int>(cells);
  table.error(cells < 1.0 ? ErrorClass::range : ErrorClass::limit, "maximum_m",
              number_text(maximum_m) + " (" + number_text(cells) + " cells)",
              "1 to " + std::to_string(kMostRows) + " cells of cell_m");
  return 1;
}

// Returns the end of the window as the file states it; the last whole cell may end before.
double read_range(ConfigTable table, RangeGate& gate, std::int64_t columns) {
  gate.minimum_m = table.required_number("minimum_m", {0.0, 1e6});
  gate.cell_m = table.required_number("cell_m", {1e-3, 1e5});
  const auto maximum_m = table.optional_number("maximum_m", above_zero(1e9));
  if (!table.has("maximum_m")) {
    gate.cells = required_whole(table, "cells", kMostRows);
  } else {
    if (table.has("cells"))
      table.error(ErrorClass::range, "cells", "given with maximum_m", "either cells or maximum_m");
    gate.cells = whole(table, "cells", kMostRows, 1);
    if (maximum_m) gate.cells = cells_up_to(table, gate, *maximum_m);
  }
  if (columns * gate.cells > kMostCells)
    table.error(ErrorClass::limit, "cells",
                std::to_string(columns * gate.cells) + " with all columns",
                "at most " + std::to_string(kMostCells) + " columns x cells");
  return maximum_m.value_or(gate.maximum_m());
}

void read_waveform(ConfigTable table, Waveform& waveform) {
  waveform.frequency_Hz = 1e9 * table.required_number("frequency_GHz", {0.1, 300.0});
  waveform.bandwidth_Hz = 1e6 * table.required_number("bandwidth_MHz", above_zero(1e5));
  waveform.transmit_power_W = table.required_number("transmit_power_W", {1e-12, 1e9});
  read_window(table, waveform);
  waveform.doppler_compensated = table.boolean("doppler_compensated", true);
  waveform.doppler_place = table.place("doppler_compensated");
  waveform.polarisation =
      static_cast<core::Polarisation>(table.choice("polarisation", {"HH", "VV"}, 0));
}

void check_bandwidth(ConfigTable table, const Waveform& waveform, const RangeGate& gate) {
  const double bin_m = core::kSpeedOfLight_mps / (2.0 * waveform.bandwidth_Hz);
  const double window_m = gate.maximum_m() - gate.minimum_m;
  const std::string found = number_text(waveform.bandwidth_Hz / 1e6);
  if (bin_m > window_m)
    table.error(ErrorClass::range, "bandwidth_MHz", found,
                "at least " + number_text(core::kSpeedOfLight_mps / (2e6 * window_m)) +
                    ", one bin in the range window");
  else if (bin_m > 1.01 * gate.cell_m)
    table.warning("RESOLUTION", "bandwidth_MHz", found,
                  "range cells of " + number_text(gate.cell_m) +
                      " m are kept, finer than c / 2B = " + number_text(bin_m) + " m");
}

// Casters sample a column in a few places, which are close together for a beam that is wider.
void check_columns(ConfigTable table, const Scan& scan, const BeamCut& beam) {
  const double column_rad = scan.column_width_rad();
  // Equal ones, such as 35.2 deg in 44 columns under 0.8 deg, may differ in their last digits.
  if (column_rad > beam.half_power_width_rad * (1.0 + 1e-9))
    table.warning("COLUMNS", "columns", std::to_string(scan.columns),
                  "kept: of " + number_text(core::rounded_degrees(column_rad)) +
                      " deg, wider than the beam of " +
                      number_text(core::rounded_degrees(beam.half_power_width_rad)) +
                      " deg, whose pictures err by more than their estimates say");
}

// What the beam reaches on both sides of the field of view is seen in columns as well. Four times the largest picture
// is half a gigabyte of sums.
void check_margin(ConfigTable table, const Sensor& sensor) {
  const double columns = 2.0 * reach_rad(sensor.antenna.azimuth) / sensor.scan.column_width_rad() +
                         sensor.scan.columns;
  if (columns * sensor.range.cells > static_cast<double>(4 * kMostCells))
    table.error(
        ErrorClass::limit, "columns", std::to_string(sensor.scan.columns),
        "fewer or wider ones: with what the beam reaches beside the field of view they are " +
            number_text(std::ceil(columns)) + ", at most " +
            number_text(std::floor(4.0 * kMostCells / sensor.range.cells)) + " of " +
            std::to_string(sensor.range.cells) + " range cells");
}

void read_receiver(ConfigTable table, const Scan& scan, Receiver& receiver) {
  receiver.noise_figure = core::power_from_dB(table.number("noise_figure_dB", {0.0, 60.0}, 0.0));
  receiver.loss = core::power_from_dB(table.number("loss_dB", {0.0, 60.0}, 0.0));
  receiver.looks = whole(table, "looks", kMostLooks, 1);
  receiver.false_alarm_probability =
      table.number("false_alarm_probability", {1e-15, 0.1}, receiver.false_alarm_probability);
  const double longest_s =
      scan.frame_rate_Hz > 0.0 ? 1.0 / (scan.frame_rate_Hz * scan.columns * receiver.looks) : 1.0;
  // A dwell rounded to the digits of a sensor file may end a little after its column.
  const double longest_us = 1e6 * longest_s * (1.0 + 1e-6);
  const NumberRange range_us{std::min(1e-3, longest_us), longest_us};
  const auto dwell_us = table.optional_number("dwell_us", range_us);
  receiver.dwell_s = dwell_us ? 1e-6 * *dwell_us : longest_s;
}

void read_mounting(ConfigTable table, Mounting& mounting) {
  mounting.forward_m = table.number("forward_m", {-1000.0, 1000.0}, 0.0);
  mounting.right_m = table.number("right_m", {-1000.0, 1000.0}, 0.0);
  mounting.down_m = table.number("down_m", {-1000.0, 1000.0}, 0.0);
  mounting.yaw_rad = angle_rad(table, "yaw_deg", {-180.0, 180.0});
  mounting.pitch_rad = angle_rad(table, "pitch_deg", {-90.0, 90.0});
  mounting.roll_rad = angle_rad(table, "roll_deg", {-180.0, 180.0});
}

void read_cscope(ConfigTable table, const Sensor& sensor, Display& display) {
  display.cscope_mode =
      static_cast<Display::CScopeMode>(table.choice("mode", Display::kCScopeModes, 0));
  const double beam_deg = core::degrees(sensor.antenna.elevation.half_power_width_rad);
  const double boresight_deg = core::degrees(sensor.antenna.boresight_elevation_rad);
  const double span_deg = table.number("span_deg", {kLeastAngle_deg, 180.0}, beam_deg);
  const double top_deg = table.number("top_deg", {-90.0, 90.0}, boresight_deg + 0.5 * span_deg);
  if (table.has("top_deg") && table.has("span_deg") && top_deg - span_deg < -90.0)
    table.error(ErrorClass::range, "span_deg", number_text(span_deg),
                "at most " + number_text(top_deg + 90.0) + ", down to -90 deg");
  display.cscope_span_rad = radians(span_deg);
  display.cscope_top_rad = radians(top_deg);
  display.cscope_rows = whole(table, "rows", kMostRows, sensor.range.cells);
  const std::int64_t cells = std::int64_t{sensor.scan.columns} * display.cscope_rows;
  if (cells > kMostCells)
    table.error(ErrorClass::limit, "rows", std::to_string(cells) + " cells with all columns",
                "at most " + std::to_string(kMostCells) + " columns x rows");
}

void read_display(ConfigTable table, const Sensor& sensor, Display& display) {
  read_grey_mapping(table, sensor.range, display);
  read_cscope(table.table("cscope"), sensor, display);
}

void read_seed(ConfigTable table, double maximum_m, Sensor& sensor) {
  SeedConvention& seed = sensor.seed;
  seed.active = table.present();
  if (!seed.active) return;
  seed.speed_of_light_mps =
      table.number("speed_of_light_mps", {2.9e8, 3.1e8}, core::kSpeedOfLight_mps);
  seed.pulse_s = 1e-6 * table.required_number("pulse_us", above_zero(1e6));
  seed.elevation_minimum_rad = angle_rad(table, "elevation_minimum_deg", {0.0, 89.0});
  seed.azimuth_patch_rad = sensor.antenna.azimuth.half_power_width_rad;
  seed.maximum_range_m = maximum_m;
}

void read_assumed(ConfigTable& root, Sensor& sensor) {
  sensor.assumed = root.texts("assumed");
  const auto& known = root.resolved();
  for (const std::string& name : sensor.assumed) {
    const bool found = std::any_of(known.begin(), known.end(),
                                   [&](const auto& value) { return value.first == name; });
    if (!found) root.error(ErrorClass::ref, "assumed", name, "a key of sensor files");
  }
}

Sensor read(ConfigTable root, const core::ProblemList& problems) {
  Sensor sensor;
  if (problems.has_errors()) return sensor;  // no file, or no TOML
  sensor.name = root.required_text("name");
  read_antenna(root.table("antenna"), sensor.antenna);
  read_scan(root.table("scan"), sensor.scan);
  const double maximum_m = read_range(root.table("range"), sensor.range, sensor.scan.columns);
  read_waveform(root.table("waveform"), sensor.waveform);
  read_receiver(root.table("receiver"), sensor.scan, sensor.receiver);
  read_mounting(root.table("mounting"), sensor.mounting);
  read_display(root.table("display"), sensor, sensor.display);
  read_seed(root.table("seed"), maximum_m, sensor);
  read_assumed(root, sensor);
  root.report_unknown_keys();
  if (problems.has_errors()) return sensor;  // what follows combines values that must each be valid
  check_gain(root.table("antenna"), sensor.antenna);
  check_sweep(root.table("scan"), root.table("waveform"), sensor);
  check_bandwidth(root.table("waveform"), sensor.waveform, sensor.range);
  check_columns(root.table("scan"), sensor.scan, sensor.antenna.azimuth);
  check_margin(root.table("scan"), sensor);
  return sensor;
}

}  // namespace

Sensor read_sensor(const std::filesystem::path& file, core::ProblemList& problems) {
  core::ProblemList own;  // errors of other files must not stop the checks of this one
  const Sensor sensor = read(ConfigTable::from_file(file, own), own);
  problems.append(own.all());
  return sensor;
}

Sensor read_sensor_text(std::string_view text, const std::string& file_name,
                        core::ProblemList& problems) {
  core::ProblemList own;
  const Sensor sensor = read(ConfigTable::from_text(text, file_name, own), own);
  problems.append(own.all());
  return sensor;
}

}  // namespace fanbeam::sensors
