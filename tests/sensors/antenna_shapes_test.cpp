// Shapes of antenna cuts beyond Gaussian and sinc, their side lobes, and the gain over the sphere.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "core/constants.h"
#include "core/units.h"
#include "sensors/antenna/beam_pattern.h"
#include "tests/decibel.h"
#include "tests/sensors/beam_cut.h"
#include "tests/sensors/shipped_sensor.h"

using namespace fanbeam;
using namespace fanbeam::sensors;
using core::kPi;
using core::radians;
using tests::cut_of;
using tests::dB;

namespace {

// Peak 4 deg below the horizon, cosecant from 8 to 40 deg of depression.
BeamCut cosecant() {
  BeamCut cut = cut_of(BeamCut::Shape::cosecant_squared, 6.0, 36.0);
  cut.peak_depression_rad = radians(4.0);
  cut.cosecant_from_rad = radians(4.0);
  cut.cosecant_to_rad = radians(36.0);
  return cut;
}

BeamCut trapezoid() {
  BeamCut cut = cut_of(BeamCut::Shape::table, 3.0, 2.0);
  cut.table_angle_rad = {radians(-2.0), radians(-1.0), radians(1.5), radians(2.0)};
  cut.table_gain = {0.0, 1.0, 1.0, 0.25};
  return cut;
}

BeamCut with_side_lobes(BeamCut cut, double level_dB, double extent_deg) {
  cut.side_lobe_gain = std::pow(10.0, level_dB / 10.0);
  cut.side_lobe_extent_rad = radians(extent_deg);
  return cut;
}

// Peak gain times the pattern, averaged over the sphere by a midpoint sum over patches between
// meridians: knows nothing of the pattern's own angles or of its integrals.
double mean_gain(const Antenna& antenna, ScanSurface surface) {
  const int azimuths = 14400, elevations = 1800;
  double sum = 0.0;
  for (int j = 0; j < elevations; ++j) {
    const double elevation = kPi / 2 * ((2.0 * j + 1.0) / elevations - 1.0);
    for (int i = 0; i < azimuths; ++i) {
      const double azimuth = kPi * ((2.0 * i + 1.0) / azimuths - 1.0);
      double seen_azimuth = azimuth, seen_elevation = elevation;
      if (surface == ScanSurface::cone) {
        seen_azimuth = std::asin(std::cos(elevation) * std::sin(azimuth));
        seen_elevation = std::atan2(std::sin(elevation), std::cos(elevation) * std::cos(azimuth));
      }
      const double across = one_way_gain_with_side_lobes(antenna.azimuth, seen_azimuth);
      if (across > 0.0)
        sum += across * std::cos(elevation) *
               one_way_gain_with_side_lobes(
                   antenna.elevation,
                   std::remainder(seen_elevation - antenna.boresight_elevation_rad, 2.0 * kPi));
    }
  }
  const double patch_sr = 2.0 * kPi / azimuths * kPi / elevations;
  return antenna.peak_gain * sum * patch_sr / (4.0 * kPi);
}

}  // namespace

TEST_CASE("S06 gain integrated over the sphere is the efficiency, for every shape and with lobes",
          "[antenna_shapes]") {
  const BeamCut narrow = cut_of(BeamCut::Shape::gaussian, 2.0, 4.0);
  struct Pair {
    BeamCut azimuth, elevation;
  };
  const Pair pairs[] = {
      {narrow, cut_of(BeamCut::Shape::gaussian, 10.0, 20.0)},
      {cut_of(BeamCut::Shape::sinc_squared, 2.0, 90.0), cosecant()},
      {cut_of(BeamCut::Shape::cosine_aperture, 2.0, 90.0), trapezoid()},
      {with_side_lobes(narrow, -25.0, 90.0), with_side_lobes(cosecant(), -20.0, 60.0)},
      {with_side_lobes(narrow, -30.0, 180.0), cut_of(BeamCut::Shape::cosine_aperture, 8.0, 50.0)},
  };
  for (const Pair& pair : pairs)
    for (const ScanSurface surface : {ScanSurface::plane, ScanSurface::cone}) {
      Antenna antenna;
      antenna.azimuth = pair.azimuth;
      antenna.elevation = pair.elevation;
      antenna.boresight_elevation_rad = radians(-4.0);
      constexpr double kEfficiency = 0.6;
      antenna.peak_gain = kEfficiency * directivity(antenna, surface);
      INFO(static_cast<int>(pair.elevation.shape) << " " << static_cast<int>(surface));
      if (surface == ScanSurface::cone && pair.azimuth.side_lobe_extent_rad > kPi / 2) continue;
      CHECK(dB(mean_gain(antenna, surface) / kEfficiency) == Approx(0.0).epsilon(0.0).margin(0.01));
    }
}

TEST_CASE("S06 no shipped sensor radiates more than it is fed, and each as much as it says",
          "[antenna_shapes]") {
  int sensors_read = 0;
  for (const auto& entry : std::filesystem::directory_iterator(tests::sensor_path(""))) {
    if (entry.path().extension() != ".toml") continue;
    ++sensors_read;
    const Sensor sensor = tests::shipped_sensor(entry.path().filename().string());
    INFO(sensor.name);
    CHECK(sensor.antenna.efficiency <= 1.0);
    CHECK(dB(mean_gain(sensor.antenna, ScanSurface::cone) / sensor.antenna.efficiency) ==
          Approx(0.0).epsilon(0.0).margin(0.01));
  }
  CHECK(sensors_read >= 2);
}

