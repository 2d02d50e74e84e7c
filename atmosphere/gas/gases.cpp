#include "atmosphere/gas/gases.h"

#include <cmath>

#include "atmosphere/gas/gas_lines_table.h"
#include "atmosphere/input_check.h"
#include "core/number_range.h"

namespace fanbeam::atmosphere {
namespace {

// The state of the air in the variables of P.676: f in GHz, p and e in hPa, theta = 300 K / T.
struct Air {
  double f;
  double p;
  double e;
  double theta;
};

// Equation 5: shape of a line of half width `width` and interference `delta`, both in GHz.
double line_shape(double f, double centre, double width, double delta) {
  const double below = centre - f;
  const double above = centre + f;
  return f / centre *
         ((width - delta * below) / (below * below + width * width) +
          (width - delta * above) / (above * above + width * width));
}

double oxygen_line(const OxygenLine& line, const Air& air) {
  const double theta = air.theta;
  const double strength =
      line.a1 * 1e-7 * air.p * std::pow(theta, 3.0) * std::exp(line.a2 * (1.0 - theta));
  const double pressure_width =
      line.a3 * 1e-4 * (air.p * std::pow(theta, 0.8 - line.a4) + 1.1 * air.e * theta);
  const double width = std::sqrt(pressure_width * pressure_width + 2.25e-6);
  const double delta = (line.a5 + line.a6 * theta) * 1e-4 * (air.p + air.e) * std::pow(theta, 0.8);
  return strength * line_shape(air.f, line.centre_GHz, width, delta);
}

double water_line(const WaterLine& line, const Air& air) {
  const double theta = air.theta;
  const double strength =
      line.b1 * 0.1 * air.e * std::pow(theta, 3.5) * std::exp(line.b2 * (1.0 - theta));
  const double pressure_width =
      line.b3 * 1e-4 *
      (air.p * std::pow(theta, line.b4) + line.b5 * air.e * std::pow(theta, line.b6));
  const double doppler = 2.1316e-12 * line.centre_GHz * line.centre_GHz / theta;
  const double width =
      0.535 * pressure_width + std::sqrt(0.217 * pressure_width * pressure_width + doppler);
  return strength * line_shape(air.f, line.centre_GHz, width, 0.0);
}

// Equations 8 and 9, the Debye term multiplied out so that it stays finite in a vacuum.
double dry_continuum(const Air& air) {
  const double width = 5.6e-4 * (air.p + air.e) * std::pow(air.theta, 0.8);
  const double debye = 6.14e-5 * width / (width * width + air.f * air.f);
  const double nitrogen =
      1.4e-12 * air.p * std::pow(air.theta, 1.5) / (1.0 + 1.9e-5 * std::pow(air.f, 1.5));
  return air.f * air.p * air.theta * air.theta * (debye + nitrogen);
}

}  // namespace

double vapour_pressure_hPa(double vapour_density_g_per_m3, double temperature_K) {
  return vapour_density_g_per_m3 * temperature_K / 216.7;
}

GasAttenuation gas_attenuation(double frequency_Hz, double dry_pressure_hPa, double temperature_K,
                               double vapour_density_g_per_m3) {
  core::ProblemList problems;
  check_frequency(problems, frequency_Hz, 1e9, 1e12);
  core::check_range(problems, "dry_pressure_hPa", dry_pressure_hPa, kGasPressures_hPa, "hPa");
  core::check_range(problems, "temperature_K", temperature_K, kGasTemperatures_K, "K");
  core::check_range(problems, "vapour_density_g_per_m3", vapour_density_g_per_m3, {0.0, 300.0},
                    "g/m3");
  problems.throw_if_errors();

  const Air air{frequency_Hz * 1e-9, dry_pressure_hPa,
                vapour_pressure_hPa(vapour_density_g_per_m3, temperature_K), 300.0 / temperature_K};
  double oxygen = dry_continuum(air);
  for (const OxygenLine& line : kOxygenLines) oxygen += oxygen_line(line, air);
  double water = 0.0;
  for (const WaterLine& line : kWaterLines) water += water_line(line, air);
  return {0.1820 * air.f * oxygen, 0.1820 * air.f * water};
}

}  // namespace fanbeam::atmosphere
