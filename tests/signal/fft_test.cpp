// G03, G04: the Fourier transform against direct sums, and weak tones beside strong ones.
#include "signal/fourier/fft.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <thread>

#include "core/errors.h"
#include "signal/fourier/window.h"
#include "tests/signal/test_tones.h"

using namespace fanbeam;
using namespace fanbeam::signal;
using core::kPi;

namespace {

template <typename Real>
using ValuesOf = std::vector<std::complex<Real>>;

template <typename Real>
double size(std::complex<Real> value) {
  return std::abs(std::complex<double>(value));
}

template <typename Real>
ValuesOf<Real> random_values(int count) {
  ValuesOf<Real> values;
  for (int n = 0; n < count; ++n)
    values.push_back(static_cast<std::complex<Real>>(
        tests::noise(1.0, static_cast<std::uint64_t>(n), static_cast<std::uint32_t>(count))));
  return values;
}

// In long double, phases reduced exactly.
template <typename Real>
std::vector<std::complex<long double>> direct_sum(const ValuesOf<Real>& values) {
  const auto count = static_cast<long long>(values.size());
  std::vector<std::complex<long double>> lines(values.size());
  for (long long k = 0; k < count; ++k)
    for (long long n = 0; n < count; ++n) {
      const long double turn = static_cast<long double>(k * n % count) / count;
      lines[k] += std::complex<long double>(values[n]) *
                  std::polar(1.0L, -2.0L * 3.14159265358979323846264338327950288L * turn);
    }
  return lines;
}

template <typename Real>
double relative_error(const ValuesOf<Real>& found,
                      const std::vector<std::complex<long double>>& expected) {
  long double error = 0.0L;
  long double whole = 0.0L;
  for (std::size_t k = 0; k < found.size(); ++k) {
    error += std::norm(std::complex<long double>(found[k]) - expected[k]);
    whole += std::norm(expected[k]);
  }
  return static_cast<double>(std::sqrt(error / whole));
}

template <typename Real>
void check_basics(int length, double tolerance) {
  const Fft<Real> fft({.length = length}, FftDirection::forward);
  const auto count = static_cast<std::size_t>(length);
  INFO("length " << length);

  ValuesOf<Real> impulse(count);
  impulse[0] = 1;
  fft.run(impulse.data());
  for (const auto& line : impulse) REQUIRE(size(line - std::complex<Real>(1)) <= tolerance);

  ValuesOf<Real> constant(count, 1);
  fft.run(constant.data());
  CHECK(size(constant[0] / static_cast<Real>(length) - std::complex<Real>(1)) <= tolerance);
  for (std::size_t k = 1; k < count; ++k) REQUIRE(size(constant[k]) <= tolerance * length);

  ValuesOf<Real> zeros(count);
  fft.run(zeros.data());
  for (const auto& line : zeros) REQUIRE(line == std::complex<Real>(0));

  const ValuesOf<Real> values = random_values<Real>(length);
  ValuesOf<Real> lines(count);
  fft.run(values.data(), lines.data());
  CHECK(values == random_values<Real>(length));
  if (length <= 1009) CHECK(relative_error(lines, direct_sum(values)) <= tolerance);
  double in_time = 0.0;
  double in_frequency = 0.0;
  for (const auto& v : values) in_time += std::norm(std::complex<double>(v));
  for (const auto& v : lines) in_frequency += std::norm(std::complex<double>(v));
  CHECK(std::abs(in_frequency / (length * in_time) - 1.0) <= tolerance);

  Fft<Real>({.length = length}, FftDirection::inverse).run(lines.data());
  for (std::size_t n = 0; n < count; ++n)
    REQUIRE(size(lines[n] / static_cast<Real>(length) - values[n]) <= 4 * tolerance);
}

}  // namespace

TEST_CASE("G03 impulse, constant, zeros, noise and Parseval's sum, primes included", "[fft]") {
  for (const int length : {1, 2, 3, 1000, 1009, 4096}) {
    check_basics<double>(length, 1e-12);
    check_basics<float>(length, 1e-6);
  }
}

