// Phase noise: density, range correlation and common draws, against closed forms.
#include "signal/receiver/oscillator.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/constants.h"
#include "core/errors.h"
#include "tests/signal/reference_radar.h"

using namespace fanbeam;
using namespace fanbeam::signal;
using core::kPi;
using tests::kRate_Hz;

namespace {

FloatCube ones(int samples, int chirps) {
  FloatCube cube({samples, chirps, 1});
  for (auto& value : cube.values) value = 1.0F;
  return cube;
}

double phase_variance(const FloatCube& cube) {
  double sum = 0.0;
  for (const auto& value : cube.values) sum += std::pow(std::arg(value), 2);
  return sum / static_cast<double>(cube.values.size());
}

}  // namespace

TEST_CASE("The variance of a Lorentzian line after a delay is 2 pi D tau", "[receiver]") {
  // The band ends at 10 MHz: of the integral of sin^2(x) / x^2 the part beyond is 1 / (2 x).
  const double delay_s = 1e-6, width_Hz = 1e3;
  const double missing = 1.0 / (kPi * kPi * delay_s * 0.5 * kRate_Hz);
  // Below half the first offset the difference has the density 2 pi D tau^2.
  const double below = delay_s * kRate_Hz / (8.0 * 400);
  const double expected = 2.0 * kPi * width_Hz * delay_s * (1.0 - missing - below);
  const ResidualPhase residual = residual_phase(lorentzian(width_Hz), delay_s, kRate_Hz, 400);
  CHECK(residual.rms_rad * residual.rms_rad == Approx(expected).epsilon(2e-3));
  FloatCube cube = ones(400, 2000);
  apply_oscillator(lorentzian(width_Hz), delay_s, kRate_Hz, {3, 0, 0}, {}, cube);
  CHECK(phase_variance(cube) == Approx(expected).epsilon(0.03));
  double power = 0.0;
  for (const auto& value : cube.values) power += static_cast<double>(std::norm(value));
  CHECK(power / static_cast<double>(cube.values.size()) == Approx(1.0).epsilon(1e-6));
}

TEST_CASE("Near echoes keep 4 sin^2 (pi f tau) of a table's density", "[receiver]") {
  // White, -100 dBc/Hz: variance 2 fs / 2 x 1e-10 x (2 - 2 sinc(fs tau)) over the whole band.
  const PhaseNoiseTable white{{1e3, 1e7}, {-100.0, -100.0}};
  for (const double delay_s : {2e-8, 1e-7, 6.7e-7}) {
    FloatCube cube = ones(256, 2000);
    apply_oscillator(white, delay_s, kRate_Hz, {4, 0, 0}, {}, cube);
    const double turns = kPi * kRate_Hz * delay_s;
    const double expected = kRate_Hz * 1e-10 * (2.0 - 2.0 * std::sin(turns) / turns);
    INFO(delay_s);
    CHECK(phase_variance(cube) == Approx(expected).epsilon(0.02));
  }
  // No delay, no residue.
  FloatCube cube = ones(64, 4);
  apply_oscillator(white, 0.0, kRate_Hz, {4, 0, 0}, {}, cube);
  CHECK(phase_variance(cube) == 0.0);
}

TEST_CASE(
    "Transmitters that take turns have phase noise of their own, receivers of one chirp the same",
    "[receiver]") {
  Array array = line_array(2, 2, 0.002);
  FloatCube cube({64, 400, 4});
  std::fill(cube.values.begin(), cube.values.end(), 1.0F);
  const auto turned = [&](Multiplex multiplex) {
    array.multiplex = multiplex;
    FloatCube result = cube;
    apply_oscillator(lorentzian(1e4), 1e-6, kRate_Hz, {5, 0, 0}, array, result);
    return result;
  };
  const auto together = [](const FloatCube& one, int a, int b) {
    double sum = 0.0, squares = 0.0;
    for (int m = 0; m < 400; ++m)
      for (int n = 0; n < 64; ++n) {
        const double x = std::arg(one.at(a, m, n)), y = std::arg(one.at(b, m, n));
        sum += x * y;
        squares += 0.5 * (x * x + y * y);
      }
    return sum / squares;
  };
  const FloatCube in_turn = turned(Multiplex::time_division);
  CHECK(together(in_turn, 0, 1) == Approx(1.0));
  CHECK(std::abs(together(in_turn, 0, 2)) < 0.1);
  CHECK(together(turned(Multiplex::simultaneous), 0, 2) == Approx(1.0));
}

TEST_CASE("Tables are straight over the logarithm of the offset", "[receiver]") {
  const PhaseNoiseTable table{{1e4, 1e6}, {-80.0, -120.0}};
  CHECK(10.0 * std::log10(phase_density_rad2_per_Hz(table, 1e5)) == Approx(-100.0));
  CHECK(10.0 * std::log10(phase_density_rad2_per_Hz(table, 1.0)) == Approx(-80.0));
  CHECK(10.0 * std::log10(phase_density_rad2_per_Hz(table, 1e9)) == Approx(-120.0));
  CHECK_THROWS_AS(check({{1e4, 1e4}, {-80.0, -80.0}}), core::InputError);
  CHECK_THROWS_AS(check({{1e4}, {-80.0, -80.0}}), core::InputError);
  CHECK_THROWS_AS(check(PhaseNoiseTable{{}, {}}), core::InputError);
  CHECK_THROWS_AS(check(PhaseNoiseTable{{1e4}, {std::nan("")}}), core::InputError);
}

TEST_CASE("Echoes share a delay only where there are many, and then a near one", "[receiver]") {
  std::vector<double> few{3e-7, 1e-7, 3e-7};
  auto groups = delay_groups(few);
  REQUIRE(groups.size() == 2);
  CHECK(groups[0].members == std::vector<std::size_t>{1});
  CHECK(groups[0].delay_s == 1e-7);
  CHECK(groups[1].members == std::vector<std::size_t>{0, 2});
  std::vector<double> many;
  for (int i = 0; i < 10'000; ++i) many.push_back(1e-8 + 1e-10 * i);
  groups = delay_groups(many);
  CHECK(groups.size() <= 33);
  std::size_t members = 0;
  for (const DelayGroup& group : groups)
    for (const std::size_t i : group.members) {
      ++members;
      CHECK(std::abs(std::log(group.delay_s / many[i])) < 0.5 * std::log(101.0) / 32 + 1e-9);
    }
  CHECK(members == many.size());
  CHECK(delay_groups({}).empty());
}
