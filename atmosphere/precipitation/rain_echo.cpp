#include "atmosphere/precipitation/rain_echo.h"

#include <array>
#include <cmath>

#include "atmosphere/input_check.h"
#include "atmosphere/precipitation/drop_scattering.h"
#include "core/number_range.h"

namespace fanbeam::atmosphere {
namespace {

constexpr NameTable<RainEchoLaw, 3> kRainEchoLawNames = {
    {{"mie", RainEchoLaw::mie},
     {"mie-fit", RainEchoLaw::mie_fit},
     {"georgia-tech-1975", RainEchoLaw::georgia_tech_1975}}};

// log10 eta = q0 + q1 x + q2 x^2 with x = log10 R.
struct Fit {
  double frequency_GHz, q0, q1, q2;
};
constexpr std::array<Fit, 5> kMieFits = {{{9.4, -7.12163, 1.50322, 0.04146},
                                          {24.0, -5.35754, 1.58138, -0.12727},
                                          {35.0, -4.73136, 1.41355, -0.15383},
                                          {76.5, -3.98528, 0.89738, -0.10180},
                                          {94.0, -3.93011, 0.78138, -0.07651}}};

// eta = a R^b.
struct PowerLaw {
  double frequency_GHz, a, b;
};
constexpr std::array<PowerLaw, 4> kGeorgiaTech = {
    {{9.4, 1.3e-8, 1.6}, {35.0, 1.2e-6, 1.6}, {70.0, 4.2e-5, 1.1}, {95.0, 1.5e-5, 1.0}}};

// The entry for the frequency; E-RANGE with the known ones when none lies within 2 %.
template <typename Entry, std::size_t count>
const Entry& entry_for(const std::array<Entry, count>& entries, double frequency_Hz,
                       std::string_view law) {
  std::string known;
  for (const Entry& entry : entries) {
    if (std::abs(frequency_Hz * 1e-9 - entry.frequency_GHz) <= 0.02 * entry.frequency_GHz)
      return entry;
    known += (known.empty() ? "" : ", ") + core::number_text(entry.frequency_GHz);
  }
  core::throw_input_error(
      std::isfinite(frequency_Hz) ? core::ErrorClass::range : core::ErrorClass::nonfinite,
      "frequency", GHz_text(frequency_Hz),
      "within 2 % of " + known + " GHz for the rain echo law " + std::string(law));
}

}  // namespace

RainEchoLaw rain_echo_law_named(std::string_view name) {
  return choice_named(kRainEchoLawNames, "rain_echo_law", name);
}

std::string_view name_of(RainEchoLaw law) { return name_in(kRainEchoLawNames, law); }

double rain_eta_m2_per_m3(RainEchoLaw law, double rain_rate_mm_per_h, double frequency_Hz,
                          const RainDrops& drops) {
  core::require_range("rain_rate_mm_per_h", rain_rate_mm_per_h, {0.0, kLargestRainRate_mm_per_h},
                      "mm/h");
  switch (law) {
    case RainEchoLaw::mie:
      return DropScattering(frequency_Hz, drops.temperature_C)
          .eta_m2_per_m3(drops.sizes, rain_rate_mm_per_h);
    case RainEchoLaw::mie_fit: {
      const Fit& fit = entry_for(kMieFits, frequency_Hz, name_of(law));
      if (rain_rate_mm_per_h == 0.0) return 0.0;
      core::require_range("rain_rate_mm_per_h", rain_rate_mm_per_h, {0.5, 100.0},
                          "mm/h (or 0) for the rain echo law mie-fit");
      const double x = std::log10(rain_rate_mm_per_h);
      return std::pow(10.0, fit.q0 + x * (fit.q1 + x * fit.q2));
    }
    case RainEchoLaw::georgia_tech_1975: {
      const PowerLaw& power_law = entry_for(kGeorgiaTech, frequency_Hz, name_of(law));
      return power_law.a * std::pow(rain_rate_mm_per_h, power_law.b);
    }
  }
  throw core::InternalError("unknown rain echo law");
}

}  // namespace fanbeam::atmosphere
