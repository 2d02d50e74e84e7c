// Power of a point target's echo and of the receiver's noise.
//
//   Pr = Pt Gt Gr lambda^2 sigma / ((4 pi)^3 R^4 L)          (two ways, free space)
//   noise density k T0 F, T0 = 290 K; after coherent integration over T: k T0 F / T
// Source: M. I. Skolnik, "Introduction to Radar Systems", 3rd ed., 1.2 and 2.3; IEEE Std 686.
// Neglected: the atmosphere (put into `loss`), the antenna's temperature (taken as T0).
#pragma once

namespace fanbeam::signal {

struct Link {
  double transmitted_W = 4e-3;
  double transmit_gain = 1.0;  // power ratios
  double receive_gain = 1.0;
  double wavelength_m = 0.0;
  double loss = 1.0;  // 1 or more
};

// Refuses what is not finite (E-NONFINITE), a range not above 0, a negative cross-section, a loss
// below 1 (E-RANGE).
double received_power_W(const Link& link, double range_m, double cross_section_m2);

// k T0 F; `noise_figure` as a power ratio of 1 or more.
double noise_density_W_per_Hz(double noise_figure);

// Mean noise power in one bin after coherent integration.
double integrated_noise_W(double noise_figure, double coherent_s);

}  // namespace fanbeam::signal
