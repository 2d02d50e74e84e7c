// The controller of sampling under loads that vary by chance: 20 minutes at 16 Hz, at the clock of the test.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "live/pace.h"
#include "renderer/accuracy/sampling_ladder.h"

using fanbeam::live::Pace;

namespace {

constexpr double kFramePeriod_s = 0.0625;
constexpr int kAllFrames = 20 * 60 * 16;

// Of what a frame takes: a lognormal factor, of which `slow` is shared with the frames of a second around it, and now
// and then another, or seconds that no sampling changes.
struct LoadLaw {
  std::string name;
  double sigma, slow;
  double odd_share, odd_factor, odd_s;
};

const std::vector<LoadLaw> kLoadLaws{{"hardly any", 0.05, 0.0, 0.0, 1.0, 0.0},
                                     {"some", 0.2, 0.0, 0.0, 1.0, 0.0},
                                     {"much", 0.3, 0.0, 0.0, 1.0, 0.0},
                                     {"one in 200 nearly twice as long", 0.1, 0.0, 0.005, 1.8, 0.0},
                                     {"one in 100 nearly twice as long", 0.2, 0.0, 0.01, 1.8, 0.0},
                                     {"one in 50 nearly twice as long", 0.2, 0.0, 0.02, 1.8, 0.0},
                                     {"one in 50 thrice as long", 0.1, 0.0, 0.02, 3.0, 0.0},
                                     {"one in 200 by 30 ms longer", 0.1, 0.0, 0.005, 1.0, 0.03},
                                     {"slow", 0.1, 0.1, 0.0, 1.0, 0.0}};

struct LoadNoise {
  double factor = 1.0, more_s = 0.0;
};

std::vector<LoadNoise> load_noise(const LoadLaw& law, std::uint64_t seed, int frames) {
  std::mt19937_64 bits(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> even;
  const double kept = std::exp(-1.0 / 16.0);
  double slow = 0.0;
  std::vector<LoadNoise> noise;
  for (int i = 0; i < frames; ++i) {
    slow = kept * slow + std::sqrt(1.0 - kept * kept) * law.slow * normal(bits);
    const bool odd = even(bits) < law.odd_share;
    noise.push_back({std::exp(law.sigma * normal(bits) + slow) * (odd ? law.odd_factor : 1.0),
                     odd ? law.odd_s : 0.0});
  }
  return noise;
}

bool takes_too_long(double frame_s) { return frame_s > Pace::kShare * kFramePeriod_s; }

class NoisyFlight {
 public:
  // A frame's usual time by one slice is `load_s`.
  double frame(double load_s, const LoadNoise& noise) {
    const double frame_s = time_s(load_s, step(), noise);
    pace_.after(now_s_ += std::max(kFramePeriod_s, frame_s), frame_s);
    return frame_s;
  }
  std::size_t step() const {
    return static_cast<std::size_t>(std::find(kLadder.begin(), kLadder.end(), pace_.samples()) -
                                    kLadder.begin());
  }
  // The finest of which a hundredth of such frames is late at most.
  static std::size_t best_step(double load_s, const std::vector<LoadNoise>& noise) {
    for (std::size_t step = kLadder.size(); step-- > 0;)
      if (std::count_if(noise.begin(), noise.end(), [&](const LoadNoise& one) {
            return takes_too_long(time_s(load_s, step, one));
          }) <= static_cast<std::ptrdiff_t>(noise.size() / 100))
        return step;
    return 0;
  }

 private:
  static double time_s(double load_s, std::size_t step, const LoadNoise& noise) {
    return load_s * (kLadder[step] + 0.5) / 1.5 * noise.factor + noise.more_s;
  }

  static inline const std::vector<double> kLadder =
      fanbeam::renderer::sampling_ladder(fanbeam::renderer::CasterKind::profile);
  Pace pace_{kLadder, kFramePeriod_s};
  double now_s_ = 0.0;
};

}  // namespace

TEST_CASE("Of 20 minutes a hundredth is late, with a step coarser than the best one at most",
          "[pace]") {
  for (const LoadLaw& law : kLoadLaws)
    for (const double load_s : {0.011, 0.019, 0.0275})
      for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        INFO(law.name << ", " << load_s << " s, seed " << seed);
        const std::vector<LoadNoise> noise = load_noise(law, seed, kAllFrames);
        NoisyFlight flight;
        int late = 0;
        double steps = 0.0;
        for (const LoadNoise& one : noise) {
          if (takes_too_long(flight.frame(load_s, one))) ++late;
          steps += static_cast<double>(flight.step());
        }
        CHECK(late <= kAllFrames / 100);
        // It begins with the coarsest.
        CHECK(steps / kAllFrames >
              static_cast<double>(NoisyFlight::best_step(load_s, noise)) - 1.05);
      }
}

TEST_CASE("A load that jumps is followed within a second, one that falls within half a minute",
          "[pace]") {
  constexpr int kSecond = 16;
  for (const LoadLaw& law : {kLoadLaws[0], kLoadLaws[1], kLoadLaws[4]})
    for (const double load_s : {0.009, 0.018})
      for (const double times : {2.0, 4.0})
        for (const int heavy : {3 * kSecond, 60 * kSecond})
          for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            INFO(law.name << ", " << load_s << " s, " << times << " for " << heavy << ", seed "
                          << seed);
            const std::vector<LoadNoise> noise = load_noise(law, seed, 150 * kSecond);
            NoisyFlight flight;
            auto at = noise.begin();
            const auto late_in = [&](int frames, double usual_s) {
              int late = 0;
              for (const auto end = at + frames; at < end; ++at)
                late += takes_too_long(flight.frame(usual_s, *at)) ? 1 : 0;
              return late;
            };
            late_in(50 * kSecond, load_s);
            late_in(kSecond, times * load_s);
            CHECK(late_in(kSecond, times * load_s) <= kSecond / 4);
            late_in(heavy - 2 * kSecond, times * load_s);
            late_in(30 * kSecond, load_s);
            CHECK(flight.step() + 1 >= NoisyFlight::best_step(load_s, noise));
          }
}
