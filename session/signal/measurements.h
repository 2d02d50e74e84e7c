// From detections to what a tracker takes: one measurement an object, with its errors.
//
// Detections of one cluster no longer than an object, by the diagonal of their extents forward and right, are
// one measurement: means weighted with the power (of azimuths across the half turn behind too), and the weighted
// deviation of its parts as a systematic error. Longer clusters (a guard rail, a
// wall) are taken apart again, and so is what has no cluster.
// Measurements lie on the plane of the antenna's forward and right axes, as a tracker's states do. A detection at the
// elevation e has the range R cos e there; its speed becomes v / cos e, as of a target that moves along the plane at
// whatever height.
// Where the radar is known:
// Time. Detections have the range at the middle of the chirps, frames the time of the waveform's clock at 0: the range
// told is the one then, R - v t with t the middle's time (1.3 cm too far a millisecond at 50 km/h otherwise).
// Noise (r the detection's signal to noise in a cell, C channels, bins of the windows' variance ratio q and noise
// bandwidth w, S the sum of squares of the virtual elements' places to the right about their mean, S' of those up):
//   bin       sqrt(6 q / (w r C)) / (2 pi) of a range or a Doppler cell: q is over the bound of all the
//             energy, and r has lost w of it to the window
//   azimuth   wavelength / (2 pi cos azimuth cos e sqrt(2 r S)), at most 1 rad, as where there is one element;
//             for N on a line, where S is pitch^2 N (N^2 - 1) / 12, the bound of angle_peak.h
//   plane     what the elevation's, wavelength / (2 pi cos e sqrt(2 r S')), turns R cos e and v / cos e by beside
// (signal/detection/tone.h, window_figures.h, angle_peak.h.) Beside it stands what the echo of a body wanders over
// it: `errors`, as systematic errors. Neglected: speeds that are folds of others; what the plane is tilted against
// the ground.
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

// On the plane, of a slant range and a radial speed.
double on_plane_m(double range_m, double elevation_rad);
double on_plane_mps(double radial_speed_mps, double elevation_rad);
// Whether the elements stand beside each other; others see everything at azimuth 0.
bool tells_azimuth(const FmcwRadar& radar);
// Whether the elements stand at several heights; others see everything at elevation 0.
bool tells_elevation(const FmcwRadar& radar);

// `radar` null: errors alone, and ranges as they are.
std::vector<tracking::RadarMeasurement> measurements_of(const DetectedFrame& frame,
                                                        const FmcwRadar* radar,
                                                        const BodyErrors& errors);

// What two targets have to be apart on one axis to be two detections: widths between half powers, of
// the line of as many elements and the same S in azimuth.
tracking::Resolution resolution_of(const FmcwRadar& radar);

}  // namespace fanbeam::session
