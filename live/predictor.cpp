#include "live/predictor.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace fanbeam::live {
namespace {

// Longer ago than this, two poses tell nothing of acceleration and turn.
constexpr double kFarApart_s = 0.5;

}  // namespace

void Predictor::take(const core::Pose& pose, double arrived_s) {
  const std::optional<Known>& last = waiting_ ? waiting_ : newest_;
  if (last && !(arrived_s > last->time_s)) return;
  const Known now{arrived_s, frame_.to_local_m(pose.position),
                  frame_.north_east_down_at(pose.position) * pose.v_N_mps, pose};
  if (!newest_ || follows(*newest_, now)) {
    before_ = newest_;
    newest_ = now;
    waiting_.reset();
  } else if (waiting_ && follows(*waiting_, now)) {
    before_ = waiting_;
    newest_ = now;
    waiting_.reset();
  } else {
    waiting_ = now;
  }
}

// Generous: sources that tell no velocity, and manoeuvres, must pass; a kilometre in a packet not.
bool Predictor::follows(const Known& before, const Known& now) {
  constexpr double kSlack_m = 10.0, kManoeuvre_mps2 = 50.0;
  const double span_s = now.time_s - before.time_s;
  const double speed_mps = std::max(glm::length(before.v_mps), glm::length(now.v_mps));
  const glm::dvec3 expected_m = before.at_m + 0.5 * (before.v_mps + now.v_mps) * span_s;
  return glm::distance(now.at_m, expected_m) <=
         kSlack_m + 0.5 * speed_mps * span_s + 0.5 * kManoeuvre_mps2 * span_s * span_s;
}

core::Pose Predictor::placed(const glm::dvec3& at_m, const glm::dvec3& v_mps,
                             const glm::dquat& q_NB) const {
  core::Pose pose;
  pose.position = frame_.to_geodetic(at_m);
  pose.q_NB = glm::normalize(q_NB);
  pose.v_N_mps = v_mps * frame_.north_east_down_at(pose.position);
  return pose;
}

core::Pose Predictor::between(double share) const {
  const Known &a = *before_, &b = *newest_;
  const double span_s = b.time_s - a.time_s, s = share, s2 = s * s, s3 = s2 * s;
  const glm::dvec3 at_m = (2.0 * s3 - 3.0 * s2 + 1.0) * a.at_m + (3.0 * s2 - 2.0 * s3) * b.at_m +
                          span_s * ((s3 - 2.0 * s2 + s) * a.v_mps + (s3 - s2) * b.v_mps);
  return placed(at_m, glm::mix(a.v_mps, b.v_mps, s),
                core::interpolate(a.pose.q_NB, b.pose.q_NB, s));
}

core::Pose Predictor::after(double ahead_s) const {
  const Known& b = *newest_;
  const double span_s = before_ ? b.time_s - before_->time_s : 1e300;
  if (span_s > kFarApart_s) return placed(b.at_m + ahead_s * b.v_mps, b.v_mps, b.pose.q_NB);
  const glm::dvec3 a_mps2 = (b.v_mps - before_->v_mps) / span_s;
  // The short arc goes on at its rate.
  glm::dquat step = glm::conjugate(before_->pose.q_NB) * b.pose.q_NB;
  if (step.w < 0.0) step = -step;
  const glm::dquat turn = glm::angleAxis(glm::angle(step) * ahead_s / span_s, glm::axis(step));
  return placed(b.at_m + ahead_s * (b.v_mps + 0.5 * ahead_s * a_mps2), b.v_mps + ahead_s * a_mps2,
                b.pose.q_NB * turn);
}

std::optional<core::Pose> Predictor::at(double time_s) const {
  if (!newest_) return std::nullopt;
  core::Pose pose;
  if (time_s >= newest_->time_s)
    pose = after(std::min(time_s - newest_->time_s, kCarriedOn_s));
  else if (before_)
    pose = between(std::max(0.0, (time_s - before_->time_s) / (newest_->time_s - before_->time_s)));
  else
    pose = newest_->pose;
  pose.time_s = time_s;
  return pose;
}

std::optional<double> Predictor::newest_s() const {
  return newest_ ? std::optional(newest_->time_s) : std::nullopt;
}

}  // namespace fanbeam::live
