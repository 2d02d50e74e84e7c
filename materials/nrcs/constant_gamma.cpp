#include "materials/nrcs/constant_gamma.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "core/decibel.h"
#include "core/number_range.h"

namespace fanbeam::materials {
namespace {

constexpr std::array<double, 8> kGammaAt10GHz_dB = {-20.0, -15.0, -15.0, -10.0,
                                                    0.0,   0.0,   -40.0, -30.0};

}  // namespace

double gamma_at(GammaTerrain terrain, double frequency_Hz) {
  core::require_range("frequency_Hz", frequency_Hz, {kGammaLowest_Hz, kGammaHighest_Hz});
  const double gamma_dB =
      kGammaAt10GHz_dB[static_cast<std::size_t>(terrain)] + 5.0 * std::log10(frequency_Hz / 10e9);
  return core::power_from_dB(gamma_dB);
}

double constant_gamma_sigma0(double gamma, double grazing_rad) {
  return grazing_rad > 0.0 ? gamma * std::sin(grazing_rad) : 0.0;
}

}  // namespace fanbeam::materials
