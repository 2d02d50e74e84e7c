// Hard case M05 and the laws of speckle and targets, by large samples.
#include <catch2/catch.hpp>
#include <limits>
#include <set>

#include "core/random.h"
#include "renderer/stages/fluctuation.h"
#include "sensors/receiver/detection.h"
#include "tests/renderer/statistics.h"

using namespace fanbeam;
using core::Swerling;
using renderer::Fluctuation;
using renderer::TargetShare;

namespace {

constexpr std::size_t kDraws = 1'000'000;

Fluctuation looks(int count, std::uint32_t frame = 0) { return {true, true, count, 2026, frame}; }

std::vector<double> speckle(const Fluctuation& fluctuation, std::size_t count) {
  std::vector<double> values(count);
  renderer::speckle_factors(fluctuation, core::kStreamSpeckle, 0, values);
  return values;
}

double gamma_survival(int order, double mean_one) {
  return boost::math::gamma_q(order, order * mean_one);
}

// A picture of `count` cells with one target of mean power `signal` in each, `noise` in all.
std::vector<double> target_cells(Swerling target_case, const Fluctuation& fluctuation,
                                 double signal, double noise, std::size_t count) {
  constexpr std::uint32_t kColumns = 1000;
  std::vector<TargetShare> shares;
  for (std::size_t cell = 0; cell < count; ++cell)
    shares.push_back({static_cast<std::uint32_t>(cell), static_cast<std::uint32_t>(cell) % kColumns,
                      cell, signal});
  const std::vector<Swerling> cases(count, target_case);
  std::vector<double> picture(count, 0.0);
  renderer::realise(shares, cases, fluctuation, core::kStreamSpeckle, noise, kColumns, picture);
  return picture;
}

}  // namespace

TEST_CASE("M05 single-look speckle is exponential, finite and without a pattern",
          "[M05][statistics]") {
  CHECK(-std::log(core::uniform_from(0)) <= 22.8739);
  CHECK(-std::log(core::uniform_from(0)) > 22.87);
  CHECK(-std::log(core::uniform_from(std::numeric_limits<std::uint32_t>::max())) > 0.0);

  const std::vector<double> values = speckle(looks(1), kDraws);
  CHECK(*std::min_element(values.begin(), values.end()) >= 0.0);
  CHECK(*std::max_element(values.begin(), values.end()) <= 22.8739);
  const tests::Moments law = tests::moments(values);
  CHECK(law.mean == Approx(1.0).epsilon(0.0).margin(0.004));
  CHECK(law.variance == Approx(1.0).epsilon(0.0).margin(0.0115));
  CHECK(tests::chi_square_64(values, [](double x) { return std::exp(-x); }) <
        tests::chi_square_64_limit());

  // Neighbours along azimuth, along range (164 columns), two and four apart; frames; seeds.
  const std::span<const double> all(values);
  for (const std::size_t lag : {1U, 2U, 4U, 164U, 328U})
    CHECK(tests::correlation(all.first(kDraws - lag), all.subspan(lag)) ==
          Approx(0.0).epsilon(0.0).margin(0.004));
  CHECK(tests::correlation(all, speckle(looks(1, 1), kDraws)) ==
        Approx(0.0).epsilon(0.0).margin(0.004));
  Fluctuation other_seed = looks(1);
  other_seed.seed = 2027;
  CHECK(tests::correlation(all, speckle(other_seed, kDraws)) ==
        Approx(0.0).epsilon(0.0).margin(0.004));
}

TEST_CASE("M05 N looks have variance 1/N and a gamma law, on both sides of the change of method",
          "[M05][statistics]") {
  constexpr std::size_t kCount = 300'000;
  for (const int n : {2, 4, 16, 28, 29, 100, 1000}) {
    const std::vector<double> values = speckle(looks(n), kCount);
    const tests::Moments law = tests::moments(values);
    CAPTURE(n);
    // Standard errors: sqrt(1/(N n)), and sqrt(2 + 6/N) / N of the variance.
    CHECK(law.mean ==
          Approx(1.0).epsilon(0.0).margin(4.0 / std::sqrt(n * static_cast<double>(kCount))));
    CHECK(n * law.variance == Approx(1.0).epsilon(0.0).margin(
                                  4.0 * std::sqrt((2.0 + 6.0 / n) / static_cast<double>(kCount))));
    if (n <= 100)
      CHECK(tests::chi_square_64(values, [n](double x) { return gamma_survival(n, x); }) <
            tests::chi_square_64_limit());
  }
}

