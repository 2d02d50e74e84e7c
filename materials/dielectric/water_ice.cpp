#include "materials/dielectric/water_ice.h"

#include <cmath>

#include "core/number_range.h"

namespace fanbeam::materials {

Permittivity water_permittivity(double frequency_Hz, double temperature_K) {
  core::require_range("frequency_Hz", frequency_Hz,
                      {kWaterFrequencies_Hz.low, kWaterFrequencies_Hz.high});
  core::require_range("temperature_K", temperature_K, {253.15, 333.15});
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
  core::require_range("frequency_Hz", frequency_Hz,
                      {kIceFrequencies_Hz.low, kIceFrequencies_Hz.high});
  core::require_range("temperature_K", temperature_K, {240.0, 273.15});
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

}  // namespace fanbeam::materials
