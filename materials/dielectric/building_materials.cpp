#include "materials/dielectric/building_materials.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "core/number_range.h"

namespace fanbeam::materials {
namespace {

struct BuildingRow {
  double a;
  double b;
  double c_S_per_m;
  double d;
  Interval frequency_GHz;
};

// Rows in the order of BuildingMaterial.
constexpr std::array<BuildingRow, 11> kBuilding = {{
    {5.24, 0.0, 0.0462, 0.7822, {1.0, 100.0}},
    {3.91, 0.0, 0.0238, 0.16, {1.0, 40.0}},
    {2.73, 0.0, 0.0085, 0.9395, {1.0, 100.0}},
    {1.99, 0.0, 0.0047, 1.0718, {0.001, 100.0}},
    {6.31, 0.0, 0.0036, 1.3394, {0.1, 100.0}},
    {7.074, 0.0, 0.0055, 0.9262, {1.0, 60.0}},
    {4.83, 0.0, 0.0108, 1.3969, {1.0, 40.0}},
    {1.0, 0.0, 1e7, 0.0, {1.0, 100.0}},
    {3.0, 0.0, 0.00015, 2.52, {1.0, 10.0}},
    {15.0, -0.1, 0.035, 1.63, {1.0, 10.0}},
    {30.0, -0.4, 0.15, 1.30, {1.0, 10.0}},
}};

}  // namespace

Interval building_frequencies_Hz(BuildingMaterial material) {
  const Interval& range_GHz = kBuilding[static_cast<std::size_t>(material)].frequency_GHz;
  return {range_GHz.low * 1e9, range_GHz.high * 1e9};
}

Permittivity building_permittivity(BuildingMaterial material, double frequency_Hz) {
  const BuildingRow& row = kBuilding[static_cast<std::size_t>(material)];
  const Interval range_Hz = building_frequencies_Hz(material);
  core::require_range("frequency_Hz", frequency_Hz, {range_Hz.low, range_Hz.high});
  const double frequency_GHz = frequency_Hz / 1e9;
  const double conductivity_S_per_m = row.c_S_per_m * std::pow(frequency_GHz, row.d);
  return {row.a * std::pow(frequency_GHz, row.b), 17.98 * conductivity_S_per_m / frequency_GHz};
}

}  // namespace fanbeam::materials
