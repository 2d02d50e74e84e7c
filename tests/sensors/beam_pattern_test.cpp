#include "sensors/antenna/beam_pattern.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/constants.h"
#include "core/decibel.h"
#include "core/units.h"
#include "sensors/antenna/antenna_frame.h"
#include "tests/sensors/beam_cut.h"
#include "tests/sensors/numbers.h"
#include "tests/sensors/shipped_sensor.h"

using namespace fanbeam;
using namespace fanbeam::sensors;
using core::degrees;
using core::kPi;
using core::radians;
using tests::cut_of;
using tests::kInfinity;

namespace {

// Lopsided on purpose, so that left and right cannot be mixed up.
BeamCut triangle() {
  BeamCut cut = cut_of(BeamCut::Shape::table, 1.5, 2.0);
  cut.table_angle_rad = {radians(-1.0), 0.0, radians(2.0)};
  cut.table_gain = {0.0, 1.0, 0.0};
  return cut;
}

// Trapezoidal sum of the two-way gain, as an oracle that knows no closed form.
double summed(const BeamCut& cut, double from, double to, int steps) {
  double sum = 0.5 * (two_way_gain(cut, from) + two_way_gain(cut, to));
  for (int i = 1; i < steps; ++i) sum += two_way_gain(cut, from + (to - from) * i / steps);
  return sum * (to - from) / steps;
}

}  // namespace

TEST_CASE("every shape has half its power at half the half-power width", "[beam_pattern]") {
  const BeamCut gaussian = cut_of(BeamCut::Shape::gaussian, 0.8, 1.25);
  const BeamCut sinc = cut_of(BeamCut::Shape::sinc_squared, 10.0, 90.0);
  for (const double side : {-1.0, 1.0}) {
    CHECK(one_way_gain(gaussian, side * radians(0.4)) == Approx(0.5).epsilon(1e-14));
    CHECK(one_way_gain(sinc, side * radians(5.0)) == Approx(0.5).epsilon(1e-12));
    CHECK(two_way_gain(gaussian, side * radians(0.4)) == Approx(0.25).epsilon(1e-14));
  }
  CHECK(one_way_gain(triangle(), radians(-0.5)) == Approx(0.5).epsilon(1e-14));
  CHECK(one_way_gain(triangle(), radians(0.5)) == Approx(0.75).epsilon(1e-14));
}

TEST_CASE("gain ends at the cut and NaN has none", "[beam_pattern]") {
  const BeamCut cut = cut_of(BeamCut::Shape::gaussian, 0.8, 1.25);
  CHECK(one_way_gain(cut, cut.cut_rad) > 0.0);
  CHECK(one_way_gain(cut, std::nextafter(cut.cut_rad, 1.0)) == 0.0);
  CHECK(one_way_gain(cut, std::nan("")) == 0.0);
  CHECK(one_way_gain(triangle(), radians(2.0)) == 0.0);
  CHECK(one_way_gain(triangle(), radians(-1.5)) == 0.0);
}

TEST_CASE("S06 sin(x)/x is 1 at 0, 1 - x^2/6 near it and exactly 0 at its nulls",
          "[beam_pattern]") {
  CHECK(normalised_sinc(0.0) == 1.0);
  CHECK(normalised_sinc(-0.0) == 1.0);
  for (const double x : {1e-300, 1e-8, -1e-8, 1e-4})
    CHECK(normalised_sinc(x / kPi) == Approx(1.0 - x * x / 6.0).epsilon(0.0).margin(1e-15));
  for (const double null : {1.0, -1.0, 2.0, 3.0, 17.0, 1e6, 1e15})
    CHECK(normalised_sinc(null) == 0.0);
  // Just beside the first null the slope is -1: sin(pi (1 - e)) / (pi (1 - e)) = e (1 + e + ...).
  const double e = 0x1p-40;
  CHECK(normalised_sinc(1.0 - e) == Approx(e).epsilon(1e-11));
}

