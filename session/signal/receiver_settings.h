// What a receiver and its array are like, and what is wrong with them.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "signal/receiver/oscillator.h"

namespace fanbeam::session {

struct ArraySettings {
  // On a line, pitch_wavelengths apart; or, where given, at places (forward, right, up; within 10 m).
  int transmitters = 3, receivers = 4;  // 1 to 64 each
  double pitch_wavelengths = 0.5;       // above 0 to 1000
  std::vector<glm::dvec3> transmitters_m, receivers_m;
  // Of every channel (transmitter * receivers + receiver), as the samples have them and the
  // processing does not know; empty: none.
  std::vector<double> gain_errors_dB;    // +-60
  std::vector<double> phase_errors_rad;  // +-2 pi

  // As many elements on a line instead of those at places.
  void put_on_a_line() {
    if (!transmitters_m.empty()) transmitters = static_cast<int>(transmitters_m.size());
    if (!receivers_m.empty()) receivers = static_cast<int>(receivers_m.size());
    transmitters_m.clear();
    receivers_m.clear();
  }
};

struct ReceiverSettings {
  std::optional<double> noise_figure_dB;  // 0 to 60; missing: the sensor's
  double line_width_Hz = 0.0;             // of the oscillator, to 1e6; 0: no phase noise
  signal::PhaseNoiseTable phase_noise;    // instead of a line width
  int adc_bits = 0;                       // to 24; 0: no quantiser
  // Power of a tone whose real part just fills the quantiser, +-300; missing: the frame's largest
  // sample just does.
  std::optional<double> adc_full_scale_dBm;
};

}  // namespace fanbeam::session
