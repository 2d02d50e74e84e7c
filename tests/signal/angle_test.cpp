// Arrays: beamwidth, the angle's bound, motion between transmit slots, top view.
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/vec3.hpp>

#include "core/constants.h"
#include "core/errors.h"
#include "core/units.h"
#include "signal/angle/angle_peak.h"
#include "signal/angle/steering.h"
#include "signal/transform/angle_transform.h"
#include "signal/transform/slot_compensation.h"
#include "signal/transform/top_view.h"
#include "signal/waveform/array.h"
#include "tests/signal/reference_radar.h"
#include "tests/signal/slot_phase.h"
#include "tests/signal/test_tones.h"

using namespace fanbeam;
using namespace fanbeam::signal;
using core::degrees;
using core::kPi;
using core::radians;
using tests::kSlot_s;
using tests::kWavelength_m;

namespace {

Array half_wave_line(int transmitters, int receivers) {
  return line_array(transmitters, receivers, 0.5 * kWavelength_m);
}

// What an array sees of a plane wave of amplitude 1.
std::vector<std::complex<double>> plane_wave(const Array& array, double azimuth_rad,
                                             double elevation_rad = 0.0) {
  return steering_vectors(virtual_elements_m(array), kWavelength_m,
                          {{azimuth_rad}, {elevation_rad}})
      .values;
}

// Adds what motion does between the slots.
void move(std::vector<std::complex<double>>& snapshot, const Array& array, double speed_mps) {
  for (int c = 0; c < array.channels(); ++c)
    snapshot[static_cast<std::size_t>(c)] *= std::polar(
        1.0, array.transmitter_of(c) * tests::slot_phase_rad(speed_mps, kSlot_s, kWavelength_m));
}

double doppler_Hz(double speed_mps) { return 2.0 * speed_mps / kWavelength_m; }

}  // namespace

TEST_CASE("the half-power beamwidths of uniform lines are the textbook's", "[angle]") {
  // 0.8859 wavelength / (N d) rad, the sine read as the angle.
  const std::pair<int, double> kWidths[] = {{4, 25.38}, {8, 12.69}, {12, 8.460}, {16, 6.345}};
  for (const auto& row : kWidths) {
    // Elements split into 64 parts each: the limit of many elements that the figure stands for.
    const Array line = line_array(row.first, 64, 0.5 * kWavelength_m / 64.0);
    const auto broadside = plane_wave(line, 0.0);
    const auto power = [&](double sine) {
      const auto a = plane_wave(line, std::asin(sine));
      std::complex<double> sum = 0.0;
      for (std::size_t m = 0; m < a.size(); ++m) sum += broadside[m] * std::conj(a[m]);
      return std::norm(sum) / static_cast<double>(a.size() * a.size());
    };
    double low = 0.0;
    double high = 1.9 / row.first;
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (low + high);
      (power(middle) > 0.5 ? low : high) = middle;
    }
    CHECK(degrees(2.0 * low) == Approx(row.second).epsilon(3e-4));
  }
  // And a real line of 12 is as wide to a few parts in a thousand.
  const Array line = half_wave_line(1, 12);
  const auto wave = plane_wave(line, 0.0);
  const auto power = [&](double azimuth_rad) {
    const auto a = plane_wave(line, azimuth_rad);
    std::complex<double> sum = 0.0;
    for (std::size_t m = 0; m < a.size(); ++m) sum += wave[m] * std::conj(a[m]);
    return std::norm(sum) / 144.0;
  };
  CHECK(power(radians(8.460 / 2)) == Approx(0.5).epsilon(0.01));
}