TEST_CASE("a cosine aperture has its published width, null and first side lobe",
          "[antenna_shapes]") {
  // Balanis, Antenna Theory, 4th ed., table 12.1: half-power width 1.189 wavelengths over the
  // length, null at 3/2, first side lobe -23.0 dB.
  const BeamCut cut = cut_of(BeamCut::Shape::cosine_aperture, 4.0, 90.0);
  CHECK(one_way_gain(cut, 0.0) == 1.0);
  CHECK(one_way_gain(cut, radians(2.0)) == Approx(0.5).epsilon(1e-12));
  const double sine_per_u = std::sin(radians(2.0)) / (1.189 / 2.0);
  CHECK(one_way_gain(cut, std::asin(1.5 * sine_per_u)) < 1e-6);
  CHECK(one_way_gain(cut, std::asin(0.5 * sine_per_u)) ==
        Approx(kPi * kPi / 16.0).epsilon(2e-3));  // where the formula is 0/0
  double lobe = 0.0;
  for (double u = 1.5; u < 2.5; u += 1e-3)
    lobe = std::max(lobe, one_way_gain(cut, std::asin(u * sine_per_u)));
  CHECK(dB(lobe) == Approx(-23.0).epsilon(0.0).margin(0.05));
  CHECK(main_beam(cut).cut_rad == Approx(std::asin(1.5 * sine_per_u)).epsilon(1e-3));
}

TEST_CASE("a cosecant-squared beam gives a target at constant depth the same power at any range",
          "[antenna_shapes]") {
  const BeamCut cut = cosecant();
  const double height_m = 100.0;
  const auto power = [&](double depression_rad) {
    const double range_m = height_m / std::sin(depression_rad);
    return two_way_gain(cut, radians(4.0) - depression_rad) / std::pow(range_m, 4);
  };
  for (const double depression_deg : {8.5, 12.0, 25.0, 39.9})
    CHECK(power(radians(depression_deg)) / power(radians(8.1)) == Approx(1.0).epsilon(1e-12));
  // No step where the cosecant takes over, nothing below it, the Gaussian above the peak.
  CHECK(one_way_gain(cut, -std::nextafter(cut.cosecant_from_rad, 1.0)) ==
        Approx(one_way_gain(cut, -cut.cosecant_from_rad)).epsilon(1e-12));
  CHECK(one_way_gain(cut, radians(-36.1)) == 0.0);
  CHECK(one_way_gain(cut, radians(3.0)) == Approx(0.5).epsilon(1e-12));
}

TEST_CASE("the two-way integral follows a cosecant beam across its knots", "[antenna_shapes]") {
  const BeamCut cut = cosecant();
  const double from = radians(-36.0), to = radians(10.0);
  const int steps = 400000;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) sum += two_way_gain(cut, from + (to - from) * (i + 0.5) / steps);
  CHECK(two_way_integral(cut, from, to) == Approx(sum * (to - from) / steps).epsilon(1e-9));
}

TEST_CASE("side lobes begin at the cut, end at their extent, and leave the main beam alone",
          "[antenna_shapes]") {
  const BeamCut main = cut_of(BeamCut::Shape::gaussian, 0.8, 1.25);
  const BeamCut cut = with_side_lobes(main, -35.0, 60.0);
  for (const double offset_deg : {0.0, 0.4, -1.2}) {
    CHECK(one_way_gain_with_side_lobes(cut, radians(offset_deg)) ==
          one_way_gain(main, radians(offset_deg)));
    CHECK(one_way_gain(cut, radians(offset_deg)) == one_way_gain(main, radians(offset_deg)));
  }
  for (const double offset_deg : {1.26, -30.0, 59.9}) {
    CHECK(one_way_gain(cut, radians(offset_deg)) == 0.0);
    CHECK(dB(one_way_gain_with_side_lobes(cut, radians(offset_deg))) == Approx(-35.0));
    CHECK(dB(two_way_gain_with_side_lobes(cut, radians(offset_deg))) == Approx(-70.0));
    CHECK(dB(TwoWayTable(cut)(radians(offset_deg))) == Approx(-70.0));
  }
  CHECK(one_way_gain_with_side_lobes(cut, radians(60.1)) == 0.0);
  CHECK(TwoWayTable(cut)(radians(60.1)) == 0.0);
  CHECK(reach_rad(cut) == radians(60.0));
  CHECK(reach_rad(main) == radians(1.25));
  CHECK(two_way_width(cut) == two_way_width(main));
  CHECK(reach_rad(main_beam(cut)) == main.cut_rad);
  // The directivity pays for them: 1e-3.5 times both sides, on HiVision's 0.8 deg.
  Antenna antenna = tests::hivision().antenna;
  const double before = directivity(antenna, ScanSurface::plane);
  antenna.azimuth = cut;
  const double one_way_rad = radians(0.8) * std::sqrt(kPi / (4.0 * std::log(2.0)));
  const double lobes = std::pow(10.0, -3.5) * radians(2.0 * (60.0 - 1.25)) / one_way_rad;
  CHECK(before / directivity(antenna, ScanSurface::plane) == Approx(1.0 + lobes).epsilon(1e-5));
}
