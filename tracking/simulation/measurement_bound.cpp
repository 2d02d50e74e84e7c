#include "tracking/simulation/measurement_bound.h"

#include <cmath>

#include "core/constants.h"
#include "signal/receiver/link_budget.h"

namespace fanbeam::tracking {

MeasurementBound bound_at(const core::HighwayRadar& radar, double signal_to_noise,
                          double azimuth_rad) {
  MeasurementBound bound;
  bound.signal_to_noise = signal_to_noise;
  const double wavelength_m = core::kSpeedOfLight_mps / radar.centre_frequency_Hz;
  const double sigma_bins = std::sqrt(6.0 / signal_to_noise) / (2.0 * core::kPi);
  bound.range_sigma_m =
      core::kSpeedOfLight_mps / (2.0 * radar.bandwidth_Hz) * sigma_bins / std::sqrt(2.0);
  bound.range_rate_sigma_mps = 0.25 * wavelength_m * std::sqrt(2.0) * sigma_bins / radar.ramp_s;
  const double n = radar.array_elements;
  bound.azimuth_sigma_rad =
      n < 2.0 ? core::kPi / std::sqrt(3.0)
              : std::sqrt(6.0 / (signal_to_noise * (n * n - 1.0))) /
                    (2.0 * core::kPi * radar.array_pitch_wavelengths * std::cos(azimuth_rad));
  return bound;
}

MeasurementBound measurement_bound(const core::HighwayRadar& radar, double cross_section_m2,
                                   double range_m, double azimuth_rad) {
  signal::Link link;
  link.transmitted_W = radar.transmitted_W;
  link.transmit_gain = radar.transmit_gain;
  link.receive_gain = radar.receive_gain;
  link.wavelength_m = core::kSpeedOfLight_mps / radar.centre_frequency_Hz;
  link.loss = radar.loss;
  return bound_at(radar,
                  signal::received_power_W(link, range_m, cross_section_m2) /
                      signal::integrated_noise_W(radar.noise_figure, radar.ramp_s),
                  azimuth_rad);
}

}  // namespace fanbeam::tracking
