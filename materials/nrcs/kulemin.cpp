#include "materials/nrcs/kulemin.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "core/number_range.h"
#include "core/units.h"

namespace fanbeam::materials {
namespace {

struct Coefficients {
  double a1_dB;
  double a2_dB;
  double a3_dB;
};

constexpr std::array<Coefficients, 8> kCoefficients = {{
    {-49.0, 32.0, 20.0},
    {-37.0, 18.0, 15.0},
    {-34.0, 25.0, 15.0},
    {-20.0, 10.0, 6.0},
    {-40.0, 10.0, 6.0},
    {-21.0, 10.0, 6.0},
    {-27.5, 10.0, 6.0},
    {-8.5, 5.0, 3.0},
}};

const Coefficients& coefficients(KuleminTerrain terrain) {
  return kCoefficients[static_cast<std::size_t>(terrain)];
}

}  // namespace

double kulemin_sigma0(KuleminTerrain terrain, double frequency_Hz, double grazing_rad) {
  core::require_range("frequency_Hz", frequency_Hz, {kKuleminLowest_Hz, kKuleminHighest_Hz});
  if (!(grazing_rad > 0.0)) return 0.0;
  // As powers rather than decibels: no logarithm of an angle that may be tiny.
  const Coefficients& row = coefficients(terrain);
  return std::pow(10.0, row.a1_dB / 10.0) *
         std::pow(core::degrees(grazing_rad) / 20.0, row.a2_dB / 10.0) *
         std::pow(frequency_Hz / 10e9, row.a3_dB / 10.0);
}

}  // namespace fanbeam::materials
