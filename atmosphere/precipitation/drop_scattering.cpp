#include "atmosphere/precipitation/drop_scattering.h"

#include <cmath>

#include "atmosphere/input_check.h"
#include "atmosphere/precipitation/mie.h"
#include "atmosphere/precipitation/rain.h"
#include "atmosphere/water_permittivity.h"
#include "core/constants.h"
#include "core/number_range.h"

namespace fanbeam::atmosphere {
namespace {

constexpr int kIntervals = 398;  // even, as Simpson's rule wants
constexpr double kStep_mm = (kLargestDrop_mm - kSmallestDrop_mm) / kIntervals;

double diameter_mm(std::size_t i) { return kSmallestDrop_mm + kStep_mm * static_cast<double>(i); }

double simpson_weight(int i) {
  if (i == 0 || i == kIntervals) return kStep_mm / 3.0;
  return (i % 2 == 1 ? 4.0 : 2.0) * kStep_mm / 3.0;
}

}  // namespace

DropScattering::DropScattering(double frequency_Hz, double temperature_C) {
  core::ProblemList problems;
  check_frequency(problems, frequency_Hz, 1e9, 1e12);
  core::check_range(problems, "temperature_C", temperature_C, {0.0, 40.0}, "C for drops of rain");
  problems.throw_if_errors();

  const std::complex<double> index = std::sqrt(water_permittivity(frequency_Hz, temperature_C));
  const double per_wavelength_m = frequency_Hz / core::kSpeedOfLight_mps;
  for (int i = 0; i <= kIntervals; ++i) {
    const double diameter_m = 1e-3 * diameter_mm(static_cast<std::size_t>(i));
    const MieEfficiencies q = mie_efficiencies(core::kPi * diameter_m * per_wavelength_m, index);
    const double area_m2 = core::kPi / 4.0 * diameter_m * diameter_m;
    extinction_m2_mm_.push_back(q.extinction * area_m2 * simpson_weight(i));
    backscatter_m2_mm_.push_back(q.backscatter * area_m2 * simpson_weight(i));
  }
}

double DropScattering::over_all_drops(const std::vector<double>& section_m2_mm, DropSizes sizes,
                                      double rain_rate_mm_per_h) const {
  core::require_range("rain_rate_mm_per_h", rain_rate_mm_per_h, {0.0, kLargestRainRate_mm_per_h},
                      "mm/h");
  double sum = 0.0;
  for (std::size_t i = 0; i < section_m2_mm.size(); ++i)
    sum += section_m2_mm[i] * drops_per_m3_mm(sizes, rain_rate_mm_per_h, diameter_mm(i));
  return sum;
}

double DropScattering::attenuation_dB_per_km(DropSizes sizes, double rain_rate_mm_per_h) const {
  constexpr double kdB_per_km_of_nepers_per_m = 4342.944819032518;  // 1e4 / ln 10
  return kdB_per_km_of_nepers_per_m * over_all_drops(extinction_m2_mm_, sizes, rain_rate_mm_per_h);
}

double DropScattering::eta_m2_per_m3(DropSizes sizes, double rain_rate_mm_per_h) const {
  return over_all_drops(backscatter_m2_mm_, sizes, rain_rate_mm_per_h);
}

}  // namespace fanbeam::atmosphere
