#include "materials/nrcs/nrl_sea.h"

#include <cmath>

#include "core/number_range.h"
#include "core/units.h"

namespace fanbeam::materials {
namespace {

struct SeaCoefficients {
  double c1, c2, c3, c4, c5;
};
constexpr SeaCoefficients kHorizontal = {-73.0, 20.781, 7.351, 25.65, 0.0054};
constexpr SeaCoefficients kVertical = {-50.796, 25.93, 0.7093, 21.588, 0.00211};

}  // namespace

double nrl_sea_sigma0(Polarisation polarisation, double sea_state, double frequency_Hz,
                      double grazing_rad) {
  core::require_range("frequency_Hz", frequency_Hz, {kNrlSeaLowest_Hz, kNrlSeaHighest_Hz});
  core::require_range("sea_state", sea_state, {0.0, 6.0});
  if (!(grazing_rad > 0.0)) return 0.0;
  const SeaCoefficients& k = polarisation == Polarisation::horizontal ? kHorizontal : kVertical;
  const double psi_deg = core::degrees(grazing_rad);
  const double frequency_term =
      (27.5 + k.c3 * psi_deg) * std::log10(frequency_Hz / 1e9) / (1.0 + 0.95 * psi_deg);
  const double sea_term =
      k.c4 * std::pow(1.0 + sea_state, 1.0 / (2.0 + 0.085 * psi_deg + 0.033 * sea_state));
  const double level_dB = k.c1 + frequency_term + sea_term + k.c5 * psi_deg * psi_deg;
  return std::pow(10.0, level_dB / 10.0) * std::pow(std::sin(grazing_rad), k.c2 / 10.0);
}

}  // namespace fanbeam::materials