TEST_CASE("S06 a sinc pattern is finite 90 degrees off, at its nulls and at its peak",
          "[beam_pattern]") {
  const BeamCut cut = cut_of(BeamCut::Shape::sinc_squared, 10.0, 90.0);
  const double k = 1.391557378251510 / kPi / std::sin(radians(5.0));
  CHECK(one_way_gain(cut, 0.0) == 1.0);
  CHECK(one_way_gain(cut, 1e-300) == 1.0);
  for (const double null : {1.0, 2.0, 5.0}) {
    const double gain = one_way_gain(cut, std::asin(null / k));
    CHECK(gain < 1e-12);
    CHECK(core::dB_from_power(gain * gain, -120.0) == -120.0);  // shown as the floor
  }
  CHECK(one_way_gain(cut, kPi / 2) ==
        Approx(std::pow(std::sin(kPi * k) / (kPi * k), 2)).epsilon(0.0).margin(1e-12));
}

TEST_CASE("S06 the gain integrated over the sphere is 4 pi / D", "[beam_pattern]") {
  const Antenna antenna = tests::hivision().antenna;
  const AntennaFrame frame;
  for (const ScanSurface surface : {ScanSurface::cone, ScanSurface::plane}) {
    // Midpoint sum over patches cut by meridians, whatever the pattern's own angles are.
    double solid_angle_sr = 0.0;
    const int azimuths = 300, elevations = 800;
    const double azimuth_end = radians(2.0), elevation_end = radians(25.0);
    for (int j = 0; j < elevations; ++j) {
      const double elevation = elevation_end * ((2.0 * j + 1.0) / elevations - 1.0);
      for (int i = 0; i < azimuths; ++i) {
        const double azimuth = azimuth_end * ((2.0 * i + 1.0) / azimuths - 1.0);
        const auto seen =
            angles(frame, direction(frame, azimuth, elevation, ScanSurface::plane), surface);
        REQUIRE(seen);
        solid_angle_sr +=
            one_way_gain(antenna.azimuth, seen->azimuth_rad) *
            one_way_gain(antenna.elevation, seen->elevation_rad - antenna.boresight_elevation_rad) *
            std::cos(elevation);
      }
    }
    solid_angle_sr *= 4.0 * azimuth_end * elevation_end / (azimuths * elevations);
    const double summed_dB = 10.0 * std::log10(4.0 * kPi / solid_angle_sr);
    CHECK(10.0 * std::log10(directivity(antenna, surface)) ==
          Approx(summed_dB).epsilon(0.0).margin(0.002));
  }
}

TEST_CASE("directivity of HiVision is 36.58 dB, and 0.02 dB more where azimuth is a plane angle",
          "[beam_pattern]") {
  const Antenna antenna = tests::hivision().antenna;
  const double cone_dB = 10.0 * std::log10(directivity(antenna, ScanSurface::cone));
  CHECK(cone_dB == Approx(36.58).epsilon(0.0).margin(0.005));
  CHECK(10.0 * std::log10(directivity(antenna, ScanSurface::plane)) - cone_dB ==
        Approx(0.0215).epsilon(0.0).margin(0.0005));
}

TEST_CASE("a Gaussian beam of 0.8 deg returns as much as an even one of 0.60215 deg",
          "[beam_pattern]") {
  const BeamCut cut = cut_of(BeamCut::Shape::gaussian, 0.8, 1.25);
  CHECK(degrees(two_way_width(cut)) == Approx(0.60215).epsilon(0.0).margin(1e-5));
  // Closed form without the cut, which takes erfc(sqrt(8 ln2) 1.25 / 0.8) = 2e-7 of it.
  const double uncut = radians(0.8) * std::sqrt(kPi / (8.0 * std::log(2.0)));
  CHECK(two_way_width(cut) == Approx(uncut).epsilon(3e-7));
  CHECK(two_way_width(cut) < uncut);
}