TEST_CASE("beams find a wave on the side it comes from and keep its power", "[angle]") {
  const Array line = half_wave_line(3, 4);
  const std::vector<double> azimuths =
      angle_cell_azimuths_rad(64, 0.5 * kWavelength_m, kWavelength_m);
  CHECK(azimuths[32] == 0.0);
  CHECK(azimuths[48] == Approx(radians(30.0)));
  DoubleCube cube({5, 3, 12});
  const auto wave = plane_wave(line, radians(30.0));
  for (int c = 0; c < 12; ++c) cube.at(c, 1, 2) = 2.0 * wave[static_cast<std::size_t>(c)];

  DoubleCube beams;
  for (const WindowKind kind : {WindowKind::rectangular, WindowKind::hann}) {
    angle_transform(cube, {.kind = kind}, 64, beams);
    REQUIRE(beams.shape == CubeShape{5, 3, 64});
    CHECK(std::norm(beams.at(48, 1, 2)) == Approx(4.0).epsilon(1e-12));
    CHECK(std::norm(beams.at(16, 1, 2)) < 0.3);
    CHECK(beams.at(48, 0, 0) == 0.0);
  }
  // The same by sums over a grid of directions.
  angle_transform(cube, {}, 64, beams);
  DoubleCube summed;
  beam_transform(cube, virtual_elements_m(line), kWavelength_m, {azimuths}, {}, summed);
  for (int beam = 0; beam < 64; ++beam)
    REQUIRE(std::norm(summed.at(beam, 1, 2)) ==
            Approx(std::norm(beams.at(beam, 1, 2))).margin(1e-12).epsilon(0.0));
}

TEST_CASE("an array with elements at several heights tells elevations apart", "[angle]") {
  Array array = half_wave_line(1, 8);
  const double half_m = 0.5 * kWavelength_m;
  array.transmitters_m = {glm::dvec3(0.0), glm::dvec3(0.0, 0.0, half_m),
                          glm::dvec3(0.0, 0.0, 2.0 * half_m)};
  const auto wave = plane_wave(array, radians(-20.0), radians(7.0));
  const auto elements_m = virtual_elements_m(array);
  const AnglePeak peak = azimuth_peak(wave, elements_m, kWavelength_m, radians(7.0));
  CHECK(degrees(peak.azimuth_rad) == Approx(-20.0).margin(1e-5).epsilon(0.0));
  CHECK(peak.power == Approx(1.0).epsilon(1e-9));
  // Sought at elevation 0, three rows half a wavelength apart lose what is out of phase.
  const double kept = std::pow((1.0 + 2.0 * std::cos(kPi * std::sin(radians(7.0)))) / 3.0, 2);
  CHECK(azimuth_peak(wave, elements_m, kWavelength_m).power == Approx(kept).epsilon(1e-9));

  FloatCube cube({1, 1, 24});
  for (int c = 0; c < 24; ++c)
    cube.at(c, 0, 0) = static_cast<std::complex<float>>(wave[static_cast<std::size_t>(c)]);
  FloatCube beams;
  const BeamGrid grid{{radians(-20.0), 0.0}, {radians(-7.0), radians(7.0)}};
  beam_transform(cube, elements_m, kWavelength_m, grid, {}, beams);
  CHECK(std::norm(beams.at(1 * 2 + 0, 0, 0)) == Approx(1.0).epsilon(1e-5));
  CHECK(std::norm(beams.at(0 * 2 + 0, 0, 0)) < 0.9F);
}

// At half a wavelength both ends of the scan look the same: -90 deg was told of a wave from 62 deg on (two elements).
TEST_CASE("a wave far to the side is found on its side by any line at half a wavelength",
          "[angle]") {
  for (const int count : {2, 3, 4, 8, 12})
    for (double azimuth_deg = 50.0; azimuth_deg < 90.0; azimuth_deg += 1.5)
      for (const double side : {-1.0, 1.0}) {
        const Array line = half_wave_line(1, count);
        const double azimuth_rad = radians(side * azimuth_deg);
        INFO(count << " elements, " << degrees(azimuth_rad) << " deg");
        const auto elements_m = virtual_elements_m(line);
        for (const auto& peak :
             {azimuth_peak(plane_wave(line, azimuth_rad), elements_m, kWavelength_m),
              direction_peak(plane_wave(line, azimuth_rad), elements_m, kWavelength_m)}) {
          CHECK(peak.azimuth_rad == Approx(azimuth_rad).margin(1e-5).epsilon(0.0));
          CHECK(peak.power == Approx(1.0).epsilon(1e-9));
        }
      }
}