TEST_CASE("G03 a single tone is a single line", "[fft]") {
  for (const int length : {1000, 1009, 4096}) {
    auto values = tests::tone(length, 17.0, 1.0);
    values = spectrum(std::move(values));
    for (int k = 0; k < length; ++k)
      REQUIRE(std::abs(values[static_cast<std::size_t>(k)]) / length ==
              Approx(k == 17 ? 1.0 : 0.0).margin(1e-12).epsilon(0.0));
  }
}

TEST_CASE("batches along any axis are the single transforms", "[fft]") {
  // 7 transforms of 60 values as columns, and as rows.
  const int length = 60;
  const int batches = 7;
  const auto all = random_values<float>(length * batches);
  const Fft<float> single({.length = length}, FftDirection::forward);
  for (const bool columns : {false, true}) {
    const FftLayout layout{.length = length,
                           .stride = columns ? batches : 1,
                           .batches = batches,
                           .distance = columns ? 1 : length};
    auto together = all;
    Fft<float>(layout, FftDirection::forward).run(together.data());
    for (int b = 0; b < batches; ++b) {
      ValuesOf<float> one;
      for (int n = 0; n < length; ++n)
        one.push_back(all[static_cast<std::size_t>(b * layout.distance + n * layout.stride)]);
      single.run(one.data());
      for (int k = 0; k < length; ++k)
        REQUIRE(
            std::abs(together[static_cast<std::size_t>(b * layout.distance + k * layout.stride)] -
                     one[static_cast<std::size_t>(k)]) < 2e-5F);
    }
  }
}

TEST_CASE("values that are not aligned are transformed too", "[fft]") {
  const auto values = random_values<float>(257);
  ValuesOf<float> shifted(values.begin() + 1, values.end());
  ValuesOf<float> in_place = values;
  const Fft<float> fft({.length = 256}, FftDirection::forward);
  fft.run(shifted.data());
  fft.run(in_place.data() + 1);
  for (std::size_t k = 0; k < 256; ++k) REQUIRE(std::abs(shifted[k] - in_place[k + 1]) < 1e-4F);
}

TEST_CASE("many threads that need new plans get the same spectra", "[fft]") {
  std::vector<std::vector<ValuesOf<double>>> found(4);
  std::vector<std::thread> threads;
  for (auto& mine : found)
    threads.emplace_back([&mine] {
      for (int length = 300; length < 340; ++length)
        mine.push_back(spectrum(random_values<double>(length)));
    });
  for (std::thread& thread : threads) thread.join();
  for (const auto& other : found) CHECK(other == found[0]);
}

TEST_CASE("a transform without values or batches is refused", "[fft]") {
  CHECK_THROWS_AS(Fft<float>({.length = 0}, FftDirection::forward), core::InputError);
  CHECK_THROWS_AS(Fft<double>({.length = 8, .batches = 2}, FftDirection::forward),
                  core::InputError);
  CHECK(spectrum({}).empty());
}

TEST_CASE("G04 a tone 120 dB below another is found at its level in single precision", "[fft]") {
  const int length = 4096;
  const auto weights = window_weights({.kind = WindowKind::blackman_harris}, length);
  double sum = 0.0;
  for (const double weight : weights) sum += weight;
  const auto strong = tests::tone(length, 500.0, 1.0);
  const auto weak = tests::tone(length, 1500.0, 1e-6);
  ValuesOf<float> values;
  for (int n = 0; n < length; ++n) {
    const auto i = static_cast<std::size_t>(n);
    values.push_back(static_cast<std::complex<float>>((strong[i] + weak[i]) * (weights[i] / sum)));
  }
  Fft<float>({.length = length}, FftDirection::forward).run(values.data());
  CHECK(20.0 * std::log10(size(values[500])) == Approx(0.0).margin(0.1).epsilon(0.0));
  CHECK(20.0 * std::log10(size(values[1500])) == Approx(-120.0).margin(0.1).epsilon(0.0));
  for (int k = 520; k < 4000; ++k)
    if (std::abs(k - 1500) > 4)
      REQUIRE(20.0 * std::log10(size(values[static_cast<std::size_t>(k)])) < -126.0);
}
