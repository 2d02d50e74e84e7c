#include "sensors/sensor.h"

#include <cmath>

#include "core/constants.h"
#include "sensors/antenna/beam_pattern.h"

namespace fanbeam::sensors {

double Sensor::wavelength_m() const {
  const double speed_mps = seed.active ? seed.speed_of_light_mps : core::kSpeedOfLight_mps;
  return speed_mps / waveform.frequency_Hz;
}

double Sensor::radar_constant_W_m2() const {
  const double aperture = antenna.peak_gain * wavelength_m();
  const double four_pi = 4.0 * core::kPi;
  return waveform.transmit_power_W * aperture * aperture / (four_pi * four_pi * four_pi) /
         receiver.loss;
}

double Sensor::azimuth_patch_rad() const {
  return seed.active ? seed.azimuth_patch_rad : two_way_width(antenna.azimuth);
}

double Sensor::noise_power_W() const {
  return core::kBoltzmann_J_per_K * core::kNoiseReferenceTemperature_K * receiver.noise_figure /
         receiver.dwell_s;
}

}  // namespace fanbeam::sensors
