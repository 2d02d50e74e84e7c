// From detections to measurements: what an array tells of azimuth depends on where its elements are.
#include "session/signal/measurements.h"

#include <catch2/catch.hpp>

#include "core/constants.h"
#include "core/units.h"
#include "sensors/sensor_file.h"

using namespace fanbeam;

namespace {

// One transmitter and receivers at these places, in half wavelengths to the right and up.
session::FmcwRadar radar_with(const std::vector<glm::dvec2>& right_up) {
  core::ProblemList problems;
  const sensors::Sensor sensor =
      sensors::read_sensor(FANBEAM_SOURCE_DIR "/sensors/automotive-76.toml", problems);
  const double half_m = 0.5 * core::kSpeedOfLight_mps / sensor.waveform.frequency_Hz;
  session::FmcwSettings options;
  options.transmitters_m = {{0.0, 0.0, 0.0}};
  for (const glm::dvec2& place : right_up)
    options.receivers_m.push_back({0.0, place.x * half_m, place.y * half_m});
  return session::fmcw_radar(options, sensor);
}

tracking::RadarMeasurement measured(const session::FmcwRadar& radar) {
  session::DetectedFrame frame;
  signal::RadarDetection one;
  one.range_m = 50.0;
  one.azimuth_rad = 0.5;
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
    CHECK(std::abs(found[0].azimuth_rad) == Approx(core::kPi).margin(1e-12));
    CHECK(found[0].azimuth_systematic_rad == Approx(core::radians(1.0)).epsilon(1e-9));
  }
}