TEST_CASE("waves far to the side and far up are found there by planes at half a wavelength",
          "[angle]") {
  Array plane = half_wave_line(1, 4), column;
  plane.transmitters_m = column.receivers_m = {glm::dvec3(0.0)};
  for (int i = 1; i < 4; ++i) {
    plane.transmitters_m.emplace_back(0.0, 0.0, 0.5 * kWavelength_m * i);
    column.receivers_m.emplace_back(0.0, 0.0, 0.5 * kWavelength_m * i);
  }
  const auto found = [](const Array& array, double azimuth_rad, double elevation_rad) {
    return direction_peak(plane_wave(array, azimuth_rad, elevation_rad), virtual_elements_m(array),
                          kWavelength_m);
  };
  for (const double far_deg : {-86.0, -78.0, 76.0, 80.0, 85.0}) {
    INFO(far_deg << " deg");
    const AnglePeak beside = found(plane, radians(far_deg), radians(3.0));
    CHECK(degrees(beside.azimuth_rad) == Approx(far_deg).margin(1e-3).epsilon(0.0));
    CHECK(degrees(beside.elevation_rad) == Approx(3.0).margin(1e-3).epsilon(0.0));
    const AnglePeak above = found(column, 0.0, radians(far_deg));
    CHECK(degrees(above.elevation_rad) == Approx(far_deg).margin(1e-3).epsilon(0.0));
  }
}

TEST_CASE("elements far apart tell the direction nearest to boresight, as the cube's cells do",
          "[angle]") {
  for (const double pitch : {0.6, 1.0, 2.0}) {
    const Array line = line_array(3, 4, pitch * kWavelength_m);
    const auto elements_m = virtual_elements_m(line);
    const double most = unambiguous_sine(elements_m, kWavelength_m);
    CHECK(most == Approx(0.5 / pitch).epsilon(1e-9));
    for (int step = -49; step <= 49; ++step) {
      const double azimuth_rad = std::asin(step / 49.05 * most);  // to a thousandth of the end
      auto snapshot = plane_wave(line, azimuth_rad);
      // Of lobes alike, noise makes now this one and now that one the largest.
      for (std::size_t m = 0; m < snapshot.size(); ++m)
        snapshot[m] += tests::noise(1e-8, m + 100 * static_cast<std::uint64_t>(step + 49), 12);
      INFO(pitch << " wavelengths, " << degrees(azimuth_rad) << " deg");
      CHECK(azimuth_peak(snapshot, elements_m, kWavelength_m).azimuth_rad ==
            Approx(azimuth_rad).epsilon(0.0).margin(1e-3));
    }
    // Beyond, sines read as their rest.
    const double folded = 1.2 * most - 2.0 * most;
    if (1.2 * most < 1.0)
      CHECK(
          std::sin(azimuth_peak(plane_wave(line, std::asin(1.2 * most)), elements_m, kWavelength_m)
                       .azimuth_rad) == Approx(folded).epsilon(0.0).margin(1e-6));
  }
  CHECK(unambiguous_sine(virtual_elements_m(half_wave_line(3, 4)), kWavelength_m) == 1.0);
  CHECK(unambiguous_sine({glm::dvec3(0.0)}, kWavelength_m) == 1.0);
  // One above the other, and out of order: no uniform line across.
  CHECK(unambiguous_sine({{0.0, 0.0, 0.0}, {0.0, 0.0, 9.0}}, kWavelength_m) == 1.0);
  CHECK(unambiguous_sine({{0.0, 0.0, 0.0}, {0.0, 9.0, 0.0}, {0.0, 3.0, 0.0}}, kWavelength_m) ==
        1.0);
}

