#include "scenes/trajectory/dryden.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <vector>

#include "core/constants.h"
#include "core/errors.h"
#include "core/units.h"

namespace fanbeam::scenes {
namespace {

constexpr double kAirspeed_mps = 70.0;

// Different lengths, so that exchanged axes show.
const DrydenScales kScales{{100.0, 60.0, 35.0}, {2.0, 1.5, 1.0}};

std::vector<glm::dvec3> gusts(std::uint64_t seed, double step_s, std::size_t count) {
  DrydenGusts source(seed, step_s);
  std::vector<glm::dvec3> result(count);
  for (glm::dvec3& gust : result) gust = source.next(kScales, kAirspeed_mps);
  return result;
}

// Mean of g(t) g(t + lag) over the variance asked for.
double correlation(const std::vector<glm::dvec3>& series, int axis, std::size_t lag) {
  double sum = 0.0;
  for (std::size_t i = 0; i + lag < series.size(); ++i)
    sum += series[i][axis] * series[i + lag][axis];
  const double deviation = kScales.deviation_mps[axis];
  return sum / static_cast<double>(series.size() - lag) / (deviation * deviation);
}

// MIL-F-8785C 3.7.2.2, one-sided in angular frequency.
double published_psd(int axis, double angular_rad_per_s) {
  const double time_s = kScales.length_m[axis] / kAirspeed_mps;
  const double x2 = std::pow(time_s * angular_rad_per_s, 2);
  const double scale =
      kScales.deviation_mps[axis] * kScales.deviation_mps[axis] * time_s / core::kPi;
  if (axis == 0) return 2.0 * scale / (1.0 + x2);
  return scale * (1.0 + 3.0 * x2) / ((1.0 + x2) * (1.0 + x2));
}

// Mean periodogram at one angular frequency over pieces of the series, each under a Hann window.
double measured_psd(const std::vector<glm::dvec3>& series, int axis, double step_s,
                    double angular_rad_per_s, std::size_t piece) {
  std::vector<double> window(piece);
  for (std::size_t i = 0; i < piece; ++i)
    window[i] =
        1.0 - std::cos(2.0 * core::kPi * static_cast<double>(i) / static_cast<double>(piece));
  const std::complex<double> turn = std::polar(1.0, -angular_rad_per_s * step_s);
  double sum = 0.0;
  std::size_t pieces = 0;
  for (std::size_t begin = 0; begin + piece <= series.size(); begin += piece, ++pieces) {
    std::complex<double> transform = 0.0;
    std::complex<double> phasor = 1.0;
    for (std::size_t i = 0; i < piece; ++i) {
      transform += window[i] * series[begin + i][axis] * phasor;
      phasor *= turn;
    }
    sum += std::norm(transform) * step_s / (1.5 * static_cast<double>(piece));
  }
  return sum / static_cast<double>(pieces) / core::kPi;  // two-sided in Hz -> one-sided in rad/s
}

}  // namespace

TEST_CASE("Dryden scales follow MIL-F-8785C", "[dryden]") {
  // Worked by hand from 3.7.3.4. At 1000 ft the bracket is 1: L_u = L_w = 1000 ft, equal
  // deviations.
  const DrydenScales top = dryden_scales(304.8, 15.0);
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(top.length_m[axis] == Approx(304.8).epsilon(1e-12));
    CHECK(top.deviation_mps[axis] == Approx(1.5).epsilon(1e-12));
  }
  // 100 ft: bracket 0.2593; 0.2593^1.2 = 0.197953, 0.2593^0.4 = 0.582802.
  const DrydenScales low = dryden_scales(30.48, 15.0);
  CHECK(low.length_m.z == Approx(30.48));
  CHECK(low.length_m.x == Approx(30.48 / 0.197953).epsilon(1e-5));
  CHECK(low.length_m.y == low.length_m.x);
  CHECK(low.deviation_mps.x == Approx(1.5 / 0.582802).epsilon(1e-5));
  CHECK(low.deviation_mps.z == Approx(1.5));
  CHECK(dryden_scales(2000.0 * 0.3048, 15.0).length_m.z == Approx(1750.0 * 0.3048));
  CHECK(dryden_scales(-5.0, 15.0).length_m.z == Approx(3.048));
  CHECK_THROWS_WITH(dryden_scales(100.0, -1.0), Catch::Contains("E-RANGE"));
  CHECK_THROWS_WITH(dryden_scales(std::nan(""), 1.0), Catch::Contains("E-NONFINITE"));
}

