// G07: filters that must not wrap around.
#include "signal/fourier/fast_convolution.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>

#include "core/constants.h"
#include "signal/fourier/fft.h"
#include "tests/signal/test_tones.h"

using namespace fanbeam;
using namespace fanbeam::signal;

namespace {

using Values = std::vector<std::complex<double>>;

Values direct_convolution(const Values& x, const Values& h) {
  Values y(x.size() + h.size() - 1);
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t k = 0; k < h.size(); ++k) y[i + k] += x[i] * h[k];
  return y;
}

// A chirp of `count` samples.
Values chirp(int count) {
  Values pulse;
  for (int n = 0; n < count; ++n) pulse.push_back(std::polar(1.0, core::kPi * n * n / count));
  return pulse;
}

// y[k] = sum over i of x[k + i] conj(pulse[i]), as long as x.
Values compressed(const Values& x, const Values& pulse) {
  Values reversed(pulse.rbegin(), pulse.rend());
  for (auto& value : reversed) value = std::conj(value);
  const Values all = convolved(x, reversed);
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(pulse.size() - 1);
  return {first, first + static_cast<std::ptrdiff_t>(x.size())};
}

double energy(const Values& values) {
  double sum = 0.0;
  for (const auto& value : values) sum += std::norm(value);
  return sum;
}

}  // namespace

TEST_CASE("G07 convolution agrees with the direct sum at any length", "[convolution]") {
  for (const int count : {1, 2, 17, 1000}) {
    const auto x = tests::tone(count, 3.3, 1.0, 0.5, 1);
    const auto h = tests::tone(37, 5.1, 1.0, 0.5, 2);
    const auto fast = convolved(x, h);
    const auto direct = direct_convolution(x, h);
    REQUIRE(fast.size() == direct.size());
    for (std::size_t k = 0; k < fast.size(); ++k)
      REQUIRE(std::abs(fast[k] - direct[k]) < 1e-12 * 40);
  }
}

TEST_CASE("G07 the echo of the last bin leaves nothing in the first half of the range",
          "[convolution]") {
  const std::size_t count = 1024;
  const Values pulse = chirp(200);
  // The scatterer's echo is cut off by the record's end: one sample of the pulse.
  Values record(count);
  record[count - 1] = pulse[0];
  const Values range = compressed(record, pulse);
  REQUIRE(range.size() == count);
  for (std::size_t k = 0; k < count / 2; ++k) REQUIRE(std::abs(range[k]) < 1e-12);
  // Lags 0 to 199 back from the last bin, each |pulse| = 1.
  CHECK(energy(range) == Approx(200.0).epsilon(1e-12));
  CHECK(std::abs(range[count - 1]) == Approx(1.0).epsilon(1e-12));

  Values scene(count);
  scene[count - 1] = 1.0;
  const Values echo = convolved(scene, pulse);
  for (std::size_t k = 0; k < count - 1; ++k) REQUIRE(std::abs(echo[k]) < 1e-12);
  CHECK(energy(echo) == Approx(energy(direct_convolution(scene, pulse))).epsilon(1e-12));
}

TEST_CASE("a pulse is compressed into the bin where its echo begins", "[convolution]") {
  const Values pulse = chirp(64);
  Values record(500);
  for (std::size_t n = 0; n < pulse.size(); ++n) record[123 + n] = 2.0 * pulse[n];
  const Values range = compressed(record, pulse);
  CHECK(std::abs(range[123]) == Approx(128.0).epsilon(1e-12));
  for (std::size_t k = 0; k < range.size(); ++k)
    if (k != 123) REQUIRE(std::abs(range[k]) < 127.0);
}

TEST_CASE("empty inputs and transform lengths", "[convolution]") {
  CHECK(convolved({}, {1.0}).empty());
  CHECK(convolved({1.0, 2.0}, {}).empty());
  CHECK(fast_length(1) == 1);
  CHECK(fast_length(7) == 8);
  CHECK(fast_length(1009) == 1024);
}
