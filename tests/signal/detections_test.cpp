// The whole receiving chain on synthesised beats: path in, detection out.
#include "signal/detection/detections.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/constants.h"
#include "core/errors.h"
#include "core/units.h"
#include "signal/detection/cfar_calibration.h"
#include "signal/synthesis/reference.h"
#include "signal/waveform/factories.h"
#include "tests/signal/reference_radar.h"
#include "tests/signal/test_tones.h"

using namespace fanbeam;
using namespace fanbeam::signal;
using core::radians;
using tests::kSlot_s;
using tests::kWavelength_m;

namespace {

struct Radar {
  Waveform waveform;
  Array array = line_array(3, 4, 0.5 * kWavelength_m);
  CubeTiming timing;

  Radar() {
    ChirpSequenceParameters parameters;
    parameters.frequency_Hz = 76e9;
    parameters.bandwidth_Hz = 250e6;
    parameters.ramp_s = kSlot_s;
    parameters.interval_s = kSlot_s;
    parameters.chirps = 64;
    parameters.slots = 3;
    parameters.sample_rate_Hz = 12.8e6;
    waveform = chirp_sequence(parameters);
    timing = {12.8e6, 250e6 / kSlot_s, kSlot_s, kWavelength_m};
  }
};

DetectionSettings settings_for(const CubeShape& shape) {
  DetectionSettings settings;
  settings.cfar = {.kind = CfarKind::ordered_statistic,
                   .design_probability = 1e-6,
                   .along_columns = {2, 4, false},
                   .along_rows = {2, 2, true}};
  settings.cfar.design_probability =
      calibrated_cfar(
          settings.cfar,
          {window_weights(settings.transform.range_window, shape.samples), shape.samples,
           window_weights(settings.transform.doppler_window, shape.chirps), shape.chirps},
          shape.channels)
          .design_probability;
  settings.unfold = true;
  return settings;
}

ScatterPath path(double range_m, double speed_mps, double azimuth_deg, double power_W) {
  ScatterPath result;
  result.range_m = range_m;
  result.radial_speed_mps = speed_mps;
  result.azimuth_rad = radians(azimuth_deg);
  result.amplitude_sqrtW = std::sqrt(power_W);
  return result;
}

}  // namespace

