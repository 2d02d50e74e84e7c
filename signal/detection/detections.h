// From a beat cube to a list of detections: range, speed, angle and power of each.
//
// The range-Doppler map (sum over channels) goes through the detector, its local maxima are
// refined, the phases between transmit slots are taken off, and one direction is fitted to each
// snapshot. Refinement:
//   maximum_likelihood  from the beat cube (signal/detection/cube_tone.h): to the Cramer-Rao bound
//                       for a scatterer that is alone within some ten cells, pulled by neighbours
//   windowed            the same under the transform's windows: not pulled, at the windows' variance
// Two scatterers in one range-Doppler cell give one detection with a direction between them, or
// with AngleMethod::capon and music (signal/angle/source_directions.h, uniform lines) one each.
//
// The speed is unambiguous within +-wavelength / (4 repetition). With `unfold`, a time-division
// array tells which of its folds it is (signal/transform/slot_compensation.h).
// The detector is that of CfarSettings on the sum over channels; calibrate its design probability
// with as many looks as the array has channels (signal/detection/cfar_calibration.h).
#pragma once

#include <vector>

#include "signal/angle/source_directions.h"
#include "signal/cube.h"
#include "signal/detection/cfar.h"
#include "signal/transform/cube_maps.h"
#include "signal/transform/range_doppler.h"
#include "signal/waveform/array.h"

namespace fanbeam::signal {

struct RadarDetection {
  double range_m = 0.0;  // at the middle of the frame, from the array's origin; above 0
  double radial_speed_mps = 0.0;
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;
  double power_W = 0.0;  // at one receiver's port, of the fitted direction
  // Of the map's cell: power over background, less 1; of several waves in it each has its share by power.
  double snr = 0.0;
  double range_cell = 0.0;  // of the transformed cube, fractional
  double doppler_cell = 0.0;
};

enum class Refinement { maximum_likelihood, windowed };

struct DetectionSettings {
  RangeDopplerSettings transform;
  CfarSettings cfar;
  Refinement refinement = Refinement::maximum_likelihood;
  AngleMethod angle = AngleMethod::beamforming;
  bool unfold = false;
};

// How the cube was recorded. The slope must rise; mirror the samples of a falling sweep.
struct CubeTiming {
  double sample_rate_Hz = 0.0;
  double slope_Hz_per_s = 0.0;
  double slot_period_s = 0.0;  // from one transmitter's chirp to the next one's
  double wavelength_m = 0.0;
};

// Ordered by Doppler cell, then range cell. E-RANGE for what the parts refuse, and for a cube whose
// channels are not the array's.
template <typename Real>
std::vector<RadarDetection> detect(const Cube<Real>& beat, const Array& array,
                                   const CubeTiming& timing, const DetectionSettings& settings);

// The same from a range-Doppler map that is at hand already: of the cube transformed by
// `settings.transform`, Projection::sum. E-RANGE for a map of another size.
template <typename Real>
std::vector<RadarDetection> detect(const Cube<Real>& beat, const PowerMap& map, const Array& array,
                                   const CubeTiming& timing, const DetectionSettings& settings);

}  // namespace fanbeam::signal
