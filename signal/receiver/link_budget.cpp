#include "signal/receiver/link_budget.h"

#include "core/constants.h"
#include "signal/checks_private.h"

namespace fanbeam::signal {

double received_power_W(const Link& link, double range_m, double cross_section_m2) {
  check_not_negative("transmitted_W", link.transmitted_W);
  check_not_negative("transmit_gain", link.transmit_gain);
  check_not_negative("receive_gain", link.receive_gain);
  check_positive("wavelength_m", link.wavelength_m);
  core::require_range("loss", link.loss, {.low = 1.0});
  check_positive("range_m", range_m);
  check_not_negative("cross_section_m2", cross_section_m2);
  const double four_pi = 4.0 * core::kPi;
  const double spread = link.wavelength_m / (four_pi * range_m * range_m);
  return link.transmitted_W * link.transmit_gain * link.receive_gain * cross_section_m2 * spread *
         spread / (four_pi * link.loss);
}

double noise_density_W_per_Hz(double noise_figure) {
  core::require_range("noise_figure", noise_figure, {.low = 1.0});
  return core::kBoltzmann_J_per_K * core::kNoiseReferenceTemperature_K * noise_figure;
}

double integrated_noise_W(double noise_figure, double coherent_s) {
  check_positive("coherent_s", coherent_s);
  return noise_density_W_per_Hz(noise_figure) / coherent_s;
}

}  // namespace fanbeam::signal