TEST_CASE("A steady target in clutter has Rice's law", "[statistics]") {
  for (const int n : {1, 4})
    for (const double signal : {0.5, 4.0, 100.0}) {
      constexpr double kClutter = 2.0;
      const std::vector<double> values =
          target_cells(Swerling::steady, looks(n), signal, kClutter, 200'000);
      const tests::Moments law = tests::moments(values);
      const double variance = (kClutter * kClutter + 2.0 * signal * kClutter) / n;
      CAPTURE(n, signal);
      CHECK(law.mean ==
            Approx(signal + kClutter).epsilon(0.0).margin(4.0 * std::sqrt(variance / 200'000)));
      CHECK(law.variance == Approx(variance).epsilon(0.03));
      for (const double probability : {0.9, 0.5, 0.1, 0.01}) {
        // The power that is exceeded with this probability, from Marcum's function.
        double low = 0.0, high = 1e4;
        for (int i = 0; i < 60; ++i) {
          const double t = 0.5 * (low + high);
          (sensors::detection_probability(Swerling::steady, signal / kClutter, n, t) > probability
               ? low
               : high) = t;
        }
        const auto above = std::count_if(values.begin(), values.end(),
                                         [&](double value) { return value * n / kClutter > low; });
        CHECK(
            static_cast<double>(above) / 200'000 ==
            Approx(probability).epsilon(0.0).margin(tests::binomial_margin(probability, 200'000)));
      }
    }
}

TEST_CASE("Swerling cases: chi-square of 2 and 4 degrees, one draw a frame or one a look",
          "[statistics]") {
  constexpr std::uint32_t kCount = 300'000;
  for (const auto& [target_case, order, each_look] :
       {std::tuple{Swerling::case1, 1, false}, std::tuple{Swerling::case2, 1, true},
        std::tuple{Swerling::case3, 2, false}, std::tuple{Swerling::case4, 2, true}}) {
    std::vector<double> over_targets, over_frames, over_columns, over_looks;
    for (std::uint32_t i = 0; i < kCount; ++i) {
      over_targets.push_back(renderer::target_factor(target_case, looks(4), i, 7, 2));
      over_frames.push_back(renderer::target_factor(target_case, looks(4, i), 3, 7, 2));
      over_columns.push_back(renderer::target_factor(target_case, looks(4), 3, i, 2));
      over_looks.push_back(renderer::target_factor(target_case, looks(4), 3, 7, i));
    }
    CAPTURE(static_cast<int>(target_case));
    std::vector<const std::vector<double>*> independent{&over_targets, &over_frames};
    if (each_look) {
      independent.insert(independent.end(), {&over_columns, &over_looks});
    } else {
      CHECK(std::set<double>(over_columns.begin(), over_columns.end()).size() == 1);
      CHECK(std::set<double>(over_looks.begin(), over_looks.end()).size() == 1);
    }
    for (const std::vector<double>* values : independent) {
      const tests::Moments law = tests::moments(*values);
      CHECK(law.mean == Approx(1.0).epsilon(0.0).margin(0.0075));
      CHECK(order * law.variance == Approx(1.0).epsilon(0.0).margin(0.021));
      CHECK(tests::chi_square_64(*values, [n = order](double x) { return gamma_survival(n, x); }) <
            tests::chi_square_64_limit());
    }
  }
  CHECK(renderer::target_factor(Swerling::steady, looks(4), 3, 7, 2) == 1.0);
}

TEST_CASE("Looks average out the cases that are drawn anew, and leave the others", "[statistics]") {
  constexpr std::size_t kCount = 100'000;
  for (const auto& [target_case, variance] :
       {std::pair{Swerling::steady, 0.0}, std::pair{Swerling::case1, 1.0},
        std::pair{Swerling::case2, 1.0 / 8}, std::pair{Swerling::case3, 0.5},
        std::pair{Swerling::case4, 0.5 / 8}}) {
    // No noise: what is left is the target's power.
    const tests::Moments law =
        tests::moments(target_cells(target_case, looks(8), 3.0, 0.0, kCount));
    CAPTURE(static_cast<int>(target_case));
    CHECK(law.mean == Approx(3.0).epsilon(0.013));
    CHECK(law.variance / 9.0 == Approx(variance).epsilon(0.04).margin(1e-12));
  }
}

TEST_CASE("Two steady targets in one cell interfere with a phase of chance", "[statistics]") {
  constexpr std::uint32_t kCount = 200'000;
  std::vector<TargetShare> shares;
  for (std::uint32_t cell = 0; cell < kCount; ++cell)
    for (const std::uint32_t target : {0U, 1U}) shares.push_back({target, cell, cell, 1.0});
  const std::vector<Swerling> cases(2, Swerling::steady);
  std::vector<double> picture(kCount, 0.0);
  renderer::realise(shares, cases, looks(1), core::kStreamSpeckle, 0.0, kCount, picture);
  const tests::Moments law = tests::moments(picture);
  CHECK(law.mean ==
        Approx(2.0).epsilon(0.0).margin(4.0 * std::sqrt(2.0 / kCount)));  // |1 + e^i phi|^2
  CHECK(law.variance == Approx(2.0).epsilon(0.0).margin(0.01));
  CHECK(*std::max_element(picture.begin(), picture.end()) <= 4.0 + 1e-12);
  CHECK(*std::min_element(picture.begin(), picture.end()) < 1e-6);
}
