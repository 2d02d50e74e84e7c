#include "atmosphere/gas/standard_atmosphere.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/gas/gases.h"
#include "atmosphere/gas/geopotential.h"
#include "core/number_range.h"

namespace fanbeam::atmosphere {
namespace {

constexpr double kSeaLevelTemperature_K = 288.15;
constexpr double kSeaLevelPressure_hPa = 1013.25;
constexpr double kSeaLevelVapour_g_per_m3 = 7.5;

double temperature_K(double h_km, double shift_K) {
  return kSeaLevelTemperature_K + shift_K - kLapse_K_per_km * std::min(h_km, kTropopause_km);
}

// Pressure over its value at h' = 0.
double pressure_ratio(double h_km, double shift_K) {
  const double ground_K = temperature_K(0.0, shift_K);
  const double here_K = temperature_K(h_km, shift_K);
  const double ratio = std::pow(here_K / ground_K, kHydrostatic_K_per_km / kLapse_K_per_km);
  if (h_km <= kTropopause_km) return ratio;
  return ratio * std::exp(-kHydrostatic_K_per_km * (h_km - kTropopause_km) / here_K);
}

}  // namespace

double AirState::dry_pressure_hPa() const {
  return pressure_hPa - vapour_pressure_hPa(vapour_density_g_per_m3, temperature_K);
}

double saturation_vapour_density_g_per_m3(double temperature_K, double pressure_hPa) {
  const double t = temperature_K - kZeroCelsius_K;
  const double enhancement = 1.0 + 1e-4 * (7.2 + pressure_hPa * (0.0320 + 5.9e-6 * t * t));
  const double pressure = enhancement * 6.1121 * std::exp((18.678 - t / 234.5) * t / (t + 257.14));
  return 216.7 * pressure / temperature_K;
}

StandardAtmosphere::StandardAtmosphere(const SurfaceAir& surface) {
  core::ProblemList problems;
  core::check_range(problems, "origin_height_m", surface.height_m, {-500.0, 6000.0}, "m");
  if (surface.temperature_C)
    core::check_range(problems, "temperature_C", *surface.temperature_C, {-60.0, 50.0}, "C");
  if (surface.pressure_hPa)
    core::check_range(problems, "pressure_hPa", *surface.pressure_hPa, {300.0, 1100.0}, "hPa");
  if (surface.humidity) core::check_range(problems, "humidity", *surface.humidity, {0.0, 1.0});
  problems.throw_if_errors();

  surface_height_m_ = surface.height_m;
  const double h_km = geopotential_km(surface.height_m);
  if (surface.temperature_C)
    temperature_shift_K_ = *surface.temperature_C + kZeroCelsius_K - temperature_K(h_km, 0.0);
  const double column_hPa = kSeaLevelPressure_hPa * pressure_ratio(h_km, temperature_shift_K_);
  const double reference_hPa = kSeaLevelPressure_hPa * pressure_ratio(h_km, 0.0);
  const double pressure_hPa = surface.pressure_hPa.value_or(reference_hPa);
  pressure_scale_ = pressure_hPa / column_hPa;
  surface_vapour_density_g_per_m3_ =
      surface.humidity
          ? *surface.humidity * saturation_vapour_density_g_per_m3(
                                    temperature_K(h_km, temperature_shift_K_), pressure_hPa)
          : kSeaLevelVapour_g_per_m3 * std::exp(-surface.height_m / kVapourScaleHeight_m);
}

AirState StandardAtmosphere::at(double height_m) const {
  core::require_range("height_m", height_m, {kLowest_m, kHighest_m}, "m above mean sea level");
  const double h_km = geopotential_km(height_m);
  AirState air;
  air.temperature_K = temperature_K(h_km, temperature_shift_K_);
  air.pressure_hPa =
      kSeaLevelPressure_hPa * pressure_scale_ * pressure_ratio(h_km, temperature_shift_K_);
  const double vapour = surface_vapour_density_g_per_m3_ *
                        std::exp(-(height_m - surface_height_m_) / kVapourScaleHeight_m);
  air.vapour_density_g_per_m3 =
      std::min(vapour, saturation_vapour_density_g_per_m3(air.temperature_K, air.pressure_hPa));
  return air;
}

}  // namespace fanbeam::atmosphere
