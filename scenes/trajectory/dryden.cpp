#include "scenes/trajectory/dryden.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/number_range.h"
#include "core/random.h"
#include "core/units.h"

namespace fanbeam::scenes {
namespace {

using Pair = std::array<double, 2>;

constexpr double kLowest_ft = 10.0;
constexpr double kTopOfLowAltitude_ft = 1000.0;
constexpr double kBottomOfMediumAltitude_ft = 2000.0;
constexpr double kMediumAltitudeLength_ft = 1750.0;

// The two-state filter behind v and w: white noise through 1 / (1 + T s) gives a, again through the
// same gives b; sqrt(3) a + (1 - sqrt(3)) b then has the numerator 1 + sqrt(3) T s. With a of unit
// variance the steady covariance is (1, 1/2; 1/2, 1/2) and the output's variance is 2.
double across_output(const Pair& state) {
  const double root = std::sqrt(3.0);
  return (root * state[0] + (1.0 - root) * state[1]) / std::sqrt(2.0);
}

// `state` one step of `r` time constants later, with the noise that keeps it steady.
Pair across_stepped(const Pair& state, double r, const Pair& normal) {
  const double decay = std::exp(-r);
  const double decay2 = decay * decay;
  // Steady covariance less what is left of it after the step.
  const double aa = -std::expm1(-2.0 * r);
  const double ab = 0.5 * aa - r * decay2;
  const double bb = 0.5 * aa - r * decay2 - r * r * decay2;
  const double l00 = std::sqrt(aa);
  const double l10 = ab / l00;
  const double l11 = std::sqrt(std::max(0.0, bb - l10 * l10));
  return {decay * state[0] + l00 * normal[0],
          decay * (state[1] + r * state[0]) + l10 * normal[0] + l11 * normal[1]};
}

Pair across_steady(const Pair& normal) { return {normal[0], 0.5 * normal[0] + 0.5 * normal[1]}; }

}  // namespace

DrydenScales dryden_scales(double height_m, double wind_at_20ft_mps) {
  core::ProblemList problems;
  core::check_range(problems, "height_m", height_m, {-1000.0, 20000.0});
  core::check_range(problems, "wind_at_20ft_mps", wind_at_20ft_mps, {0.0, 60.0});
  problems.throw_if_errors();
  const double height_ft = std::max(height_m / core::kFoot_m, kLowest_ft);
  const double low_ft = std::min(height_ft, kTopOfLowAltitude_ft);
  const double base = 0.177 + 0.000823 * low_ft;
  double along_ft = low_ft / std::pow(base, 1.2);
  double down_ft = low_ft;
  if (height_ft > kTopOfLowAltitude_ft) {
    const double s = std::min(1.0, (height_ft - kTopOfLowAltitude_ft) /
                                       (kBottomOfMediumAltitude_ft - kTopOfLowAltitude_ft));
    along_ft = down_ft = std::lerp(kTopOfLowAltitude_ft, kMediumAltitudeLength_ft, s);
  }
  const double down_mps = 0.1 * wind_at_20ft_mps;
  const double along_mps = down_mps / std::pow(base, 0.4);
  return {core::kFoot_m * glm::dvec3{along_ft, along_ft, down_ft},
          {along_mps, along_mps, down_mps}};
}

DrydenGusts::DrydenGusts(std::uint64_t seed, double step_s) : seed_(seed), step_s_(step_s) {
  core::ProblemList problems;
  core::check_range(problems, "step_s", step_s, {1e-4, 1.0});
  problems.throw_if_errors();
}

glm::dvec3 DrydenGusts::next(const DrydenScales& scales, double airspeed_mps) {
  core::ProblemList problems;
  core::check_range(problems, "airspeed_mps", airspeed_mps, {1.0, 500.0});
  for (int axis = 0; axis < 3; ++axis) {
    core::check_range(problems, "length_m", scales.length_m[axis], {1.0, 1e4});
    core::check_range(problems, "deviation_mps", scales.deviation_mps[axis], {0.0, 100.0});
  }
  problems.throw_if_errors();
  const core::RandomKey key{seed_, core::kStreamTurbulence, 0};
  const double step_m = airspeed_mps * step_s_;
  const double normal_along = core::normal_pair(key, steps_, 0)[0];
  const double r_along = step_m / scales.length_m.x;
  if (steps_ == 0) {
    along_ = normal_along;
  } else {
    along_ = std::exp(-r_along) * along_ + std::sqrt(-std::expm1(-2.0 * r_along)) * normal_along;
  }
  for (std::uint32_t i = 0; i < 2; ++i) {
    const Pair normal = core::normal_pair(key, steps_, i + 1);
    const double r = step_m / scales.length_m[static_cast<int>(i) + 1];
    across_[i] = steps_ == 0 ? across_steady(normal) : across_stepped(across_[i], r, normal);
  }
  ++steps_;
  return scales.deviation_mps *
         glm::dvec3{along_, across_output(across_[0]), across_output(across_[1])};
}

}  // namespace fanbeam::scenes