TEST_CASE("parts of the two-way integral agree with a plain sum and add up", "[beam_pattern]") {
  const BeamCut cuts[] = {cut_of(BeamCut::Shape::gaussian, 0.8, 1.25),
                          cut_of(BeamCut::Shape::sinc_squared, 0.8, 3.0), triangle()};
  for (const BeamCut& cut : cuts) {
    double parts = 0.0;
    for (int i = -12; i < 12; ++i) {
      const double from = radians(0.25 * i), to = radians(0.25 * (i + 1));
      const double part = two_way_integral(cut, from, to);
      // Cuts and knots fall on ends of pieces, so the trapezoidal sum is good to 1e-6.
      CHECK(part ==
            Approx(summed(cut, from, to, 2000)).epsilon(0.0).margin(2e-6 * two_way_width(cut)));
      CHECK(two_way_integral(cut, to, from) == -part);
      parts += part;
    }
    CHECK(parts == Approx(two_way_width(cut)).epsilon(1e-12));
  }
}

TEST_CASE("the far tail of the Gaussian integral keeps its digits", "[beam_pattern]") {
  // 1 deg wide from 8 deg on with a beam of 1 deg: erf(x) is 1 to the last bit there.
  const BeamCut cut = cut_of(BeamCut::Shape::gaussian, 1.0, 20.0);
  const double tail = two_way_integral(cut, radians(3.0), radians(4.0));
  CHECK(tail > 0.0);
  CHECK(tail == Approx(summed(cut, radians(3.0), radians(4.0), 20000)).epsilon(1e-6));
  CHECK(two_way_integral(cut, radians(-4.0), radians(-3.0)) == tail);
}

TEST_CASE("the two-way integral of a wide sinc beam is 2/3 over its null number per radian",
          "[beam_pattern]") {
  // The integral of (sin(pi u)/(pi u))^4 over all u is 2/3 (Gradshteyn and Ryzhik 3.821); here
  // u = k sin x, and sin x = x to 1e-5 over a beam of 0.8 deg.
  const BeamCut cut = cut_of(BeamCut::Shape::sinc_squared, 0.8, 90.0);
  const double k = 1.391557378251510 / kPi / std::sin(radians(0.4));
  CHECK(two_way_width(cut) == Approx(2.0 / 3.0 / k).epsilon(1e-4));
}

TEST_CASE("the fast table is within 1.4e-6 of the two-way gain, and 2e-4 dB above -60 dB",
          "[beam_pattern]") {
  const BeamCut cuts[] = {cut_of(BeamCut::Shape::gaussian, 0.8, 1.25),
                          cut_of(BeamCut::Shape::gaussian, 10.0, 15.625),
                          cut_of(BeamCut::Shape::sinc_squared, 0.8, 20.0)};
  for (const BeamCut& cut : cuts) {
    const TwoWayTable table(cut);
    double worst = 0.0, worst_dB = 0.0;
    for (int i = -30000; i <= 30000; ++i) {
      const double offset = cut.cut_rad * (i / 30000.0);
      const double exact = two_way_gain(cut, offset);
      worst = std::max(worst, std::abs(table(offset) - exact));
      if (cut.shape == BeamCut::Shape::gaussian)
        worst_dB = std::max(worst_dB, std::abs(10.0 * std::log10(table(offset) / exact)));
    }
    CHECK(worst < 1.4e-6);
    CHECK(worst_dB < 2e-4);
    CHECK(table(0.0) == Approx(1.0).epsilon(0.0).margin(1.4e-6));
    CHECK(table(cut.cut_rad) == Approx(two_way_gain(cut, cut.cut_rad)).epsilon(1e-12));
    CHECK(table(-cut.cut_rad) == Approx(two_way_gain(cut, -cut.cut_rad)).epsilon(1e-12));
    CHECK(table(1.0001 * cut.cut_rad) == 0.0);
    CHECK(table(-1.0001 * cut.cut_rad) == 0.0);
    CHECK(table(std::nan("")) == 0.0);
    CHECK(table(kInfinity) == 0.0);
  }
}
