#include "atmosphere/water_permittivity.h"

namespace fanbeam::atmosphere {

// Symbols as in P.840, frequencies in GHz.
std::complex<double> water_permittivity(double frequency_Hz, double temperature_C) {
  const double f = frequency_Hz * 1e-9;
  const double warmth = 300.0 / (temperature_C + 273.15) - 1.0;
  const double eps0 = 77.66 + 103.3 * warmth;
  const double eps1 = 0.0671 * eps0;
  const double eps2 = 3.52;
  const double fp = 20.20 - 146.0 * warmth + 316.0 * warmth * warmth;
  const double fs = 39.8 * fp;

  const double principal = (eps0 - eps1) / (1.0 + (f / fp) * (f / fp));
  const double secondary = (eps1 - eps2) / (1.0 + (f / fs) * (f / fs));
  return {principal + secondary + eps2, f / fp * principal + f / fs * secondary};
}

}  // namespace fanbeam::atmosphere