TEST_CASE("the angle of one wave reaches the Cramer-Rao bound", "[angle][statistics]") {
  const Array line = half_wave_line(3, 4);
  const auto elements_m = virtual_elements_m(line);
  const double n = 12.0;
  for (const double azimuth_deg : {0.0, 13.0, 40.0})
    for (const double snr_dB : {10.0, 20.0, 30.0}) {
      const double snr = std::pow(10.0, snr_dB / 10.0);
      const double azimuth_rad = radians(azimuth_deg);
      const double bound_deg =
          degrees(std::sqrt(6.0 / (snr * n * (n * n - 1.0))) / (kPi * std::cos(azimuth_rad)));
      constexpr int kTrials = 3000;
      double squares = 0.0;
      for (int trial = 0; trial < kTrials; ++trial) {
        auto snapshot = plane_wave(line, azimuth_rad);
        for (std::size_t m = 0; m < snapshot.size(); ++m)
          snapshot[m] += tests::noise(1.0 / snr, m + 100 * static_cast<std::uint64_t>(trial), 11);
        const double error_deg =
            degrees(azimuth_peak(snapshot, elements_m, kWavelength_m).azimuth_rad) - azimuth_deg;
        squares += error_deg * error_deg;
      }
      INFO(azimuth_deg << " deg, " << snr_dB << " dB, bound " << bound_deg);
      const double ratio = std::sqrt(squares / kTrials) / bound_deg;
      CHECK(ratio < 1.10);
      // 3 sigma of an RMSE over 3000 trials is 4 %: below the bound it would be the bound that is
      // wrong.
      CHECK(ratio > 0.95);
    }
}

TEST_CASE("motion between slots moves the angle when it is left in, and not when it is taken off",
          "[angle][slots]") {
  const Array line = half_wave_line(3, 4);
  const auto elements_m = virtual_elements_m(line);
  // 2.91 and 8.10 deg if the phase grew evenly over the 12 elements. It grows in three steps of
  // four elements, whose best straight line has 0.895 of that slope: cov / var = (8/3) / (143/12)
  // per element instead of 1/4.
  const double kStaircase = (8.0 / 3.0) / (143.0 / 12.0) / 0.25;
  const std::pair<double, double> kShifts[] = {{10.0, 2.91}, {100.0 / 3.6, 8.10}};
  for (const auto& row : kShifts) {
    auto snapshot = plane_wave(line, 0.0);
    move(snapshot, line, row.first);
    const double raw_deg = degrees(azimuth_peak(snapshot, elements_m, kWavelength_m).azimuth_rad);
    CHECK(std::abs(raw_deg) == Approx(kStaircase * row.second).epsilon(0.01));
    compensate_slots(snapshot, line, doppler_Hz(row.first), kSlot_s);
    const double left_deg = degrees(azimuth_peak(snapshot, elements_m, kWavelength_m).azimuth_rad);
    CHECK(std::abs(left_deg) < 0.02);
  }
}