TEST_CASE("synthesised paths come out as detections at their place", "[detections]") {
  const Radar radar;
  const std::vector<ScatterPath> paths = {path(40.0, -100.0 / 3.6, 10.0, 1.0),
                                          path(75.0, 5.0, -25.0, 0.3),
                                          path(110.0, -14.0, 40.0, 0.1)};
  DoubleCube beat = reference_beat(radar.waveform, 0, radar.array, paths);
  tests::add_noise(beat, 10.0, 31);  // -10 dB per sample for the first: 32 dB per channel
  const DetectionSettings settings = settings_for(beat.shape);
  const auto found = detect(beat, radar.array, radar.timing, settings);
  // Middle of the frame, where ranges are told.
  const double middle_s = 0.5 * 64 * 3 * kSlot_s;
  REQUIRE(found.size() == paths.size());
  for (const ScatterPath& truth : paths) {
    const RadarDetection* nearest = &found[0];
    for (const RadarDetection& detection : found)
      if (std::abs(detection.range_m - truth.range_m) < std::abs(nearest->range_m - truth.range_m))
        nearest = &detection;
    INFO("path at " << truth.range_m << " m: " << nearest->range_m << " m, "
                    << nearest->radial_speed_mps << " m/s, "
                    << nearest->azimuth_rad * 180.0 / core::kPi << " deg");
    // Three sigma of the weakest: 32 dB over 12 channels.
    CHECK(nearest->range_m ==
          Approx(truth.range_m + truth.radial_speed_mps * middle_s).margin(0.03).epsilon(0.0));
    CHECK(nearest->radial_speed_mps == Approx(truth.radial_speed_mps).margin(0.03).epsilon(0.0));
    CHECK(nearest->azimuth_rad == Approx(truth.azimuth_rad).margin(radians(0.7)).epsilon(0.0));
    CHECK(nearest->power_W == Approx(std::norm(truth.amplitude_sqrtW)).epsilon(0.25));
  }
  // From a map that is at hand, the same list to the last bit.
  DoubleCube transformed;
  range_doppler(beat, settings.transform, transformed);
  const PowerMap map = range_doppler_map(transformed, Projection::sum);
  const auto from_map = detect(beat, map, radar.array, radar.timing, settings);
  REQUIRE(from_map.size() == found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    CHECK(from_map[i].range_m == found[i].range_m);
    CHECK(from_map[i].azimuth_rad == found[i].azimuth_rad);
  }
  CHECK_THROWS_AS(
      detect(beat, PowerMap(map.rows, map.columns - 1), radar.array, radar.timing, settings),
      core::InputError);
  // In single precision the same list.
  FloatCube single(beat.shape);
  for (std::size_t i = 0; i < beat.values.size(); ++i)
    single.values[i] = static_cast<std::complex<float>>(beat.values[i]);
  const auto again = detect(single, radar.array, radar.timing, settings);
  REQUIRE(again.size() == found.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    CHECK(again[i].range_m == Approx(found[i].range_m).margin(1e-4).epsilon(0.0));
}

TEST_CASE("Two waves of a cell have the signal to noise of their own powers", "[detections]") {
  const Radar radar;
  DoubleCube beat = reference_beat(radar.waveform, 0, radar.array,
                                   {path(60.0, 0.0, -20.0, 1.0), path(60.0, 0.0, 20.0, 0.1)});
  tests::add_noise(beat, 10.0, 33);  // 32 and 22 dB per channel
  DetectionSettings settings = settings_for(beat.shape);
  settings.unfold = false;
  const auto one = detect(beat, radar.array, radar.timing, settings);
  REQUIRE(one.size() == 1);
  settings.angle = AngleMethod::music;
  const auto two = detect(beat, radar.array, radar.timing, settings);
  REQUIRE(two.size() == 2);
  CHECK(two[0].snr + two[1].snr == Approx(one[0].snr).epsilon(1e-12));
  CHECK(two[1].snr / two[0].snr == Approx(two[1].power_W / two[0].power_W).epsilon(1e-12));
  CHECK(two[1].snr / two[0].snr == Approx(0.1).epsilon(0.25));
}

TEST_CASE("compensation leaves less than 0.02 deg at 100 km/h without noise",
          "[detections][slots]") {
  const Radar radar;
  const DetectionSettings settings = settings_for({256, 64, 12});
  for (const double azimuth_deg : {0.0, 13.0, -35.0}) {
    const auto beat = reference_beat(radar.waveform, 0, radar.array,
                                     {path(60.0, -100.0 / 3.6, azimuth_deg, 1.0)});
    DoubleCube noisy = beat;
    tests::add_noise(noisy, 1e-9, 32);  // the detector needs a background
    const auto found = detect(noisy, radar.array, radar.timing, settings);
    REQUIRE(!found.empty());
    const auto strongest = std::max_element(
        found.begin(), found.end(),
        [](const RadarDetection& a, const RadarDetection& b) { return a.power_W < b.power_W; });
    INFO(strongest->azimuth_rad * 180.0 / core::kPi << " deg, " << strongest->radial_speed_mps);
    CHECK(std::abs(strongest->azimuth_rad * 180.0 / core::kPi - azimuth_deg) < 0.02);
    CHECK(strongest->radial_speed_mps == Approx(-100.0 / 3.6).margin(5e-4).epsilon(0.0));
  }
}

TEST_CASE("noise alone gives hardly a detection", "[detections]") {
  const Radar radar;
  DoubleCube beat({256, 64, 12});
  tests::add_noise(beat, 1.0, 33);
  // 16384 cells at 1e-6.
  CHECK(detect(beat, radar.array, radar.timing, settings_for(beat.shape)).size() <= 1);
  CHECK_THROWS_AS(detect(DoubleCube({8, 8, 3}), radar.array, radar.timing, {}), core::InputError);
}

// The first cell's peak of what stands at the radar is refined to either side of it.
TEST_CASE("no detection lies behind the radar or at it", "[detections]") {
  const Radar radar;
  DetectionSettings settings = settings_for({256, 64, 12});
  int near = 0;
  for (const double speed_mps : {0.0, 6.0, 12.0, 16.0}) {
    DoubleCube beat =
        reference_beat(radar.waveform, 0, radar.array, {path(0.02, speed_mps, 0.0, 1.0)});
    tests::add_noise(beat, 1e-6, 33);
    for (const RadarDetection& found : detect(beat, radar.array, radar.timing, settings)) {
      CHECK(found.range_m > 0.0);
      near += found.range_m < 1.0 ? 1 : 0;
    }
  }
  CHECK(near > 0);
}
