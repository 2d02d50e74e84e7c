#include "live/predictor.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace fanbeam::live {
namespace {

// Longer ago than this, two poses tell nothing of acceleration and turn; nearer than that, what is left of jitter
// would be most of the time between them.
constexpr double kFarApart_s = 0.5, kNear_s = 0.03;
constexpr std::size_t kKept = 16;
// A place told for so long is no packet that came twice; what is slower may turn on the spot.
constexpr double kStill_s = 0.05, kMoves_mps = 0.1;

}  // namespace

// A clock of the way flown; of what does not fly, arrival.
double Predictor::flown_s(const Known& now) {
  constexpr double kSlow_mps = 10.0, kLongest_s = 1.0;
  if (heard_) {
    const double waited_s = now.arrived_s - heard_->arrived_s;
    const glm::dvec3 v_mps = 0.5 * (now.told_mps + heard_->told_mps);
    const double square = glm::dot(v_mps, v_mps);
    // In the source's seconds, whatever its rate.
    Known before = *heard_, after = now;
    before.rate = after.rate = 1.0;
    before.time_s = 0.0;
    after.time_s =
        square > kSlow_mps * kSlow_mps ? glm::dot(now.at_m - heard_->at_m, v_mps) / square : -1.0;
    const bool told = after.time_s >= 0.0 && after.time_s <= kLongest_s && follows(before, after);
    flown_s_ += told ? after.time_s : waited_s;
  }
  return flown_s_;
}

void Predictor::take(const core::Pose& pose, double arrived_s, const std::optional<double>& clock_s,
                     std::size_t source) {
  if (source != source_) {
    const std::uint64_t strays = strays_;
    *this = Predictor(frame_);
    source_ = source;
    strays_ = strays;
  }
  if (heard_ && !(arrived_s > heard_->arrived_s)) return;
  Known now{arrived_s, arrived_s, frame_.to_local_m(pose.position),
            frame_.north_east_down_at(pose.position) * pose.v_N_mps, pose};
  now.time_s = clock_.time_of(clock_s ? *clock_s : flown_s(now), arrived_s);
  now.rate = clock_.rate();
  if (!heard_ || now.at_m != heard_->at_m) there_since_s_ = arrived_s;
  heard_ = now;
  now.stands = arrived_s - there_since_s_ >= kStill_s && glm::length(now.told_mps) > kMoves_mps;
  if (now.stands) now.told_mps = glm::dvec3(0.0);
  const Known* const last = waiting_ ? &*waiting_ : flight_.empty() ? nullptr : &flight_.back();
  if (last != nullptr && !(now.time_s > last->time_s)) return;
  if (!flight_.empty() && !follows(flight_.back(), now)) {
    if (!waiting_ || !follows(*waiting_, now)) {
      if (waiting_) ++strays_;
      waiting_ = now;
      return;
    }
    flight_ = {*waiting_};
  } else if (waiting_) {
    ++strays_;
  }
  flight_.push_back(now);
  if (flight_.size() > kKept) flight_.pop_front();
  waiting_.reset();
}

// Generous: sources that tell no velocity, and manoeuvres, must pass; a kilometre in a packet not.
bool Predictor::follows(const Known& before, const Known& now) {
  constexpr double kSlack_m = 10.0, kManoeuvre_mps2 = 50.0;
  const double span_s = now.time_s - before.time_s;
  const double speed_mps = std::max(glm::length(before.v_mps()), glm::length(now.v_mps()));
  const glm::dvec3 expected_m = before.at_m + 0.5 * (before.v_mps() + now.v_mps()) * span_s;
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

core::Pose Predictor::between(const Known& a, const Known& b, double time_s) const {
  const double span_s = b.time_s - a.time_s, s = (time_s - a.time_s) / span_s;
  const double s2 = s * s, s3 = s2 * s;
  const glm::dvec3 at_m = (2.0 * s3 - 3.0 * s2 + 1.0) * a.at_m + (3.0 * s2 - 2.0 * s3) * b.at_m +
                          span_s * ((s3 - 2.0 * s2 + s) * a.v_mps() + (s3 - s2) * b.v_mps());
  return placed(at_m, glm::mix(a.v_mps(), b.v_mps(), s),
                core::interpolate(a.pose.q_NB, b.pose.q_NB, s));
}

core::Pose Predictor::after(double ahead_s) const {
  const Known& b = flight_.back();
  const auto before = std::find_if(flight_.rbegin(), flight_.rend(), [&](const Known& one) {
    return one.time_s <= b.time_s - kNear_s;
  });
  // What stands, or stood a moment ago, tells nothing of them either.
  if (before == flight_.rend() || b.time_s - before->time_s > kFarApart_s || b.stands ||
      before->stands)
    return placed(b.at_m + ahead_s * b.v_mps(), b.v_mps(), b.pose.q_NB);
  const double span_s = b.time_s - before->time_s;
  const glm::dvec3 a_mps2 = b.rate * (b.told_mps - before->told_mps) / span_s;
  // The short arc goes on at its rate.
  glm::dquat step = glm::conjugate(before->pose.q_NB) * b.pose.q_NB;
  if (step.w < 0.0) step = -step;
  const glm::dquat turn = glm::angleAxis(glm::angle(step) * ahead_s / span_s, glm::axis(step));
  return placed(b.at_m + ahead_s * (b.v_mps() + 0.5 * ahead_s * a_mps2),
                b.v_mps() + ahead_s * a_mps2, b.pose.q_NB * turn);
}

std::optional<core::Pose> Predictor::at(double time_s) const {
  if (flight_.empty()) return std::nullopt;
  const auto later = std::find_if(flight_.begin(), flight_.end(),
                                  [&](const Known& one) { return one.time_s > time_s; });
  core::Pose pose = flight_.front().pose;
  if (later == flight_.end())
    pose = after(std::min(time_s - flight_.back().time_s, kCarriedOn_s));
  else if (later != flight_.begin())
    pose = between(*(later - 1), *later, time_s);
  pose.time_s = time_s;
  return pose;
}

std::optional<double> Predictor::newest_s() const {
  return flight_.empty() ? std::nullopt : std::optional(flight_.back().arrived_s);
}

}  // namespace fanbeam::live
