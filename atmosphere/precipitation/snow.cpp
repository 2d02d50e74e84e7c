#include "atmosphere/precipitation/snow.h"

#include <cmath>

#include "atmosphere/input_check.h"
#include "core/constants.h"
#include "core/number_range.h"

namespace fanbeam::atmosphere {
namespace {

void require_snow(double snow_rate_mm_per_h, double frequency_Hz, double highest_Hz,
                  std::string_view whose) {
  core::ProblemList problems;
  core::check_range(problems, "snow_rate_mm_per_h", snow_rate_mm_per_h,
                    {0.0, kLargestSnowRate_mm_per_h}, "mm/h");
  check_frequency(problems, frequency_Hz, 1e9, highest_Hz, whose);
  problems.throw_if_errors();
}

}  // namespace

double snow_attenuation_dB_per_km(double snow_rate_mm_per_h, double frequency_Hz) {
  require_snow(snow_rate_mm_per_h, frequency_Hz, 50e9, "the loss in dry snow");
  const double wavelength_cm = 1e2 * core::kSpeedOfLight_mps / frequency_Hz;
  const double square = wavelength_cm * wavelength_cm;
  return 0.00349 * std::pow(snow_rate_mm_per_h, 1.6) / (square * square) +
         0.00224 * snow_rate_mm_per_h / wavelength_cm;
}

double snow_eta_m2_per_m3(double snow_rate_mm_per_h, double frequency_Hz) {
  require_snow(snow_rate_mm_per_h, frequency_Hz, 40e9, "the echo of dry snow");
  constexpr double kIceDielectricFactor = 0.208;
  constexpr double kMetre3_per_mm6_per_m3 = 1e-18;
  const double reflectivity_m3 =
      kMetre3_per_mm6_per_m3 * 1780.0 * std::pow(snow_rate_mm_per_h, 2.21);
  const double wavelength_m = core::kSpeedOfLight_mps / frequency_Hz;
  const double square_m2 = wavelength_m * wavelength_m;
  return std::pow(core::kPi, 5.0) * kIceDielectricFactor * reflectivity_m3 /
         (square_m2 * square_m2);
}

}  // namespace fanbeam::atmosphere