TEST_CASE("Gusts have the variance and correlation of the Dryden process at any step", "[dryden]") {
  // Longitudinal exp(-x), transverse (1 - x / 2) exp(-x), x = V t / L: the transforms of the
  // spectra. A forward-Euler filter is off by 35 % at the coarser step.
  const double step_s = GENERATE(0.02, 0.5);
  const std::size_t count = step_s == 0.02 ? 2'000'000 : 400'000;
  const std::vector<glm::dvec3> series = gusts(7, step_s, count);
  for (int axis = 0; axis < 3; ++axis) {
    const double time_s = kScales.length_m[axis] / kAirspeed_mps;
    // Independent values: one per two correlation times; four standard deviations of their mean.
    const double independent = static_cast<double>(count) * std::min(1.0, step_s / (2.0 * time_s));
    const double tolerance = 4.0 * std::sqrt(2.0 / independent);
    for (const std::size_t lag : {0, 1, 3, 20}) {
      const double x = static_cast<double>(lag) * step_s / time_s;
      const double published = (axis == 0 ? 1.0 : 1.0 - 0.5 * x) * std::exp(-x);
      CAPTURE(axis, lag, step_s);
      CHECK(correlation(series, axis, lag) == Approx(published).margin(tolerance).epsilon(0.0));
    }
  }
}

TEST_CASE("Gust spectra have the Dryden form and fall with the square of frequency", "[dryden]") {
  constexpr double kStep_s = 0.01;
  constexpr std::size_t kPiece = 8192;
  const std::vector<glm::dvec3> series = gusts(11, kStep_s, 200 * kPiece);
  // 200 pieces: 7 % standard deviation each; three of them.
  constexpr double kTolerance = 0.21;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double angular : {0.3, 1.0, 3.0, 10.0, 30.0}) {
      CAPTURE(axis, angular);
      CHECK(measured_psd(series, axis, kStep_s, angular, kPiece) ==
            Approx(published_psd(axis, angular)).epsilon(kTolerance));
    }
    const double slope = std::log(measured_psd(series, axis, kStep_s, 40.0, kPiece) /
                                  measured_psd(series, axis, kStep_s, 10.0, kPiece)) /
                         std::log(4.0);
    // Four standard deviations of the logarithm of the two values' ratio.
    CHECK(slope == Approx(-2.0).epsilon(0.0).margin(0.29));
  }
}

TEST_CASE("Gusts repeat with the seed and differ without it", "[dryden]") {
  const std::vector<glm::dvec3> first = gusts(3, 0.02, 1000);
  CHECK(first == gusts(3, 0.02, 1000));
  CHECK(first != gusts(4, 0.02, 1000));
  // The axes are independent: four standard deviations of 1e5 / 70 independent values.
  const std::vector<glm::dvec3> longer = gusts(3, 0.02, 100'000);
  double uv = 0.0;
  double vw = 0.0;
  for (const glm::dvec3& gust : longer) {
    uv += gust.x * gust.y / (2.0 * 1.5) / 1e5;
    vw += gust.y * gust.z / (1.5 * 1.0) / 1e5;
  }
  CHECK(std::abs(uv) < 0.11);
  CHECK(std::abs(vw) < 0.11);
}

TEST_CASE("Gusts refuse a step, speed or length that means nothing", "[dryden]") {
  CHECK_THROWS_WITH(DrydenGusts(1, 0.0), Catch::Contains("E-RANGE step_s"));
  DrydenGusts source(1, 0.02);
  CHECK_THROWS_WITH(source.next(kScales, 0.0), Catch::Contains("E-RANGE airspeed_mps"));
  CHECK_THROWS_WITH(source.next(DrydenScales{}, 70.0), Catch::Contains("E-RANGE length_m"));
}

}  // namespace fanbeam::scenes
