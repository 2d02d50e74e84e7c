// From detections to measurements: what an array tells of azimuth depends on where its elements are; the time and the
// plane that measurements belong to, and their errors.
#include "session/signal/measurements.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/constants.h"
#include "core/units.h"
#include "sensors/sensor_file.h"
#include "session/signal/chain.h"
#include "tracking/metrics/error_statistics.h"

using namespace fanbeam;

namespace {

sensors::Sensor automotive() {
  core::ProblemList problems;
  return sensors::read_sensor(FANBEAM_SOURCE_DIR "/sensors/automotive-76.toml", problems);
}

// One transmitter and receivers at these places, in half wavelengths to the right and up.
session::FmcwRadar radar_with(const std::vector<glm::dvec2>& right_up) {
  const sensors::Sensor sensor = automotive();
  const double half_m = 0.5 * core::kSpeedOfLight_mps / sensor.waveform.frequency_Hz;
  session::FmcwSettings options;
  options.transmitters_m = {{0.0, 0.0, 0.0}};
  for (const glm::dvec2& place : right_up)
    options.receivers_m.push_back({0.0, place.x * half_m, place.y * half_m});
  return session::fmcw_radar(options, sensor);
}

tracking::RadarMeasurement measured(const session::FmcwRadar& radar, double elevation_rad = 0.0) {
  session::DetectedFrame frame;
  signal::RadarDetection one;
  one.range_m = 50.0;
  one.azimuth_rad = 0.5;
  one.elevation_rad = elevation_rad;
  one.power_W = 1e-12;
  one.snr = 200.0;
  frame.detections = {one};
  frame.clusters = {signal::kNoCluster};
  return session::measurements_of(frame, &radar, {}).at(0);
}

// Of one cluster: two parts of one power at a range.
std::vector<tracking::RadarMeasurement> of_cluster(double range_m, double first_deg,
                                                   double second_deg) {
  session::DetectedFrame frame;
  for (const double azimuth_deg : {first_deg, second_deg}) {
    signal::RadarDetection one;
    one.range_m = range_m;
    one.azimuth_rad = core::radians(azimuth_deg);
    one.power_W = 1e-12;
    frame.detections.push_back(one);
    frame.clusters.push_back(0);
  }
  return session::measurements_of(frame, nullptr, {0.0, 0.0, 0.0});
}

// Of the strongest detection of a frame that holds one path.
tracking::RadarMeasurement measured(const session::FmcwRadar& radar,
                                    const session::FmcwSettings& options,
                                    const signal::ScatterPath& path, int frame) {
  const auto found =
      session::fmcw_frame(radar, {path}, frame, options, {"detections"}).found->detections;
  REQUIRE_FALSE(found.empty());
  const auto strongest = std::max_element(
      found.begin(), found.end(), [](const auto& a, const auto& b) { return a.snr < b.snr; });
  return session::measurements_of({0.0, {*strongest}, {signal::kNoCluster}, {}}, &radar, {}).at(0);
}

}  // namespace

TEST_CASE("An array's azimuth error is that of where its elements are, in whatever order",
          "[fmcw]") {
  const session::FmcwRadar line = radar_with({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}});
  REQUIRE(line.line);
  // sqrt(6 / (r N (N^2 - 1))) / (2 pi d / wavelength cos azimuth).
  const double n = 6.0;
  const double bound_rad =
      std::sqrt(6.0 / (200.0 * n * (n * n - 1.0))) / (2.0 * core::kPi * 0.5 * std::cos(0.5));
  CHECK(measured(line).azimuth_sigma_rad == Approx(bound_rad).epsilon(1e-9));
  CHECK(session::resolution_of(line).azimuth_rad == Approx(0.8859 / (0.5 * n)).epsilon(1e-9));
  // The same places in another order, two of them a little higher: no line any more.
  const session::FmcwRadar mixed = radar_with({{3, 0}, {0, 1}, {5, 0}, {1, 0}, {4, 1}, {2, 0}});
  REQUIRE_FALSE(mixed.line);
  CHECK(measured(mixed).azimuth_sigma_rad == Approx(bound_rad).epsilon(1e-9));
  CHECK(session::resolution_of(mixed).azimuth_rad == Approx(0.8859 / (0.5 * n)).epsilon(1e-9));
  // Twice as wide: half the error.
  const session::FmcwRadar wide = radar_with({{6, 0}, {0, 1}, {10, 0}, {2, 0}, {8, 1}, {4, 0}});
  CHECK(measured(wide).azimuth_sigma_rad == Approx(0.5 * bound_rad).epsilon(1e-9));
}

TEST_CASE("Elements one above the other, or one alone, tell no azimuth and say so", "[fmcw]") {
  for (const auto& places :
       {std::vector<glm::dvec2>{{0, 0}}, std::vector<glm::dvec2>{{0, 0}, {0, 1}, {0, 2}}}) {
    const session::FmcwRadar radar = radar_with(places);
    CHECK(measured(radar).azimuth_sigma_rad == 1.0);
    CHECK(session::resolution_of(radar).azimuth_rad == 1.0);
  }
}

TEST_CASE("A cluster is as long as its parts are apart, wherever it lies", "[fmcw]") {
  // 14 m apart far to the side, where R sin azimuth differs by 6.8 m.
  CHECK(of_cluster(100.0, 57.0, 65.0).size() == 2);
  CHECK(of_cluster(100.0, -4.0, 4.0).size() == 2);
  CHECK(of_cluster(100.0, 59.0, 63.0).size() == 1);
}

