// Threshold detection against closed forms, published figures and quadrature.
#include "sensors/receiver/detection.h"

#include <boost/math/special_functions/gamma.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "core/errors.h"
#include "tests/decibel.h"

using namespace fanbeam;
using boost::math::gamma_q;
using core::Swerling;
using tests::dB;
using namespace fanbeam::sensors;

namespace {

constexpr Swerling kCases[] = {Swerling::steady, Swerling::case1, Swerling::case2, Swerling::case3,
                               Swerling::case4};

double linear(double level_dB) { return std::pow(10.0, level_dB / 10.0); }

double simpson(const std::function<double(double)>& f, double from, double to, int steps) {
  double sum = f(from) + f(to);
  const double h = (to - from) / steps;
  for (int i = 1; i < steps; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * f(from + i * h);
  return sum * h / 3.0;
}

// W. J. Albersheim, "A closed-form approximation to Robertson's detection characteristics", Proc.
// IEEE 69, 1981, stated to be within 0.2 dB for Pd 0.1 to 0.9, Pfa 1e-7 to 1e-3, linear detector.
// For one look, where all detectors are alike and Rice's density decides, it is not below Pd 0.3:
// 4 dB low at Pd 0.1, Pfa 1e-3.
double albersheim_dB(double pd, double pfa, int looks) {
  const double a = std::log(0.62 / pfa);
  const double b = std::log(pd / (1.0 - pd));
  return -5.0 * std::log10(looks) +
         (6.2 + 4.54 / std::sqrt(looks + 0.44)) * std::log10(a + 0.12 * a * b + 1.7 * b);
}

// Rice's density of the amplitude r of one look with a steady signal: 2 r exp(-(r - a)^2) times a
// scaled Bessel function, a^2 the signal-to-noise ratio.
double rice_density(double r, double a) {
  const double x = 2.0 * r * a;
  const double scaled = x < 600.0 ? std::cyl_bessel_i(0.0, x) * std::exp(-x)
                                  : (1.0 + 0.125 / x + 0.0703125 / (x * x)) /
                                        std::sqrt(2.0 * 3.14159265358979323846 * x);
  return 2.0 * r * std::exp(-(r - a) * (r - a)) * scaled;
}

// Q(n, x); the library takes the logarithm of x.
double exceeded(int n, double x) { return x > 0.0 ? gamma_q(n, x) : 1.0; }

}  // namespace

TEST_CASE("Thresholds give back their false-alarm probability", "[detection]") {
  CHECK(detection_threshold(1e-6, 1) == Approx(-std::log(1e-6)).epsilon(1e-13));
  // Abramowitz and Stegun, table 26.8: upper percentage points of chi-square, 2 n degrees.
  CHECK(detection_threshold(0.05, 5) == Approx(18.3070 / 2).epsilon(3e-6));
  CHECK(detection_threshold(0.001, 10) == Approx(45.315 / 2).epsilon(2e-5));
  CHECK(detection_threshold(0.005, 50) == Approx(140.169 / 2).epsilon(2e-5));
  for (const int looks : {1, 2, 5, 30, 1000})
    for (const double pfa : {1e-15, 1e-9, 1e-6, 1e-3, 0.1}) {
      const double threshold = detection_threshold(pfa, looks);
      CHECK(gamma_q(looks, threshold) == Approx(pfa).epsilon(1e-10));
      for (const Swerling target : kCases)
        CHECK(detection_probability(target, 0.0, looks, threshold) == Approx(pfa).epsilon(1e-10));
    }
}

TEST_CASE("Published signal-to-noise ratios for a detection", "[detection]") {
  // Skolnik, Introduction to Radar Systems, 3rd edition, 2.6: 13.2 dB for 0.9 at 1e-6.
  CHECK(dB(required_snr(Swerling::steady, 0.9, 1e-6, 1)) ==
        Approx(13.183).epsilon(0.0).margin(5e-4));
  CHECK(dB(required_snr(Swerling::steady, 0.9, 1e-4, 1)) ==
        Approx(11.749).epsilon(0.0).margin(5e-4));
  CHECK(dB(required_snr(Swerling::case1, 0.9, 1e-6, 1)) == Approx(21.14).epsilon(0.0).margin(5e-3));
  // B. R. Mahafza, MATLAB Simulations for Radar Systems Design, 2.9: 0.65 at 1e-9, ten pulses.
  CHECK(dB(required_snr(Swerling::steady, 0.65, 1e-9, 10)) ==
        Approx(5.525).epsilon(0.0).margin(0.02));
}

TEST_CASE("Albersheim's approximation: within 0.1 dB for one look, 0.3 dB for up to 1000",
          "[detection]") {
  for (const int looks : {1, 2, 5, 10, 30, 100, 1000})
    for (const double pfa : {1e-7, 1e-6, 1e-5, 1e-4, 1e-3})
      for (const double pd : {0.5, 0.6, 0.7, 0.8, 0.9}) {
        CAPTURE(looks, pfa, pd);
        CHECK(dB(required_snr(Swerling::steady, pd, pfa, looks)) ==
              Approx(albersheim_dB(pd, pfa, looks)).epsilon(0.0).margin(looks == 1 ? 0.1 : 0.3));
      }
}

TEST_CASE("One look: closed forms of the Swerling cases, quadrature of Rice's density",
          "[detection]") {
  for (const double pfa : {1e-8, 1e-6, 1e-3})
    for (const double snr : {0.1, 1.0, 20.0, 500.0}) {
      const double threshold = -std::log(pfa);
      const double exponential = std::pow(pfa, 1.0 / (1.0 + snr));
      CHECK(detection_probability(Swerling::case1, snr, 1, threshold) ==
            Approx(exponential).epsilon(0.0).margin(1e-12));
      CHECK(detection_probability(Swerling::case2, snr, 1, threshold) ==
            Approx(exponential).epsilon(0.0).margin(1e-12));
      const double two = 2.0 + snr;  // Meyer and Mayer, case 3, N = 1
      const double one_dominant =
          (1.0 + 2.0 * snr * threshold / (two * two)) * std::exp(-2.0 * threshold / two);
      CHECK(detection_probability(Swerling::case3, snr, 1, threshold) ==
            Approx(one_dominant).epsilon(0.0).margin(1e-12));
      CHECK(detection_probability(Swerling::case4, snr, 1, threshold) ==
            Approx(one_dominant).epsilon(0.0).margin(1e-12));
      const double a = std::sqrt(snr);
      const double from = std::sqrt(threshold);
      const double rice = simpson([&](double r) { return rice_density(r, a); }, from,
                                  std::max(a, from) + 9.0, 20000);
      CHECK(detection_probability(Swerling::steady, snr, 1, threshold) ==
            Approx(rice).epsilon(0.0).margin(2e-9));
    }
}

TEST_CASE("N looks: closed forms of cases 1 and 2, steady target averaged over cases 3 and 4",
          "[detection]") {
  for (const int looks : {2, 5, 40})
    for (const double snr : {0.05, 0.8, 12.0}) {
      const double t = detection_threshold(1e-6, looks);
      // Meyer and Mayer 1973; Richards, Fundamentals of Radar Signal Processing, 2nd ed., eq. 6.99.
      const double r = 1.0 + 1.0 / (looks * snr);
      const double case1 = gamma_q(looks - 1, t) + std::pow(r, looks - 1) *
                                                       (1.0 - gamma_q(looks - 1, t / r)) *
                                                       std::exp(-t / (1.0 + looks * snr));
      CAPTURE(looks, snr);
      CHECK(detection_probability(Swerling::case1, snr, looks, t) == Approx(case1).epsilon(1e-7));
      CHECK(detection_probability(Swerling::case2, snr, looks, t) ==
            Approx(gamma_q(looks, t / (1.0 + snr))).epsilon(0.0).margin(1e-12));
      // A summed power x S / m with x gamma distributed of order m.
      for (const auto& [target, order] :
           {std::pair{Swerling::case3, 2}, std::pair{Swerling::case4, 2 * looks}}) {
        const double m = order;
        const auto averaged = [&](double x) {
          const double steady = detection_probability(Swerling::steady, snr * x / m, looks, t);
          return steady * boost::math::gamma_p_derivative(m, x);
        };
        const double mean = simpson(averaged, 0.0, m + 12.0 * std::sqrt(m) + 30.0, 3000);
        CHECK(detection_probability(target, snr, looks, t) ==
              Approx(mean).epsilon(0.0).margin(1e-8));
      }
    }
}

TEST_CASE("N looks of a steady target: all its signal in one look, by quadrature", "[detection]") {
  // Only the summed signal matters, so that the other looks may hold noise alone.
  for (const int looks : {2, 10, 60})
    for (const double snr : {0.05, 0.8, 3.4}) {
      const double t = detection_threshold(1e-7, looks);
      const double a = std::sqrt(looks * snr);
      const double edge = std::sqrt(t);
      const double below =
          simpson([&](double r) { return rice_density(r, a) * exceeded(looks - 1, t - r * r); },
                  0.0, edge, 4000);
      const double above = simpson([&](double r) { return rice_density(r, a); }, edge,
                                   std::max(a, edge) + 9.0, 4000);
      CAPTURE(looks, snr);
      CHECK(detection_probability(Swerling::steady, snr, looks, t) ==
            Approx(below + above).epsilon(0.0).margin(1e-7));
    }
}

TEST_CASE("Detection rises with the signal up to certainty, for every case and many looks",
          "[detection]") {
  for (const Swerling target : kCases)
    for (const int looks : {1, 7, 1000}) {
      const double t = detection_threshold(1e-12, looks);
      double last = 0.0;
      for (double level_dB = -40.0; level_dB <= 120.0; level_dB += 2.0) {
        const double pd = detection_probability(target, linear(level_dB), looks, t);
        CHECK(pd >= last - 1e-12);
        CHECK(pd <= 1.0);
        last = pd;
      }
      CHECK(last == Approx(1.0).epsilon(0.0).margin(1e-9));
    }
}

TEST_CASE("Detection refuses impossible questions", "[detection]") {
  CHECK_THROWS_AS(detection_threshold(0.0, 1), core::InputError);
  CHECK_THROWS_AS(detection_threshold(1e-6, 0), core::InputError);
  CHECK_THROWS_AS(detection_threshold(std::nan(""), 1), core::InputError);
  CHECK_THROWS_AS(detection_probability(Swerling::case1, -1.0, 1, 10.0), core::InputError);
  CHECK_THROWS_AS(detection_probability(Swerling::case1, 1.0, 1, std::nan("")), core::InputError);
  CHECK_THROWS_AS(required_snr(Swerling::steady, 1e-7, 1e-6, 1), core::InputError);
  CHECK_THROWS_AS(required_snr(Swerling::steady, 1.0, 1e-6, 1), core::InputError);
}
