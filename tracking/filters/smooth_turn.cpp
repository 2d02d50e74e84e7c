#include <algorithm>
#include <array>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

#include "tracking/filters/smooth_turn_private.h"

namespace fanbeam::tracking {
namespace {

// What the means over a step have of the noise of f, b and a at its end: of f and a as a cubic's mean has (by regression
// 5/18, for steps short beside 1 / k), of b what regression gives for any step; and a cubic integrated twice.
constexpr double kSmoothWithin = 0.25, kBentWithin = 0.5, kTwiceWithin = 0.05;
// Slower than this a velocity tells little of where a car points: it is then taken to point as the radar does.
constexpr double kCrawl_mps = 0.5;
constexpr double kKnown_mps = 1.0;

// Integrals of s^n exp(-rate s) over a step, n = 0 to 4: the last is a gamma function's, the others follow from
// it downwards, in terms that are all positive.
std::array<double, 5> decaying_powers(double rate_per_s, double t) {
  using Double = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
  const double x = rate_per_s * t, decay = std::exp(-x);
  std::array<double, 5> integrals{};
  integrals[4] = 24.0 / std::pow(rate_per_s, 5) * boost::math::gamma_p(5.0, x, Double());
  for (std::size_t n = 4; n > 0; --n)
    integrals[n - 1] =
        (rate_per_s * integrals[n] + std::pow(t, n) * decay) / static_cast<double>(n);
  return integrals;
}

// The law of (f, f', f'') over a step.
struct SmoothLaw {
  Eigen::Matrix3d transition, noise;
  // What is expected from its start: the mean of f over the step, and f integrated twice.
  Eigen::RowVector3d mean, twice;
};

SmoothLaw smooth_law(double sigma, double time_s, double t) {
  const double k = 1.0 / time_s, k2 = k * k, k3 = k2 * k;
  Eigen::Matrix3d beyond_decay;
  beyond_decay << k, 1.0, 0.0, 0.0, k, 1.0, -k3, -3.0 * k2, -2.0 * k;
  SmoothLaw law;
  law.transition = std::exp(-k * t) * (Eigen::Matrix3d::Identity() + t * beyond_decay +
                                       0.5 * t * t * beyond_decay * beyond_decay);
  // f(s) = exp(-k s) ((1 + k s + k^2 s^2 / 2) f + (s + k s^2) f' + s^2 / 2 f''), and s f(s).
  const std::array<double, 5> power = decaying_powers(k, t);
  const Eigen::RowVector3d sum(power[0] + k * power[1] + 0.5 * k2 * power[2],
                               power[1] + k * power[2], 0.5 * power[2]);
  const Eigen::RowVector3d first(power[1] + k * power[2] + 0.5 * k2 * power[3],
                                 power[2] + k * power[3], 0.5 * power[3]);
  law.mean = sum / t;
  law.twice = t * sum - first;
  // Products of what a push leaves s later: exp(-k s) (s^2/2, s - k s^2/2, 1 - 2 k s + k^2 s^2/2).
  const auto [i0, i1, i2, i3, i4] = decaying_powers(2.0 * k, t);
  const double ww = 0.25 * i4, wd = 0.5 * i3 - 0.25 * k * i4;
  const double wc = 0.5 * i2 - k * i3 + 0.25 * k2 * i4, dd = i2 - k * i3 + 0.25 * k2 * i4;
  const double dc = i1 - 2.5 * k * i2 + 1.5 * k2 * i3 - 0.25 * k3 * i4;
  const double cc = i0 - 4.0 * k * i1 + 5.0 * k2 * i2 - 2.0 * k3 * i3 + 0.25 * k2 * k2 * i4;
  law.noise << ww, wd, wc, wd, dd, dc, wc, dc, cc;
  law.noise *= 16.0 / 3.0 * sigma * sigma * k2 * k3;
  return law;
}

Eigen::Matrix2d turned(double angle) {
  const double sine = std::sin(angle), cosine = std::cos(angle);
  Eigen::Matrix2d matrix;
  matrix << cosine, -sine, sine, cosine;
  return matrix;
}

// The velocity's turn integrated over a step, and that by the rate.
struct Arc {
  Eigen::Matrix2d chord, by_rate;
};

Arc arc(double rate, double t) {
  const double angle = rate * t;
  double s = t * (1.0 - angle * angle / 6.0), c = 0.5 * t * angle;
  double ds = -t * t * angle / 3.0, dc = t * t * (0.5 - angle * angle / 8.0);
  if (std::abs(angle) > 1e-4) {
    const double sine = std::sin(angle), cosine = std::cos(angle), half = std::sin(0.5 * angle);
    s = sine / rate;
    c = 2.0 * half * half / rate;
    ds = (angle * cosine - sine) / (rate * rate);
    dc = (angle * sine - 2.0 * half * half) / (rate * rate);
  }
  Arc result;
  result.chord << s, -c, c, s;
  result.by_rate << ds, -dc, dc, ds;
  return result;
}

// Where a velocity points, and what of an error of it changes that.
struct Heading {
  Eigen::Vector2d along = {1.0, 0.0};
  Eigen::Matrix2d slope = Eigen::Matrix2d::Zero();
};

Heading heading_of(const Eigen::Vector2d& velocity_mps) {
  const double speed_mps = velocity_mps.norm();
  if (speed_mps < kCrawl_mps) return {};
  const Eigen::Vector2d along = velocity_mps / speed_mps;
  return {along, (Eigen::Matrix2d::Identity() - along * along.transpose()) / speed_mps};
}

// Whether it is known where and how fast a target goes: to 1 m/s or half of its speed.
bool knows_velocity(const Eigen::Vector2d& velocity_mps, const Gaussian& state) {
  return state.variance(2, 2) + state.variance(3, 3) <
         std::max(kKnown_mps * kKnown_mps, 0.25 * velocity_mps.squaredNorm());
}

Matrix turn_noise(const MotionModel& model, double t, const Eigen::Vector4d& by_rate,
                  const Eigen::Vector4d& by_push, const SmoothLaw& steering,
                  const SmoothLaw& along) {
  Matrix into = Matrix::Zero(kTurnStates, 7), noise = Matrix::Zero(7, 7);
  into.block(0, 0, 4, 1) = kSmoothWithin * by_rate;
  into.block(0, 3, 4, 1) = kBentWithin * by_rate;
  into.block(0, 4, 4, 1) = by_push;
  into.block(kSteering, 0, 7, 7).setIdentity();
  noise.block(0, 0, 3, 3) = steering.noise;
  noise(3, 3) = model.bend_density_rad2_per_s3 * t;
  noise.block(4, 4, 3, 3) = along.noise;
  return into * noise * into.transpose();
}

}  // namespace

MotionStep turn_step(const MotionModel& model, double step_s, const Gaussian& state) {
  const double t = step_s;
  const SmoothLaw steering = smooth_law(model.steering_sigma_rad_per_s, model.steering_time_s, t);
  const SmoothLaw pushing = smooth_law(model.along_sigma_mps2, model.along_time_s, t);
  const Vector before = vector_of(state.mean, kTurnStates);
  const Eigen::Vector3d steered = before.segment(kSteering, 3), pushed = before.segment(kAlong, 3);
  const double rate = steering.mean.dot(steered) + before(kBend);
  const Eigen::Vector2d radar_mps(model.radar_velocity_mps[0], model.radar_velocity_mps[1]);
  const Eigen::Vector2d over_ground = before.segment(2, 2) + radar_mps;
  const Heading heading = heading_of(over_ground);
  const Arc path = arc(rate, t);
  const Eigen::Matrix2d half = turned(0.5 * rate * t), whole = turned(rate * t);
  const Eigen::Matrix2d quarter{{0.0, -1.0}, {1.0, 0.0}};
  const double gained_mps = t * pushing.mean.dot(pushed), gained_m = pushing.twice.dot(pushed);
  const Eigen::Vector2d after = over_ground + gained_mps * heading.along;
  const Eigen::Vector2d at_half = half * heading.along, at_end = whole * heading.along;

  MotionStep step{before, Matrix::Identity(kTurnStates, kTurnStates), {}};
  step.mean.head(2) += path.chord * over_ground - t * radar_mps + gained_m * at_half;
  step.mean.segment(2, 2) = whole * after - radar_mps;
  step.mean.segment(kSteering, 3) = steering.transition * steered;
  step.mean.segment(kAlong, 3) = pushing.transition * pushed;

  Eigen::Vector4d by_rate, by_push;
  by_rate << path.by_rate * over_ground + 0.5 * t * gained_m * quarter * at_half,
      t * quarter * whole * after;
  by_push << kTwiceWithin * t * t * at_half, kSmoothWithin * t * at_end;
  step.jacobian.block(0, 2, 2, 2) = path.chord + gained_m * half * heading.slope;
  step.jacobian.block(2, 2, 2, 2) = whole + gained_mps * whole * heading.slope;
  step.jacobian.block(0, kSteering, 4, 3) = by_rate * steering.mean;
  step.jacobian.block(0, kBend, 4, 1) = by_rate;
  step.jacobian.block(0, kAlong, 2, 3) = at_half * pushing.twice;
  step.jacobian.block(2, kAlong, 2, 3) = t * at_end * pushing.mean;
  step.jacobian.block(kSteering, kSteering, 3, 3) = steering.transition;
  step.jacobian.block(kAlong, kAlong, 3, 3) = pushing.transition;
  step.noise = turn_noise(model, t, by_rate, by_push, steering, pushing);

  if (!knows_velocity(over_ground, state)) {
    Vector along = Vector::Zero(kTurnStates);
    along.head(4) << 0.5 * t * t * heading.along, t * heading.along;
    along *= model.acceleration_mps2;
    step.noise += along * along.transpose();
  }
  return step;
}

}  // namespace fanbeam::tracking
