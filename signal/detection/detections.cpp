#include "signal/detection/detections.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>

#include "core/constants.h"
#include "core/errors.h"
#include "signal/angle/angle_peak.h"
#include "signal/detection/cube_tone.h"
#include "signal/detection/map_peaks.h"
#include "signal/transform/cube_maps.h"
#include "signal/transform/slot_compensation.h"

namespace fanbeam::signal {
namespace {

// A peak of the map with its refined place, in cells of the transformed cube.
struct Place {
  double range_cell = 0.0;
  double doppler_cell = 0.0;
  std::vector<std::complex<double>> snapshot;
};

template <typename Real>
class Refiner {
 public:
  Refiner(const Cube<Real>& beat, const Cube<Real>& transformed, const DetectionSettings& settings,
          int range_length)
      : beat_(beat),
        transformed_(transformed),
        refinement_(settings.refinement),
        range_padding_(static_cast<double>(range_length) / beat.shape.samples),
        doppler_padding_(static_cast<double>(transformed.shape.chirps) / beat.shape.chirps) {
    if (refinement_ == Refinement::windowed)
      weights_ = {window_weights(settings.transform.range_window, beat.shape.samples),
                  window_weights(settings.transform.doppler_window, beat.shape.chirps)};
  }

  Place run(const MapPeak& peak) const {
    const int rest = transformed_.shape.chirps / 2;
    if (refinement_ == Refinement::parabola) {
      Place place{peak.column, peak.row, {}};
      for (int channel = 0; channel < transformed_.shape.channels; ++channel)
        place.snapshot.push_back(static_cast<std::complex<double>>(
            transformed_.at(channel, peak.cell.row, peak.cell.column)));
      return place;
    }
    const CubeTone tone = refined_in_cube(beat_, peak.column / range_padding_,
                                          (peak.row - rest) / doppler_padding_, weights_);
    return {tone.range_bin * range_padding_, tone.doppler_bin * doppler_padding_ + rest,
            tone.snapshot};
  }

 private:
  const Cube<Real>& beat_;
  const Cube<Real>& transformed_;
  Refinement refinement_;
  double range_padding_;
  double doppler_padding_;
  ToneWeights weights_;
};

RadarDetection measured(Place place, double snr, const RangeDopplerAxes& axes, const Array& array,
                        const CubeTiming& timing, const DetectionSettings& settings) {
  RadarDetection detection;
  detection.snr = snr;
  detection.range_cell = place.range_cell;
  detection.doppler_cell = place.doppler_cell;
  double doppler_Hz = axes.doppler_Hz(place.doppler_cell);
  if (settings.unfold)
    doppler_Hz +=
        doppler_fold(place.snapshot, array, doppler_Hz, timing.slot_period_s, timing.wavelength_m) /
        (array.slots() * timing.slot_period_s);
  compensate_slots(place.snapshot, array, doppler_Hz, timing.slot_period_s);
  const auto elements_m = virtual_elements_m(array);
  const AnglePeak angle = settings.elevation
                              ? direction_peak(place.snapshot, elements_m, timing.wavelength_m)
                              : azimuth_peak(place.snapshot, elements_m, timing.wavelength_m);
  detection.azimuth_rad = angle.azimuth_rad;
  detection.elevation_rad = angle.elevation_rad;
  detection.power_W = angle.power;
  detection.range_m = axes.range_m(place.range_cell, doppler_Hz);
  // The mixed phase -S tau^2 / 2 takes the beat off the frequency that Doppler counts with: 66 ppm
  // at 60 m and 12.5 MHz/us.
  const double frequency_Hz = core::kSpeedOfLight_mps / timing.wavelength_m;
  const double beat_Hz = 2.0 * timing.slope_Hz_per_s * detection.range_m / core::kSpeedOfLight_mps;
  detection.radial_speed_mps =
      0.5 * core::kSpeedOfLight_mps * doppler_Hz / (frequency_Hz - beat_Hz);
  return detection;
}

}  // namespace

template <typename Real>
std::vector<RadarDetection> detect(const Cube<Real>& beat, const Array& array,
                                   const CubeTiming& timing, const DetectionSettings& settings) {
  if (beat.shape.channels != array.channels())
    core::throw_input_error(core::ErrorClass::range, "cube.channels", beat.shape.channels,
                            "the channels of the array");
  Cube<Real> transformed;
  range_doppler(beat, settings.transform, transformed);
  const int range_length =
      settings.transform.range_length == 0 ? beat.shape.samples : settings.transform.range_length;
  const RangeDopplerAxes axes = range_doppler_axes(
      timing.sample_rate_Hz, timing.slope_Hz_per_s, array.slots() * timing.slot_period_s,
      timing.wavelength_m, range_length, transformed.shape.chirps);
  const PowerMap map = range_doppler_map(transformed, Projection::sum);
  const auto peaks =
      map_peaks(map, cfar_detections(map, settings.cfar), settings.cfar.along_rows.wraps);
  const Refiner<Real> refiner(beat, transformed, settings, range_length);
  std::vector<RadarDetection> detections;
  for (const MapPeak& peak : peaks) {
    const double snr = peak.cell.background_W > 0.0
                           ? std::max(0.0, peak.cell.power_W / peak.cell.background_W - 1.0)
                           : std::numeric_limits<double>::infinity();
    detections.push_back(measured(refiner.run(peak), snr, axes, array, timing, settings));
  }
  return detections;
}

template std::vector<RadarDetection> detect(const FloatCube&, const Array&, const CubeTiming&,
                                            const DetectionSettings&);
template std::vector<RadarDetection> detect(const DoubleCube&, const Array&, const CubeTiming&,
                                            const DetectionSettings&);

}  // namespace fanbeam::signal
