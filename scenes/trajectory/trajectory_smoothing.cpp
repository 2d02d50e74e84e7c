#include "scenes/trajectory/trajectory_smoothing.h"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace fanbeam::scenes {
namespace {

// What is assumed before the first sample: nothing that an aircraft would notice.
constexpr double kFirstRateDeviation_per_s = 300.0;
constexpr double kFirstAccelerationDeviation_per_s2 = 3.0;

// State (value, rate, acceleration) with its covariance.
struct Estimate {
  glm::dvec3 mean{0.0};
  glm::dmat3 covariance{0.0};
};

glm::dmat3 transition_over(double t) {
  // GLM takes columns: what value, rate and acceleration contribute.
  return {glm::dvec3{1.0, 0.0, 0.0}, glm::dvec3{t, 1.0, 0.0}, glm::dvec3{0.5 * t * t, t, 1.0}};
}

// Covariance that white third derivative of density 1 adds over the time t.
glm::dmat3 growth_over(double t) {
  const double t2 = t * t;
  const double t3 = t2 * t;
  return {glm::dvec3{t3 * t2 / 20.0, t2 * t2 / 8.0, t3 / 6.0},
          glm::dvec3{t2 * t2 / 8.0, t3 / 3.0, t2 / 2.0}, glm::dvec3{t3 / 6.0, t2 / 2.0, t}};
}

Estimate predicted(const Estimate& from, double step_s, double jerk_density) {
  const glm::dmat3 F = transition_over(step_s);
  return {F * from.mean,
          F * from.covariance * glm::transpose(F) + jerk_density * growth_over(step_s)};
}

Estimate corrected(const Estimate& expected, double value, double variance) {
  const glm::dvec3 column = expected.covariance[0];
  const glm::dvec3 gain = column / (column.x + variance);
  return {expected.mean + gain * (value - expected.mean.x),
          expected.covariance - glm::outerProduct(gain, column)};
}

SmoothPoint point(const glm::dvec3& mean) { return {mean.x, mean.y, mean.z}; }

}  // namespace

std::vector<SmoothPoint> smoothed(const std::vector<double>& times_s,
                                  const std::vector<double>& values, double noise,
                                  double jerk_density) {
  const std::size_t count = values.size();
  std::vector<SmoothPoint> points(count);
  if (count == 0) return points;
  std::vector<Estimate> filtered(count);
  const double variance = noise * noise;
  filtered[0].mean = {values[0], 0.0, 0.0};
  filtered[0].covariance[0][0] = variance;
  filtered[0].covariance[1][1] = kFirstRateDeviation_per_s * kFirstRateDeviation_per_s;
  filtered[0].covariance[2][2] =
      kFirstAccelerationDeviation_per_s2 * kFirstAccelerationDeviation_per_s2;
  for (std::size_t i = 1; i < count; ++i)
    filtered[i] = corrected(predicted(filtered[i - 1], times_s[i] - times_s[i - 1], jerk_density),
                            values[i], variance);

  glm::dvec3 later = filtered[count - 1].mean;
  points[count - 1] = point(later);
  for (std::size_t i = count - 1; i-- > 0;) {
    const double step_s = times_s[i + 1] - times_s[i];
    const Estimate ahead = predicted(filtered[i], step_s, jerk_density);
    const glm::dmat3 gain = filtered[i].covariance * glm::transpose(transition_over(step_s)) *
                            glm::inverse(ahead.covariance);
    later = filtered[i].mean + gain * (later - ahead.mean);
    points[i] = point(later);
  }
  return points;
}

SmoothPoint between(const SmoothPoint& from, const SmoothPoint& to, double step_s, double s) {
  const double h = step_s;
  // What is left at the far end after the near end's parabola.
  const double value =
      to.value - from.value - h * from.rate_per_s - 0.5 * h * h * from.acceleration_per_s2;
  const double rate = h * (to.rate_per_s - from.rate_per_s - h * from.acceleration_per_s2);
  const double bend = h * h * (to.acceleration_per_s2 - from.acceleration_per_s2);
  const double c3 = 10.0 * value - 4.0 * rate + 0.5 * bend;
  const double c4 = -15.0 * value + 7.0 * rate - bend;
  const double c5 = 6.0 * value - 3.0 * rate + 0.5 * bend;
  SmoothPoint at;
  at.value = from.value + s * (h * from.rate_per_s + s * (0.5 * h * h * from.acceleration_per_s2 +
                                                          s * (c3 + s * (c4 + s * c5))));
  at.rate_per_s = from.rate_per_s + s * h * from.acceleration_per_s2 +
                  s * s * (3.0 * c3 + s * (4.0 * c4 + s * 5.0 * c5)) / h;
  at.acceleration_per_s2 =
      from.acceleration_per_s2 + s * (6.0 * c3 + s * (12.0 * c4 + s * 20.0 * c5)) / (h * h);
  return at;
}

}  // namespace fanbeam::scenes