// Up to +-49.3 m/s at slots of 20 us. Of an even number of slots half a turn either way is one phase: the fold that was tried
// led a car that recedes at 30 m/s to -69.
TEST_CASE("the fold of a Doppler beyond its limit is told by the array", "[angle][slots]") {
  for (const int slots : {2, 3, 4}) {
    CAPTURE(slots);
    const Array line = half_wave_line(slots, 4);
    const double limit_Hz = 1.0 / (slots * kSlot_s);
    int wrong = 0;
    for (int trial = 0; trial < 200; ++trial) {
      const double speed_mps = -48.0 + 0.48 * trial;
      auto snapshot = plane_wave(line, radians(-60.0 + 0.6 * trial));
      move(snapshot, line, speed_mps);
      for (std::size_t m = 0; m < snapshot.size(); ++m)
        snapshot[m] += tests::noise(0.05, m + 100 * static_cast<std::uint64_t>(trial), 12);
      const double folded_Hz = std::remainder(doppler_Hz(speed_mps), limit_Hz);
      const DopplerFold found = doppler_fold(snapshot, line, folded_Hz, kSlot_s, kWavelength_m);
      const double found_mps = 0.5 * kWavelength_m * (folded_Hz + found.fold * limit_Hz);
      if (std::abs(found_mps - speed_mps) > 1e-6) ++wrong;
      // The direction is that of the snapshot under the fold found.
      compensate_slots(snapshot, line, folded_Hz + found.fold * limit_Hz, kSlot_s);
      REQUIRE(azimuth_peak(snapshot, virtual_elements_m(line), kWavelength_m).azimuth_rad ==
              Approx(found.direction.azimuth_rad).margin(1e-9).epsilon(0.0));
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("compensation of a whole cube leaves half a Doppler cell's phase at most",
          "[angle][slots]") {
  const Array line = half_wave_line(3, 4);
  DoubleCube cube({2, 256, 12});
  for (auto& value : cube.values) value = 1.0;
  compensate_slots(cube, line);
  for (int c = 0; c < 12; ++c) CHECK(cube.at(c, 128, 0) == 1.0);
  // A scatterer in the centre of cell 200: 72 / 256 of a turn over three slots.
  for (int t = 0; t < 3; ++t)
    CHECK(std::abs(cube.at(4 * t, 200, 1) * std::polar(1.0, 2.0 * kPi * 72.0 / 256.0 * t / 3.0) -
                   1.0) < 1e-12);
  Array together = line;
  together.multiplex = Multiplex::simultaneous;
  DoubleCube same({2, 256, 12});
  for (auto& value : same.values) value = 1.0;
  compensate_slots(same, together);
  for (const auto& value : same.values) REQUIRE(value == 1.0);
}

TEST_CASE("the top view keeps what lies on its own cells and nothing beyond the map",
          "[top_view]") {
  // Ranges 0, 1, ... 20 m; azimuths -45 to 45 deg by 15.
  std::vector<double> azimuths;
  for (int i = -3; i <= 3; ++i) azimuths.push_back(radians(15.0 * i));
  PowerMap map(7, 21);
  map.at(3, 10) = 5.0;  // 10 m ahead
  map.at(6, 14) = 2.0;  // 14 m at 45 deg right
  const PowerMap view =
      top_view(map, azimuths, 1.0,
               {.nearest_m = 0.0, .leftmost_m = -20.0, .step_m = 1.0, .rows = 21, .columns = 41});
  CHECK(view.at(10, 20) == Approx(5.0));
  CHECK(view.at(20, 0) == 0.0);  // 28 m away
  double right = 0.0;
  double left = 0.0;
  for (int row = 0; row < 21; ++row)
    for (int column = 0; column < 41; ++column) {
      const double power = view.at(row, column);
      REQUIRE(power >= 0.0);
      REQUIRE(power <= 5.0);
      if (row < 1) CHECK((power == 0.0 || column == 20));
      if (std::abs(row - 10) <= 1 && std::abs(column - 30) <= 1) right += power;
      if (std::abs(row - 10) <= 1 && std::abs(column - 10) <= 1) left += power;
    }
  CHECK(right > 0.0);
  CHECK(left == 0.0);
  CHECK_THROWS_AS(top_view(map, {0.0}, 1.0, {.rows = 1, .columns = 1}), core::InputError);
}

TEST_CASE("the top view of half a wavelength's pitch reaches to both sides", "[top_view]") {
  const std::vector<double> azimuths = angle_cell_azimuths_rad(8, 0.5, 1.0);
  PowerMap map(8, 11);
  for (double& power : map.values_W) power = 3.0;
  for (int range = 0; range <= 10; ++range) map.at(0, range) = 7.0;  // at -90 and 90 deg
  const PowerMap view =
      top_view(map, azimuths, 1.0,
               {.nearest_m = 0.0, .leftmost_m = -10.0, .step_m = 1.0, .rows = 8, .columns = 21});
  CHECK(view.at(0, 0) == Approx(7.0));
  CHECK(view.at(0, 20) == Approx(7.0));
  // Between 48.6 deg, the last cell, and 90: the naive view is black there.
  for (int column = 14; column < 20; ++column) {
    CHECK(view.at(2, column) > 3.0);
    CHECK(view.at(2, column) < 7.0);
  }
}

TEST_CASE("elements above each other tell heights and no azimuth", "[angle]") {
  Array column;
  column.receivers_m.clear();
  for (int i = 0; i < 8; ++i) column.receivers_m.emplace_back(0.0, 0.0, 0.5 * kWavelength_m * i);
  const AnglePeak peak = direction_peak(plane_wave(column, radians(20.0), radians(10.0)),
                                        virtual_elements_m(column), kWavelength_m);
  CHECK(peak.azimuth_rad == 0.0);
  CHECK(peak.elevation_rad == Approx(radians(10.0)).epsilon(0.0).margin(1e-6));
  CHECK(peak.power == Approx(1.0));
}

// Of a pitch below half a wavelength several cells lie beyond end-fire; at half a wavelength rounding decides whether the
// first one is at -90 deg to the last bit.
TEST_CASE("the top view of any pitch up to half a wavelength reaches to both sides", "[top_view]") {
  for (const double pitch : {0.2, 0.45, 0.5 * (1.0 - 1e-15), 0.5 * (1.0 + 1e-15)}) {
    CAPTURE(pitch);
    const std::vector<double> azimuths = angle_cell_azimuths_rad(64, pitch, 1.0);
    PowerMap map(64, 11);
    for (int row = 0; row < 64; ++row)
      for (int range = 0; range <= 10; ++range)
        map.at(row, range) = std::abs(azimuths[static_cast<std::size_t>(row)]);
    const PowerMap view =
        top_view(map, azimuths, 1.0,
                 {.nearest_m = 0.0, .leftmost_m = -10.0, .step_m = 1.0, .rows = 8, .columns = 21});
    for (const int column : {0, 4, 16, 20})
      CHECK(view.at(0, column) == Approx(0.5 * kPi).epsilon(0.0).margin(1e-6));
    CHECK(view.at(1, 5) == Approx(std::atan(5.0)).epsilon(0.0).margin(0.02));
    CHECK(view.at(1, 15) == Approx(std::atan(5.0)).epsilon(0.0).margin(0.02));
  }
}

TEST_CASE("arrays, snapshots and grids that do not fit are refused", "[angle]") {
  const Array line = half_wave_line(1, 4);
  const auto elements_m = virtual_elements_m(line);
  CHECK_THROWS_AS(azimuth_peak({1.0, 1.0}, elements_m, kWavelength_m), core::InputError);
  CHECK_THROWS_AS(azimuth_peak({1.0, 1.0, std::nan(""), 1.0}, elements_m, kWavelength_m),
                  core::InputError);
  CHECK_THROWS_AS(steering_vectors(elements_m, 0.0, {{0.0}}), core::InputError);
  CHECK_THROWS_AS(steering_vectors(elements_m, kWavelength_m, {}), core::InputError);
  FloatCube cube({1, 1, 3});
  FloatCube result;
  CHECK_THROWS_AS(angle_transform(cube, {}, 2, result), core::InputError);
  CHECK_THROWS_AS(beam_transform(cube, elements_m, kWavelength_m, {{0.0}}, {}, result),
                  core::InputError);
  CHECK_THROWS_AS(compensate_slots(cube, line), core::InputError);
  CHECK_THROWS_AS(angle_cell_azimuths_rad(0, 1.0, 1.0), core::InputError);
}
