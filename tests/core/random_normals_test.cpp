// Normal numbers by the group: those of the formula, in any piece, and as normal as they should be.
#include "core/random_normals.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/constants.h"

using namespace fanbeam::core;

namespace {

constexpr RandomKey kKey{20, kStreamReceiverNoise, 4};
constexpr int kGroup = 64;

std::vector<float> numbers(std::uint64_t first, std::size_t count, const RandomKey& key = kKey) {
  std::vector<float> result(count);
  normal_numbers(key, 0, first, count, result.data());
  return result;
}

// Number n by the formula of the header, in double.
double exact(std::uint64_t n, const RandomKey& key = kKey) {
  const std::uint64_t in_group = n % kGroup;
  const auto words = random_words(key, 16 * (n / kGroup) + in_group % 16, 0);
  const std::size_t pair = in_group < 32 ? 0 : 2;
  const double u = ((words[pair] >> 1U) + 0.5) * 0x1p-31;
  const double angle_rad = 2.0 * kPi * words[pair + 1] * 0x1p-32;
  return std::sqrt(-2.0 * std::log(u)) *
         (in_group % 32 < 16 ? std::cos(angle_rad) : std::sin(angle_rad));
}

double normal_below(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

}  // namespace

TEST_CASE("Normal numbers by the group are those of Box and Muller", "[random]") {
  // Beyond 2^32 cells too.
  for (const std::uint64_t first : {std::uint64_t{0}, std::uint64_t{1} << 40U}) {
    const auto drawn = numbers(first, 1 << 18);
    double largest = 0.0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const double wanted = exact(first + i);
      const double other = exact(first + (i ^ 16U));  // of the same pair
      const double tolerance = std::hypot(wanted, other) > 0.05 ? 2e-6 : 3e-4;
      largest = std::max(largest, std::abs(static_cast<double>(drawn[i]) - wanted) / tolerance);
    }
    CHECK(largest < 1.0);
  }
}

TEST_CASE("Numbers by the group of frames 2^32 apart differ, each those of its own frame",
          "[random]") {
  RandomKey late = kKey;
  late.frame += std::uint64_t{1} << 32U;
  const auto drawn = numbers(0, kGroup, late);
  CHECK(drawn != numbers(0, kGroup));
  for (std::size_t i = 0; i < drawn.size(); ++i)
    CHECK(static_cast<double>(drawn[i]) == Approx(exact(i, late)).epsilon(0.0).margin(3e-4));
}

TEST_CASE("A number does not depend on the piece that it is drawn in", "[random]") {
  const auto all = numbers(0, 1000);
  for (const std::size_t first : {0U, 1U, 63U, 64U, 65U, 130U})
    for (const std::size_t count : {0U, 1U, 2U, 63U, 64U, 65U, 128U, 700U}) {
      const auto piece = numbers(first, count);
      CHECK(std::equal(piece.begin(), piece.end(), all.begin() + static_cast<long>(first)));
    }
  RandomKey other = kKey;
  other.frame = 5;
  CHECK(numbers(0, 64, other) != numbers(0, 64));
  std::vector<float> drawn(64);
  normal_numbers(kKey, 1, 0, 64, drawn.data());
  CHECK(drawn != numbers(0, 64));
}

TEST_CASE("Numbers by the group have the moments and the distribution of a normal one",
          "[random]") {
  constexpr std::size_t kCount = 1 << 22;
  auto drawn = numbers(0, kCount);
  double moments[5] = {};
  for (const float one : drawn) {
    double power = 1.0;
    for (double& moment : moments) {
      moment += power / kCount;
      power *= static_cast<double>(one);
    }
  }
  // Four standard deviations: variances of x, x^2, x^3, x^4 are 1, 2, 15, 96.
  const double root = std::sqrt(static_cast<double>(kCount));
  CHECK(std::abs(moments[1]) < 4.0 / root);
  CHECK(std::abs(moments[2] - 1.0) < 4.0 * std::sqrt(2.0) / root);
  CHECK(std::abs(moments[3]) < 4.0 * std::sqrt(15.0) / root);
  CHECK(std::abs(moments[4] - 3.0) < 4.0 * std::sqrt(96.0) / root);
  // Kolmogorov-Smirnov: sqrt(n) D exceeds 1.95 in one case of 1000.
  std::sort(drawn.begin(), drawn.end());
  double furthest = 0.0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const double below = normal_below(static_cast<double>(drawn[i]));
    furthest = std::max({furthest, below - static_cast<double>(i) / kCount,
                         static_cast<double>(i + 1) / kCount - below});
  }
  CHECK(furthest * root < 1.95);
  // Beyond 3 and 4.5 on either side: four standard deviations of a count.
  for (const double limit : {3.0, 4.5}) {
    const double expected = 2.0 * kCount * normal_below(-limit);
    const auto beyond =
        static_cast<double>(std::count_if(drawn.begin(), drawn.end(), [&](float one) {
          return std::abs(static_cast<double>(one)) > limit;
        }));
    CHECK(std::abs(beyond - expected) < 4.0 * std::sqrt(expected));
  }
  CHECK(std::isfinite(drawn.front()));
  CHECK(std::isfinite(drawn.back()));
}

TEST_CASE("Tails of numbers by the group reach past 5.5 standard deviations", "[random]") {
  // 3.8e-8 of all lie out there: 5 of 2^27 expected, none in one case of 160.
  double largest = 0.0;
  for (std::uint64_t first = 0; first < (std::uint64_t{1} << 27U); first += 1 << 20)
    for (const float one : numbers(first, 1 << 20))
      largest = std::max(largest, std::abs(static_cast<double>(one)));
  CHECK(largest > 5.5);
  CHECK(largest < 6.7);
}

TEST_CASE("Neighbouring numbers, both of a pair and their squares are uncorrelated", "[random]") {
  constexpr std::size_t kCount = 1 << 20;
  const auto drawn = numbers(0, kCount + kGroup);
  const double allowed = 4.0 / std::sqrt(static_cast<double>(kCount));
  // 16 apart are the two of a pair, 32 apart two pairs of a block, 64 apart neighbouring groups.
  for (const std::size_t apart : {1U, 2U, 8U, 15U, 16U, 17U, 32U, 48U, 64U}) {
    double products = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < kCount; ++i) {
      const auto a = static_cast<double>(drawn[i]), b = static_cast<double>(drawn[i + apart]);
      products += a * b / kCount;
      squares += (a * a - 1.0) * (b * b - 1.0) / (2.0 * kCount);
    }
    INFO(apart);
    CHECK(std::abs(products) < allowed);
    CHECK(std::abs(squares) < allowed);
  }
}
