#include "renderer/surfaces/bistatic_nrcs.h"

#include <algorithm>
#include <utility>

#include "core/constants.h"

namespace fanbeam::renderer {
namespace {

// Of the sums below; the share must not pass 1 by it.
constexpr double kIntegralError = 0.01;

// Steps around half of a turn about the normal, from the mirror direction on, where narrow lobes
// lie: steps are finest there.
struct Turn {
  double cosine = 0.0, width_rad = 0.0;
};

const std::array<Turn, 48>& turns() {
  static const std::array<Turn, 48> kTurns = [] {
    std::array<Turn, 48> turns;
    for (std::size_t k = 0; k < turns.size(); ++k) {
      const double part = (static_cast<double>(k) + 0.5) / static_cast<double>(turns.size());
      turns[k] = {std::cos(core::kPi * part * part),
                  2.0 * core::kPi * part / static_cast<double>(turns.size())};
    }
    return turns;
  }();
  return kTurns;
}

constexpr int kSines = 32;

double sine_out(std::size_t i) { return (static_cast<double>(i) + 0.5) / kSines; }

// n.h of every direction of the sums below.
using HalfWays = std::array<std::array<double, 48>, kSines>;

HalfWays half_ways(double sin_in) {
  HalfWays on_half;
  const double cos_in = std::sqrt(std::fmax(1.0 - sin_in * sin_in, 0.0));
  for (std::size_t i = 0; i < kSines; ++i) {
    const double sin_out = sine_out(i);
    const double cos_out = std::sqrt(1.0 - sin_out * sin_out);
    for (std::size_t k = 0; k < turns().size(); ++k) {
      // |sum of the two unit vectors out of the surface|^2 = 2 (1 + their product).
      const double product = sin_in * sin_out - cos_in * cos_out * turns()[k].cosine;
      const double length = std::sqrt(std::fmax(2.0 * (1.0 + product), 1e-30));
      on_half[i][k] = std::fmin((sin_in + sin_out) / length, 1.0);
    }
  }
  return on_half;
}

// `factor(sin_out)` is sigma_B / sin(psi_i) over gamma(n.h).
template <class Factor>
double integrated_share(const NrcsTable& gamma, const HalfWays& on_half, const Factor& factor) {
  double sum = 0.0;
  for (std::size_t i = 0; i < kSines; ++i) {
    double row = 0.0;
    for (std::size_t k = 0; k < turns().size(); ++k)
      row += gamma.sigma0_over_sine(on_half[i][k]) * turns()[k].width_rad;
    sum += factor(sine_out(i)) * row;
  }
  return 2.0 * sum / kSines / (4.0 * core::kPi);
}

// The directions that every material's tables look at: worked out once, which takes as long as one
// of them.
constexpr int kTabulated = 33;

double root_in(int i) { return std::max(static_cast<double>(i) / (kTabulated - 1), 1e-3); }

double sine_in(int i) { return std::max(static_cast<double>(i), 1.0 / 32.0) / (kTabulated - 1); }

struct Tabulated {
  std::array<HalfWays, kTabulated> by_root, by_sine;
};

const Tabulated& tabulated() {
  static const Tabulated kTabulatedWays = [] {
    Tabulated ways;
    for (int i = 0; i < kTabulated; ++i) {
      const auto to = static_cast<std::size_t>(i);
      ways.by_root[to] = half_ways(root_in(i) * root_in(i));
      ways.by_sine[to] = half_ways(sine_in(i));
    }
    return ways;
  }();
  return kTabulatedWays;
}

}  // namespace

BistaticNrcs::BistaticNrcs(NrcsTable monostatic) : monostatic_(std::move(monostatic)) {
  static_assert(kTabulated == kSteps + 1);
  if (monostatic_.largest() == 0.0) return;
  for (std::size_t i = 0; i <= kSteps; ++i)
    // sqrt(sin psi_i) times the share, so without that root in the denominator.
    rooted_share_[i] = (1.0 + kIntegralError) *
                       integrated_share(monostatic_, tabulated().by_root[i],
                                        [](double sin_out) { return std::sqrt(sin_out); });
  rooted_share_[kSteps + 1] = rooted_share_[kSteps];
  for (std::size_t i = 0; i <= kSteps; ++i)
    share_[i] = std::fmin(integrated_share(monostatic_, tabulated().by_sine[i],
                                           [&](double sin_out) {
                                             return factor(sine_in(static_cast<int>(i)), sin_out);
                                           }),
                          1.0);
  share_[kSteps + 1] = share_[kSteps];
}

}  // namespace fanbeam::renderer
