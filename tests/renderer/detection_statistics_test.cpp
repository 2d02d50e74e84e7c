// Threshold detection measured on realised noise and targets, against its formulas.
#include <catch2/catch.hpp>

#include "core/random.h"
#include "renderer/stages/fluctuation.h"
#include "sensors/receiver/detection.h"
#include "tests/renderer/statistics.h"

using namespace fanbeam;
using core::Swerling;

namespace {

constexpr int kPictureColumns = 1000;

double share_above(const std::vector<double>& picture, double threshold) {
  const auto above = std::count_if(picture.begin(), picture.end(),
                                   [&](double power) { return power > threshold; });
  return static_cast<double>(above) / static_cast<double>(picture.size());
}

}  // namespace

TEST_CASE("The false-alarm rate of ten million cells of noise is the one asked for",
          "[detection][statistics]") {
  constexpr int kFrames = 10;
  for (const int looks : {1, 4, 40})
    for (const double pfa : {1e-3, 1e-4}) {
      constexpr double kNoise_W = 4.2e-17;
      const double threshold_W = kNoise_W * sensors::detection_threshold(pfa, looks) / looks;
      double rate = 0.0;
      for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
        std::vector<double> picture(1'000'000, 0.0);
        renderer::realise({}, {}, {true, false, looks, 5, frame}, core::kStreamSpeckle, kNoise_W,
                          kPictureColumns, picture);
        rate += share_above(picture, threshold_W) / kFrames;
      }
      CAPTURE(looks, pfa);
      CHECK(rate == Approx(pfa).epsilon(0.0).margin(tests::binomial_margin(pfa, 1e7)));
    }
}

TEST_CASE("Targets are detected as often as Marcum and Swerling say", "[detection][statistics]") {
  constexpr std::uint32_t kCount = 200'000;
  for (const Swerling target :
       {Swerling::steady, Swerling::case1, Swerling::case2, Swerling::case3, Swerling::case4})
    for (const int looks : {1, 4})
      for (const double snr : {1.5, 9.0}) {
        std::vector<renderer::TargetShare> shares;
        for (std::uint32_t cell = 0; cell < kCount; ++cell)
          shares.push_back({cell, cell % kPictureColumns, cell, snr});
        const std::vector<Swerling> cases(kCount, target);
        std::vector<double> picture(kCount, 0.0);
        renderer::realise(shares, cases, {true, true, looks, 11, 0}, core::kStreamSpeckle, 1.0,
                          kPictureColumns, picture);
        const double threshold = sensors::detection_threshold(1e-3, looks);
        const double pd = sensors::detection_probability(target, snr, looks, threshold);
        CAPTURE(static_cast<int>(target), looks, snr);
        CHECK(share_above(picture, threshold / looks) ==
              Approx(pd).epsilon(0.0).margin(tests::binomial_margin(pd, kCount)));
      }
}
