// Temperature, pressure and water vapour over height, for the attenuation by gases.
//
// Source: Recommendation ITU-R P.835-6 (12/2017), mean annual global reference atmosphere, first
// two layers, with the geopotential height h' = 6356.766 h / (6356.766 + h) km:
//   T = 288.15 - 6.5 h' up to h' = 11 km, constant above; P hydrostatic (34.1632 K/km);
//   rho = 7.5 exp(-h / 2 km) g/m3.
// Known surface values replace the reference at their height: the temperature is shifted as a
// whole (same lapse rate), the pressure is hydrostatic in the shifted temperature, the vapour
// keeps its scale height of 2 km. The vapour never exceeds saturation over water, Recommendation
// ITU-R P.453-14 equation 9 (stated for -40 to 50 C, continued beyond).
// Neglected: inversions, weather fronts, ice saturation, heights above 20 km.
// Accuracy: without surface values the formulas of P.835-6 themselves.
#pragma once

#include <optional>

namespace fanbeam::atmosphere {

struct AirState {
  double temperature_K = 0.0;
  double pressure_hPa = 0.0;  // total: dry air and vapour
  double vapour_density_g_per_m3 = 0.0;

  double dry_pressure_hPa() const;
};

// What is known of the air at one height above mean sea level; the rest follows the reference.
struct SurfaceAir {
  double height_m = 0.0;                // -500 to 6000
  std::optional<double> temperature_C;  // -60 to 50
  std::optional<double> pressure_hPa;   // 300 to 1100, total
  std::optional<double> humidity;       // relative, 0 to 1
};

class StandardAtmosphere {
 public:
  static constexpr double kLowest_m = -3000.0;
  static constexpr double kHighest_m = 20000.0;

  // The reference itself.
  StandardAtmosphere() : StandardAtmosphere(SurfaceAir{}) {}
  // Throws InputError: E-RANGE, E-NONFINITE (all wrong values together).
  explicit StandardAtmosphere(const SurfaceAir& surface);

  // Height above mean sea level, kLowest_m to kHighest_m. Throws InputError: E-RANGE, E-NONFINITE.
  AirState at(double height_m) const;

 private:
  double surface_height_m_ = 0.0;
  double temperature_shift_K_ = 0.0;
  double pressure_scale_ = 1.0;  // against the hydrostatic column that starts at 1013.25 hPa
  double surface_vapour_density_g_per_m3_ = 0.0;
};

// Vapour density in saturated air over water (P.453-14). Temperature 100 to 350 K, total pressure.
double saturation_vapour_density_g_per_m3(double temperature_K, double pressure_hPa);

}  // namespace fanbeam::atmosphere
