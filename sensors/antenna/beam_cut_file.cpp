#include "sensors/antenna/beam_cut_file.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/decibel.h"
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
  const auto peak_row = static_cast<std::size_t>(peak - gains_dB.begin());
  cut.half_power_width_rad =
      half_power_angle_rad(cut, peak_row, 1) - half_power_angle_rad(cut, peak_row, -1);
  cut.cut_rad =
      std::max(std::abs(cut.table_angle_rad.front()), std::abs(cut.table_angle_rad.back()));
  if (cut.half_power_width_rad < radians(kNarrowest_deg))
    table.error(ErrorClass::range, "table_angle_deg",
                core::number_text(core::degrees(cut.half_power_width_rad)) + " half-power width",
                "at least " + core::number_text(kNarrowest_deg));
}

}  // namespace

BeamCut read_beam_cut(core::ConfigTable& table) {
  using Shape = BeamCut::Shape;
  BeamCut cut;
  cut.shape = static_cast<Shape>(table.choice("shape", {"gaussian", "sinc_squared", "table"}, 0));
  if (cut.shape == Shape::table) {
    read_gain_table(table, cut);
    return cut;
  }
  const double width_deg = table.required_number("half_power_width_deg", {kNarrowest_deg, 180.0});
  const double widest_deg = cut.shape == Shape::sinc_squared ? 90.0 : 180.0;
  cut.half_power_width_rad = radians(width_deg);
  cut.cut_rad = radians(table.required_number("cut_deg", {0.5 * width_deg, widest_deg}));
  return cut;
}

}  // namespace fanbeam::sensors
