#include "scenes/trajectory/track_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "core/median.h"
#include "scenes/trajectory/track_check.h"
#include "scenes/trajectory/trajectory_kinematics.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {
namespace {

constexpr std::size_t kMedianSteps = 9;

// Of few values: the mean of the two in the middle when they are even in number.
double small_median(std::array<double, kMedianSteps>& values, std::size_t count) {
  std::sort(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
  return 0.5 * (values[(count - 1) / 2] + values[count / 2]);
}

// Steps of 1e-320 s make infinite velocities, which must not come into an order.
double finite(double value) {
  return std::isfinite(value) ? value : std::numeric_limits<double>::max();
}

StepMisfit worse(const StepMisfit& a, const StepMisfit& b) { return b.ratio > a.ratio ? b : a; }

}  // namespace

TrackMotion::TrackMotion(const RawTrack& track, std::vector<std::size_t> rows,
                         const PathSmoothing& smoothing)
    : track_(track), rows_(std::move(rows)) {
  foot_m_.reserve(rows_.size());
  manoeuvred_.reserve(rows_.size());
  TrackTolerance sum;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    foot_m_.push_back(terrain::ecef_from_geodetic(foot_point(track.rows[rows_[i]].position)));
    const double step_s = i > 0 ? time_s(i) - time_s(i - 1) : 0.0;
    sum.position_m += kHardestTurn_mps2 * step_s * step_s;
    sum.height_m += step_s * std::min(kHardestPull_mps2 * step_s, kLargestClimbChange_mps);
    manoeuvred_.push_back(sum);
  }
  find_velocities();
  find_tolerance(smoothing);
}

TrackMotion::Velocity TrackMotion::step_velocity(std::size_t step) const {
  const double step_s = time_s(step + 1) - time_s(step);
  return {(foot_m_[step + 1] - foot_m_[step]) / step_s,
          (height_m(step + 1) - height_m(step)) / step_s};
}

void TrackMotion::find_velocities() {
  const std::size_t steps = size() - 1;
  const std::size_t count = std::min(steps, kMedianSteps);
  velocities_.reserve(size());
  std::array<std::array<double, kMedianSteps>, 4> values{};
  for (std::size_t i = 0; i < size(); ++i) {
    const std::size_t begin =
        std::min(i > kMedianSteps / 2 ? i - kMedianSteps / 2 : 0, steps - count);
    for (std::size_t k = 0; k < count; ++k) {
      const Velocity step = step_velocity(begin + k);
      for (int axis = 0; axis < 3; ++axis)
        values[static_cast<std::size_t>(axis)][k] = step.foot_mps[axis];
      values[3][k] = step.climb_mps;
    }
    Velocity velocity;
    for (int axis = 0; axis < 3; ++axis)
      velocity.foot_mps[axis] = small_median(values[static_cast<std::size_t>(axis)], count);
    velocity.climb_mps = small_median(values[3], count);
    velocities_.push_back(velocity);
  }
}

void TrackMotion::find_tolerance(const PathSmoothing& smoothing) {
  std::vector<double> foot_m, height_m_strays, height_steps_m;
  for (std::size_t i = 0; i + 1 < size(); ++i) {
    const Strays stray = strays(i, i + 1);
    foot_m.push_back(stray.foot_m);
    height_m_strays.push_back(stray.height_m);
    const double climbed_m = std::abs(height_m(i + 1) - height_m(i));
    if (climbed_m > 0.0) height_steps_m.push_back(climbed_m);
  }
  const bool recorded = track_.fully_recorded();
  const double least_position_m = recorded
                                      ? kRecordedTolerance_m + kRecordedDelay_s * median_speed_mps()
                                      : kSmoothedDeviations * smoothing.position_noise_m;
  const double least_height_m =
      recorded ? kRecordedTolerance_m : kSmoothedDeviations * smoothing.height_noise_m;
  tolerance_.position_m =
      std::max(least_position_m, std::min(kMedianStrays * core::median(foot_m), kMostNoise_m));
  const double noise_m = std::max(kMedianStrays * core::median(height_m_strays),
                                  kMedianHeightSteps * core::median(height_steps_m));
  tolerance_.height_m = std::max(least_height_m, std::min(noise_m, kMostHeightNoise_m));
}

TrackMotion::Strays TrackMotion::strays(std::size_t from, std::size_t to) const {
  const double step_s = time_s(to) - time_s(from);
  const Velocity& a = velocities_[from];
  const Velocity& b = velocities_[to];
  const glm::dvec3 way_m = foot_m_[to] - foot_m_[from];
  const double climb_m = height_m(to) - height_m(from);
  return {finite(glm::distance(way_m, 0.5 * step_s * (a.foot_mps + b.foot_mps))),
          finite(std::abs(climb_m - 0.5 * step_s * (a.climb_mps + b.climb_mps)))};
}

StepMisfit TrackMotion::absolute_misfit(std::size_t from, std::size_t to) const {
  const double step_s = time_s(to) - time_s(from);
  const double way_m = glm::distance(foot_m_[to], foot_m_[from]);
  const double climb_m = std::abs(height_m(to) - height_m(from));
  return worse({Misfit::speed, way_m / (tolerance_.position_m + kFastest_mps * step_s),
                way_m / step_s, kFastest_mps},
               {Misfit::climb, climb_m / (tolerance_.height_m + kFastestClimb_mps * step_s),
                climb_m / step_s, kFastestClimb_mps});
}

StepMisfit TrackMotion::misfit(std::size_t from, std::size_t to) const {
  const Strays stray = strays(from, to);
  const double foot_m =
      tolerance_.position_m + manoeuvred_[to].position_m - manoeuvred_[from].position_m;
  const double height_m =
      tolerance_.height_m + manoeuvred_[to].height_m - manoeuvred_[from].height_m;
  return worse(absolute_misfit(from, to),
               worse({Misfit::position, stray.foot_m / foot_m, stray.foot_m, foot_m},
                     {Misfit::height, stray.height_m / height_m, stray.height_m, height_m}));
}

double TrackMotion::speed_mps(std::size_t i) const {
  return finite(glm::length(velocities_[i].foot_mps));
}

double TrackMotion::median_speed_mps() const {
  std::vector<double> speeds_mps;
  speeds_mps.reserve(size());
  for (std::size_t i = 0; i < size(); ++i) speeds_mps.push_back(speed_mps(i));
  return core::median(speeds_mps);
}

}  // namespace fanbeam::scenes
