#include "materials/dielectric/permittivity.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "materials/checks.h"

namespace fanbeam::materials {
namespace {

struct BuildingRow {
  double a;
  double b;
  double c_S_per_m;
  double d;
  double low_GHz;
  double high_GHz;
};

// Rows in the order of BuildingMaterial.
constexpr std::array<BuildingRow, 11> kBuilding = {{
    {5.24, 0.0, 0.0462, 0.7822, 1.0, 100.0},
    {3.91, 0.0, 0.0238, 0.16, 1.0, 40.0},
    {2.73, 0.0, 0.0085, 0.9395, 1.0, 100.0},
    {1.99, 0.0, 0.0047, 1.0718, 0.001, 100.0},
    {6.31, 0.0, 0.0036, 1.3394, 0.1, 100.0},
    {7.074, 0.0, 0.0055, 0.9262, 1.0, 60.0},
    {4.83, 0.0, 0.0108, 1.3969, 1.0, 40.0},
    {1.0, 0.0, 1e7, 0.0, 1.0, 100.0},
    {3.0, 0.0, 0.00015, 2.52, 1.0, 10.0},
    {15.0, -0.1, 0.035, 1.63, 1.0, 10.0},
    {30.0, -0.4, 0.15, 1.30, 1.0, 10.0},
}};

}  // namespace

void check_permittivity(const Permittivity& permittivity) {
  require_range("permittivity.real", permittivity.real, 1.0, kLargestPermittivity);
  require_range("permittivity.loss", permittivity.loss, 0.0, kLargestPermittivity);
}

Permittivity building_permittivity(BuildingMaterial material, double frequency_Hz) {
  const BuildingRow& row = kBuilding[static_cast<std::size_t>(material)];
  require_range("frequency_Hz", frequency_Hz, row.low_GHz * 1e9, row.high_GHz * 1e9);
  const double frequency_GHz = frequency_Hz / 1e9;
  const double conductivity_S_per_m = row.c_S_per_m * std::pow(frequency_GHz, row.d);
  return {row.a * std::pow(frequency_GHz, row.b), 17.98 * conductivity_S_per_m / frequency_GHz};
}

Permittivity water_permittivity(double frequency_Hz, double temperature_K) {
  require_range("frequency_Hz", frequency_Hz, 1e6, 1e12);
  require_range("temperature_K", temperature_K, 253.15, 333.15);
  const double theta = 1.0 - 300.0 / temperature_K;
  const double static_value = 77.66 - 103.3 * theta;
  const double middle_value = 0.0671 * static_value;
  const double optical_value = 3.52 + 7.52 * theta;
  const double first_GHz = 20.2 + 146.4 * theta + 316.0 * theta * theta;
  const double second_GHz = 39.8 * first_GHz;
  const double frequency_GHz = frequency_Hz / 1e9;
  const std::complex<double> value =
      optical_value +
      (middle_value - optical_value) / std::complex<double>(1.0, frequency_GHz / second_GHz) +
      (static_value - middle_value) / std::complex<double>(1.0, frequency_GHz / first_GHz);
  return {value.real(), -value.imag()};
}

Permittivity ice_permittivity(double frequency_Hz, double temperature_K) {
  require_range("frequency_Hz", frequency_Hz, 10e6, 300e9);
  require_range("temperature_K", temperature_K, 240.0, 273.15);
  const double frequency_GHz = frequency_Hz / 1e9;
  const double theta = 300.0 / temperature_K - 1.0;
  const double alpha_GHz = (0.00504 + 0.0062 * theta) * std::exp(-22.1 * theta);
  const double boltzmann = std::exp(335.0 / temperature_K);
  const double beta_per_GHz =
      0.0207 / temperature_K * boltzmann / ((boltzmann - 1.0) * (boltzmann - 1.0)) +
      1.16e-11 * frequency_GHz * frequency_GHz +
      std::exp(-9.963 + 0.0372 * (temperature_K - 273.15));
  return {3.1884 + 9.1e-4 * (temperature_K - 273.15),
          alpha_GHz / frequency_GHz + beta_per_GHz * frequency_GHz};
}

Permittivity dry_snow_permittivity(double density_kg_per_m3) {
  require_range("density_kg_per_m3", density_kg_per_m3, 0.0, 500.0);
  const double density_g_per_cm3 = density_kg_per_m3 / 1000.0;
  return {1.0 + 1.7 * density_g_per_cm3 + 0.7 * density_g_per_cm3 * density_g_per_cm3, 0.0};
}

}  // namespace fanbeam::materials
