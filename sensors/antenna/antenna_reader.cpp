#include "sensors/antenna/antenna_reader.h"

#include <cmath>
#include <optional>
#include <string>

#include "core/decibel.h"
#include "core/units.h"
#include "sensors/antenna/beam_cut_file.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::sensors {
namespace {

using core::ConfigTable;
using core::ErrorClass;
using core::number_text;

constexpr core::NumberRange kGainRange{1e-9, 1e9};

double stated_gain(ConfigTable& table) {
  const bool in_dB = table.has("peak_gain_dB");
  const double from_dB =
      core::power_from_dB(table.optional_number("peak_gain_dB", {-90.0, 90.0}).value_or(0.0));
  if (!in_dB) return table.required_number("peak_gain", kGainRange);
  if (table.optional_number("peak_gain", kGainRange))
    table.error(ErrorClass::range, "peak_gain", "given twice", "either peak_gain or peak_gain_dB");
  return from_dB;
}

// A pattern file's gain counts only when the sensor file says so.
double file_gain(ConfigTable& table, const std::optional<double>& azimuth,
                 const std::optional<double>& elevation) {
  const char* const key = "peak_gain_from_file";
  for (const char* other : {"peak_gain", "peak_gain_dB"})
    if (table.has(other))
      table.error(ErrorClass::range, other, "given twice", std::string("either it or ") + key);
  if (!azimuth && !elevation) {
    table.error(ErrorClass::ref, key, "true", "a cut from an .msi file with a GAIN line");
    return 1.0;
  }
  if (azimuth && elevation && std::abs(*azimuth / *elevation - 1.0) > 0.001)
    table.error(ErrorClass::range, key, "two files with different GAIN", "one gain for both cuts");
  return azimuth ? *azimuth : *elevation;
}

}  // namespace

void read_antenna(ConfigTable table, Antenna& antenna) {
  antenna.boresight_elevation_rad =
      core::radians(table.number("boresight_elevation_deg", {-90.0, 90.0}, 0.0));
  ConfigTable azimuth_table = table.table("azimuth");
  ConfigTable elevation_table = table.table("elevation");
  const ReadCut azimuth = read_beam_cut(azimuth_table, PatternPlane::azimuth, 0.0);
  const ReadCut elevation =
      read_beam_cut(elevation_table, PatternPlane::elevation, antenna.boresight_elevation_rad);
  antenna.azimuth = azimuth.cut;
  antenna.elevation = elevation.cut;
  for (const ReadCut* read : {&azimuth, &elevation})
    if (!read->file.empty()) antenna.pattern_files.push_back(read->file);
  antenna.peak_gain = table.boolean("peak_gain_from_file", false)
                          ? file_gain(table, azimuth.file_peak_gain, elevation.file_peak_gain)
                          : stated_gain(table);
  antenna.efficiency = table.optional_number("efficiency", {0.0, 1.0, true}).value_or(0.0);
}

// A gain above the directivity would create energy.
void check_gain(ConfigTable table, Antenna& antenna) {
  const char* const gain_key = table.has("peak_gain")      ? "peak_gain"
                               : table.has("peak_gain_dB") ? "peak_gain_dB"
                                                           : "peak_gain_from_file";
  const double most = directivity(antenna, ScanSurface::cone);
  const double efficiency = antenna.peak_gain / most;
  if (efficiency > 1.0)
    table.error(ErrorClass::range, gain_key, number_text(antenna.peak_gain) + " (linear)",
                "at most the directivity of the pattern, " + number_text(most));
  else if (antenna.efficiency != 0.0 && std::abs(antenna.efficiency / efficiency - 1.0) > 0.01)
    table.error(ErrorClass::range, "efficiency", number_text(antenna.efficiency),
                "peak gain over directivity, " + number_text(efficiency) + ", within 1 %");
  antenna.efficiency = efficiency;
}

}  // namespace fanbeam::sensors
