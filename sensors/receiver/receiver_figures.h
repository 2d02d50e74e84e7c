// What a sensor's receiver can tell from noise: the figures that follow from its file.
//
//     noise       k T0 F / dwell (Sensor::noise_power_W), dwell being the coherent time of one look
//     threshold   noise T / N on the mean over N looks, T of detection.h
//     minimum detectable signal   noise times the signal-to-noise ratio per look that reaches the
//                 detection probability of kDetectionProbability
// Assumptions of the minimum detectable signal: signal and noise in one range cell and column, at
// the receiver's input and with its loss in the signal; square-law detector; N independent looks;
// noise known; no clutter. Source: detection.h; definition: M. I. Skolnik, "Introduction to Radar
// Systems", 3rd edition, 2.2 to 2.6.
#pragma once

#include "sensors/sensor.h"

namespace fanbeam::sensors {

inline constexpr double kDetectionProbability = 0.9;

struct ReceiverFigures {
  double noise_W = 0.0;      // mean of one cell
  double threshold_W = 0.0;  // of the mean power over the looks
  double detectable_steady_W = 0.0;
  double detectable_swerling1_W = 0.0;
  double false_alarms_per_frame = 0.0;  // expected, noise alone, all cells
};

ReceiverFigures receiver_figures(const Sensor& sensor);

// threshold_W alone.
double detection_threshold_W(const Sensor& sensor);

}  // namespace fanbeam::sensors
