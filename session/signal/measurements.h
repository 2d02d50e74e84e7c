// From detections to what a tracker takes: one measurement an object, with its errors.
//
// Detections of one cluster no longer than an object, by the diagonal of their extents forward and right, are
// one measurement: means weighted with the power (of azimuths across the half turn behind too), and the weighted
// deviation of its parts as a systematic error. Longer clusters (a guard rail, a
// wall) are taken apart again, and so is what has no cluster.
// Noise, where the radar is known (r the detection's signal to noise in a cell, C channels, bins of the
// windows' variance ratio q, S the sum of squares of the virtual elements' places to the right about their
// mean):
//   bin       sqrt(6 q / (r C)) / (2 pi) of a range or a Doppler cell
//   azimuth   wavelength / (2 pi cos azimuth sqrt(2 r S)), at most 1 rad, as where there is one element;
//             for N on a line, where S is pitch^2 N (N^2 - 1) / 12, the bound of angle_peak.h
// (signal/detection/tone.h, angle_peak.h.) Beside it stands what the echo of a body wanders over it:
// `errors`, as systematic errors.
#pragma once

#include <vector>

#include "session/signal/detection_file.h"
#include "session/signal/radar.h"
#include "tracking/filters/observation.h"
#include "tracking/tracker/track_geometry.h"

namespace fanbeam::session {

struct BodyErrors {
  double range_m = 0.3, range_rate_mps = 0.1, azimuth_rad = 0.0174532925199433;
};

inline constexpr double kLongestObject_m = 8.0;  // a car or a van; lorries may be two

// `radar` null: errors alone.
std::vector<tracking::RadarMeasurement> measurements_of(const DetectedFrame& frame,
                                                        const FmcwRadar* radar,
                                                        const BodyErrors& errors);

// What two targets have to be apart on one axis to be two detections: widths between half powers, of
// the line of as many elements and the same S in azimuth.
tracking::Resolution resolution_of(const FmcwRadar& radar);

}  // namespace fanbeam::session