TEST_CASE("A cluster behind the radar is measured behind it", "[fmcw]") {
  for (const double side : {1.0, -1.0}) {
    const auto found = of_cluster(50.0, side * 179.0, side * -179.0);
    REQUIRE(found.size() == 1);
    CHECK(std::abs(found[0].azimuth_rad) == Approx(core::kPi).epsilon(0.0).margin(1e-12));
    CHECK(found[0].azimuth_systematic_rad == Approx(core::radians(1.0)).epsilon(1e-9));
  }
}

TEST_CASE("What moves is measured where it is at the time of the frame", "[fmcw]") {
  const sensors::Sensor sensor = automotive();
  session::FmcwSettings options;  // 256 chirps of three transmitters: their middle is 7.7 ms later
  const session::FmcwRadar radar = session::fmcw_radar(options, sensor);
  for (const double speed_mps : {15.0, -15.0}) {
    signal::ScatterPath path;
    path.range_m = 40.0;
    path.radial_speed_mps = speed_mps;
    path.amplitude_sqrtW = std::sqrt(1e5 * radar.noise_cell_W);
    const auto found = measured(radar, options, path, 0);
    INFO(speed_mps << " m/s");
    CHECK(found.range_rate_mps == Approx(speed_mps).margin(0.05).epsilon(0.0));
    CHECK(found.range_m == Approx(40.0).margin(0.01).epsilon(0.0));  // was 0.115 m off
  }
}

TEST_CASE("Errors of a radar's detections are as large as their measurements tell", "[fmcw]") {
  const sensors::Sensor sensor = automotive();
  session::FmcwSettings options;
  options.transmitters = 1;
  options.most_range_m = 42.0;
  options.numbers[11] = 32.0;  // chirps
  const session::FmcwRadar radar = session::fmcw_radar(options, sensor);
  // In the middle of a cell, 30 dB over its noise; half way to the next, cells have less of a tone than its peak.
  signal::ScatterPath path;
  path.radial_speed_mps = radar.axes.speed_mps(20.0);
  path.range_m = radar.axes.range_m(60.0, radar.axes.doppler_Hz(20.0)) -
                 path.radial_speed_mps * radar.middle_s;
  path.amplitude_sqrtW = std::sqrt(1e3 * radar.noise_cell_W);
  tracking::MeanSquare range, rate, azimuth;
  for (int frame = 0; frame < 600; ++frame) {
    const auto found = measured(radar, options, path, frame);
    range.add((found.range_m - path.range_m) / found.range_sigma_m);
    rate.add((found.range_rate_mps - path.radial_speed_mps) / found.range_rate_sigma_mps);
    azimuth.add(found.azimuth_rad / found.azimuth_sigma_rad);
  }
  INFO("range " << range.rms() << ", rate " << rate.rms() << ", azimuth " << azimuth.rms());
  // 600 draws: 3 % in the root mean square. Chebyshev windows of 60 dB have 1.23 and 1.24 for the root of their bandwidth.
  CHECK(range.rms() == Approx(1.0).margin(0.1).epsilon(0.0));
  CHECK(rate.rms() == Approx(1.0).margin(0.1).epsilon(0.0));
  CHECK(azimuth.rms() == Approx(1.0).margin(0.1).epsilon(0.0));
}

TEST_CASE("What is seen above the antenna's plane is measured on it", "[fmcw]") {
  session::DetectedFrame frame;
  for (const double elevation_rad : {0.3, -0.3}) {
    signal::RadarDetection one;
    one.range_m = 50.0;
    one.radial_speed_mps = -10.0 * std::cos(0.3);  // of 10 m/s along the plane
    one.elevation_rad = elevation_rad;
    frame.detections.push_back(one);
    frame.clusters.push_back(signal::kNoCluster);
  }
  for (const auto& found : session::measurements_of(frame, nullptr, {})) {
    CHECK(found.range_m == Approx(50.0 * std::cos(0.3)).epsilon(1e-12));
    CHECK(found.range_rate_mps == Approx(-10.0).epsilon(1e-12));
  }
  const session::FmcwRadar flat = radar_with({{0, 0}, {1, 0}, {2, 0}, {3, 0}});
  CHECK_FALSE(session::tells_elevation(flat));
  // Of six elements 6 and 99 mm above the origin the mean, summed up, is not the height to the last bit.
  for (const double up : {3.0, 50.0})
    CHECK_FALSE(session::tells_elevation(
        radar_with({{0, up}, {1, up}, {2, up}, {3, up}, {4, up}, {5, up}})));
  const session::FmcwRadar square = radar_with({{0, 0}, {1, 0}, {0, 1}, {1, 1}});
  REQUIRE(session::tells_elevation(square));
  // Four elements half a pitch up and down: S' is pitch^2, and an error of the elevation moves the range on the plane by
  // R sin e.
  const double rise_rad = 1.0 / (2.0 * core::kPi * 0.5 * std::cos(0.3) * std::sqrt(2.0 * 200.0));
  const double level_m = measured(square).range_sigma_m;
  CHECK(measured(square, 0.3).range_sigma_m ==
        Approx(std::hypot(level_m * std::cos(0.3), 50.0 * std::sin(0.3) * rise_rad)).epsilon(1e-9));
}
