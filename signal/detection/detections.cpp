#include "signal/detection/detections.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>

#include "core/constants.h"
#include "signal/angle/plane_wave.h"
#include "signal/checks_private.h"
#include "signal/detection/cube_tone.h"
#include "signal/detection/map_peaks.h"
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
  Refiner(const Cube<Real>& beat, const DetectionSettings& settings, int range_length,
          int doppler_length)
      : beat_(beat),
        rest_cell_(doppler_length / 2),
        range_padding_(static_cast<double>(range_length) / beat.shape.samples),
        doppler_padding_(static_cast<double>(doppler_length) / beat.shape.chirps) {
    if (settings.refinement == Refinement::windowed)
      weights_ = {window_weights(settings.transform.range_window, beat.shape.samples),
                  window_weights(settings.transform.doppler_window, beat.shape.chirps)};
  }

  Place run(const MapPeak& peak) const {
    const CubeTone tone = refined_in_cube(beat_, peak.column / range_padding_,
                                          (peak.row - rest_cell_) / doppler_padding_, weights_);
    return {tone.range_bin * range_padding_, tone.doppler_bin * doppler_padding_ + rest_cell_,
            tone.snapshot};
  }

 private:
  const Cube<Real>& beat_;
  int rest_cell_;
  double range_padding_;
  double doppler_padding_;
  ToneWeights weights_;
};

// The directions of the waves in a snapshot, and where its Doppler lies once unfolded.
struct Directions {
  double doppler_Hz = 0.0;
  std::vector<SourceDirection> waves;
};

Directions directions_of(Snapshot snapshot, double doppler_Hz, double noise_W, const Array& array,
                         const CubeTiming& timing, const DetectionSettings& settings) {
  Directions found;
  found.doppler_Hz = doppler_Hz;
  if (settings.unfold)
    found.doppler_Hz +=
        doppler_fold(snapshot, array, doppler_Hz, timing.slot_period_s, timing.wavelength_m).fold /
        (array.slots() * timing.slot_period_s);
  compensate_slots(snapshot, array, found.doppler_Hz, timing.slot_period_s);
  found.waves = source_directions(snapshot, virtual_elements_m(array), timing.wavelength_m,
                                  settings.angle, noise_W);
  return found;
}

// What the place of a peak says, without its direction and power.
RadarDetection measured(const Place& place, double doppler_Hz, double snr,
                        const RangeDopplerAxes& axes, const CubeTiming& timing) {
  RadarDetection detection;
  detection.snr = snr;
  detection.range_cell = place.range_cell;
  detection.doppler_cell = place.doppler_cell;
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
std::vector<RadarDetection> detect(const Cube<Real>& beat, const PowerMap& map, const Array& array,
                                   const CubeTiming& timing, const DetectionSettings& settings) {
  if (beat.shape.channels != array.channels())
    refuse("cube.channels", beat.shape.channels, "the channels of the array");
  const CubeShape shape = range_doppler_shape(beat.shape, settings.transform);
  if (map.rows != shape.chirps) refuse("map.rows", map.rows, "the Doppler cells of the transform");
  if (map.columns != shape.samples)
    refuse("map.columns", map.columns, "the range cells of the transform");
  const int range_length =
      settings.transform.range_length == 0 ? beat.shape.samples : settings.transform.range_length;
  const RangeDopplerAxes axes = range_doppler_axes(timing.sample_rate_Hz, timing.slope_Hz_per_s,
                                                   array.slots() * timing.slot_period_s,
                                                   timing.wavelength_m, range_length, map.rows);
  const auto peaks =
      map_peaks(map, cfar_detections(map, settings.cfar), settings.cfar.along_rows.wraps);
  const Refiner<Real> refiner(beat, settings, range_length, map.rows);
  std::vector<RadarDetection> detections;
  for (const MapPeak& peak : peaks) {
    const double snr = peak.cell.background_W > 0.0
                           ? std::max(0.0, peak.cell.power_W / peak.cell.background_W - 1.0)
                           : std::numeric_limits<double>::infinity();
    const Place place = refiner.run(peak);
    const Directions directions =
        directions_of(place.snapshot, axes.doppler_Hz(place.doppler_cell),
                      peak.cell.background_W / array.channels(), array, timing, settings);
    double all_W = 0.0;
    for (const SourceDirection& wave : directions.waves) all_W += wave.power_W;
    for (const SourceDirection& wave : directions.waves) {
      const double share = directions.waves.size() > 1 ? wave.power_W / all_W : 1.0;
      RadarDetection detection = measured(place, directions.doppler_Hz, share * snr, axes, timing);
      // A peak in the first cell may be refined to the other side of the radar.
      if (!(detection.range_m > 0.0)) continue;
      detection.azimuth_rad = wave.azimuth_rad;
      detection.elevation_rad = wave.elevation_rad;
      detection.power_W = wave.power_W;
      detections.push_back(detection);
    }
  }
  return detections;
}

template <typename Real>
std::vector<RadarDetection> detect(const Cube<Real>& beat, const Array& array,
                                   const CubeTiming& timing, const DetectionSettings& settings) {
  Cube<Real> transformed;
  range_doppler(beat, settings.transform, transformed);
  return detect(beat, range_doppler_map(transformed, Projection::sum), array, timing, settings);
}

template std::vector<RadarDetection> detect(const FloatCube&, const PowerMap&, const Array&,
                                            const CubeTiming&, const DetectionSettings&);
template std::vector<RadarDetection> detect(const DoubleCube&, const PowerMap&, const Array&,
                                            const CubeTiming&, const DetectionSettings&);
template std::vector<RadarDetection> detect(const FloatCube&, const Array&, const CubeTiming&,
                                            const DetectionSettings&);
template std::vector<RadarDetection> detect(const DoubleCube&, const Array&, const CubeTiming&,
                                            const DetectionSettings&);

}  // namespace fanbeam::signal
