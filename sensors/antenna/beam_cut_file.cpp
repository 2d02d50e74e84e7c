#include "sensors/antenna/beam_cut_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>

#include "core/decibel.h"
#include "core/files.h"
#include "core/units.h"

namespace fanbeam::sensors {
namespace {

using core::ErrorClass;
using core::radians;

constexpr double kNarrowest_deg = 0.01;
constexpr std::size_t kMostTableRows = 4096;

// Where the gain, walking from the peak by `step`, passes one half.
double half_power_angle_rad(const BeamCut& cut, std::size_t peak, int step) {
  std::size_t i = peak;
  const std::size_t last = step > 0 ? cut.table_gain.size() - 1 : 0;
  while (i != last && cut.table_gain[i] > 0.5) i += static_cast<std::size_t>(step);
  if (i == peak || cut.table_gain[i] > 0.5) return cut.table_angle_rad[i];
  const std::size_t before = i - static_cast<std::size_t>(step);
  const double share =
      (cut.table_gain[before] - 0.5) / (cut.table_gain[before] - cut.table_gain[i]);
  return cut.table_angle_rad[before] +
         share * (cut.table_angle_rad[i] - cut.table_angle_rad[before]);
}

void set_table_width(core::ConfigTable& table, const char* key, BeamCut& cut) {
  const auto peak = static_cast<std::size_t>(
      std::max_element(cut.table_gain.begin(), cut.table_gain.end()) - cut.table_gain.begin());
  cut.half_power_width_rad =
      half_power_angle_rad(cut, peak, 1) - half_power_angle_rad(cut, peak, -1);
  cut.cut_rad =
      std::max(std::abs(cut.table_angle_rad.front()), std::abs(cut.table_angle_rad.back()));
  if (cut.half_power_width_rad < radians(kNarrowest_deg))
    table.error(ErrorClass::range, key,
                core::number_text(core::degrees(cut.half_power_width_rad)) + " half-power width",
                "at least " + core::number_text(kNarrowest_deg));
}

void read_gain_table(core::ConfigTable& table, BeamCut& cut) {
  const auto angles_deg = table.numbers("table_angle_deg", {-180.0, 180.0}, 2, kMostTableRows);
  const auto gains_dB = table.numbers("table_gain_dB", {-400.0, 0.0}, 2, kMostTableRows);
  for (const char* key : {"table_angle_deg", "table_gain_dB"})
    if (!table.has(key)) table.error(ErrorClass::ref, key, "missing", "an array of numbers");
  if (angles_deg.empty() || gains_dB.empty()) return;

  const auto not_increasing =
      std::adjacent_find(angles_deg.begin(), angles_deg.end(), std::greater_equal<>());
  if (not_increasing != angles_deg.end())
    table.error(ErrorClass::range, "table_angle_deg", core::number_text(*std::next(not_increasing)),
                "angles that increase");
  if (angles_deg.size() != gains_dB.size())
    table.error(ErrorClass::range, "table_gain_dB", std::to_string(gains_dB.size()) + " values",
                "one for each of the " + std::to_string(angles_deg.size()) + " angles");
  const auto peak = std::max_element(gains_dB.begin(), gains_dB.end());
  if (*peak != 0.0)
    table.error(ErrorClass::range, "table_gain_dB", core::number_text(*peak) + " at most",
                "0 at the peak, which the gains are relative to");
  if (not_increasing != angles_deg.end() || angles_deg.size() != gains_dB.size() || *peak != 0.0)
    return;

  for (const double angle_deg : angles_deg) cut.table_angle_rad.push_back(radians(angle_deg));
  for (const double gain_dB : gains_dB) cut.table_gain.push_back(core::power_from_dB(gain_dB));
  set_table_width(table, "table_angle_deg", cut);
}

void read_pattern_file(core::ConfigTable& table, PatternPlane plane, ReadCut& read) {
  const std::string name = table.required_text("file");
  const double cut_deg = table.required_number("cut_deg", {kNarrowest_deg, 180.0});
  if (name.empty()) return;
  core::ProblemList found;
  try {
    const std::filesystem::path folder = std::filesystem::path(table.place("").file).parent_path();
    const std::filesystem::path file = core::path_inside(folder.empty() ? "." : folder, name,
                                                         table.place("file"), table.path("file"));
    read.file = file.string();
    PatternCut pattern = read_pattern_cut(file, plane, found);
    read.file_peak_gain = pattern.peak_gain;
    read.cut.table_angle_rad = std::move(pattern.angle_rad);
    read.cut.table_gain = std::move(pattern.gain);
  } catch (const core::InputError& error) {
    found.append(error.problems());
  }
  table.problems().append(found.all());
  if (found.has_errors()) return;
  set_table_width(table, "file", read.cut);
  read.cut.cut_rad = std::min(read.cut.cut_rad, radians(cut_deg));
}

void read_cosecant(core::ConfigTable& table, PatternPlane plane, double boresight_elevation_rad,
                   BeamCut& cut) {
  if (plane == PatternPlane::azimuth)
    table.error(ErrorClass::unsupported, "shape", "\"cosecant_squared\"",
                "a shape for azimuth: the cosecant counts from the horizon");
  const double width_deg = table.required_number("half_power_width_deg", {kNarrowest_deg, 90.0});
  const core::NumberRange depression_deg{0.0, 90.0, true};
  const double from_deg = table.required_number("cosecant_from_deg", depression_deg);
  const double to_deg = table.required_number("cosecant_to_deg", depression_deg);
  // In radians, where both have come the same way from degrees: the two are often equal.
  if (radians(from_deg) < -boresight_elevation_rad)
    table.error(ErrorClass::range, "cosecant_from_deg", core::number_text(from_deg),
                "at least the depression of the boresight, " +
                    core::number_text(core::rounded_degrees(-boresight_elevation_rad)));
  if (!(to_deg > from_deg))
    table.error(ErrorClass::range, "cosecant_to_deg", core::number_text(to_deg),
                "above cosecant_from_deg = " + core::number_text(from_deg));
  cut.half_power_width_rad = radians(width_deg);
  cut.peak_depression_rad = -boresight_elevation_rad;
  cut.cosecant_from_rad = radians(from_deg) - cut.peak_depression_rad;
  cut.cosecant_to_rad = radians(to_deg) - cut.peak_depression_rad;
  // Above the peak 1.5625 widths, -29 dB one-way, as HiVision's cuts.
  cut.cut_rad = std::max(cut.cosecant_to_rad, 1.5625 * cut.half_power_width_rad);
}

void read_side_lobes(core::ConfigTable& table, BeamCut& cut) {
  const auto level_dB = table.optional_number("side_lobe_level_dB", {-200.0, -3.0});
  const double extent_deg = table.number("side_lobe_extent_deg", {0.0, 180.0}, 90.0);
  if (!level_dB) {
    if (table.has("side_lobe_extent_deg"))
      table.error(ErrorClass::ref, "side_lobe_level_dB", "missing",
                  "a level for the extent, -200 to -3");
    return;
  }
  if (!(radians(extent_deg) > cut.cut_rad))
    table.error(ErrorClass::range, "side_lobe_extent_deg", core::number_text(extent_deg),
                "above the main beam's cut, " + core::number_text(core::degrees(cut.cut_rad)));
  cut.side_lobe_gain = core::power_from_dB(*level_dB);
  cut.side_lobe_extent_rad = radians(extent_deg);
}

}  // namespace

ReadCut read_beam_cut(core::ConfigTable& table, PatternPlane plane,
                      double boresight_elevation_rad) {
  using Shape = BeamCut::Shape;
  constexpr std::size_t kFile = 5;
  ReadCut read;
  BeamCut& cut = read.cut;
  const std::size_t shape = table.choice(
      "shape", {"gaussian", "sinc_squared", "table", "cosecant_squared", "cosine_aperture", "file"},
      0);
  cut.shape = shape == kFile ? Shape::table : static_cast<Shape>(shape);
  if (shape == kFile) {
    read_pattern_file(table, plane, read);
  } else if (cut.shape == Shape::table) {
    read_gain_table(table, cut);
  } else if (cut.shape == Shape::cosecant_squared) {
    read_cosecant(table, plane, boresight_elevation_rad, cut);
  } else {
    const double width_deg = table.required_number("half_power_width_deg", {kNarrowest_deg, 180.0});
    const double widest_deg = cut.shape == Shape::gaussian ? 180.0 : 90.0;
    cut.half_power_width_rad = radians(width_deg);
    cut.cut_rad = radians(table.required_number("cut_deg", {0.5 * width_deg, widest_deg}));
  }
  read_side_lobes(table, cut);
  return read;
}

}  // namespace fanbeam::sensors
